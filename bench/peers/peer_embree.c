/* SPDX-License-Identifier: MIT */
/*
 * Embree's rtcInterpolateN(), which gives points of the limit surface at any parameters, with all
 * points of a patch in one call: its quickest use. It writes one coordinate behind the other.
 *
 * Embree caches what it derives from the control points of a face, to a depth of its own, and
 * notices that they have changed when the geometry is committed, which each frame does. The scene
 * is committed once, for its half-edges; it is never traced.
 */
#include "peer.h"

#include "../bench.h"
#include "allocate.h"

#include <embree3/rtcore.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH_UNIT = 16 }; ///< points; Embree asks for a multiple of 4

/// Shared by the peers of one scene.
typedef struct surfaces {
    RTCDevice device;
    RTCScene scene;
    RTCGeometry geometry;
    uint32_t *face_sizes, *face_corners;
    float (*controls)[4];
    uint32_t batch;           ///< the rows of a patch, padded
    uint32_t *faces;          ///< [patch_count]
    const float **parameters; ///< [patch_count] u of [batch] rows, then v; one of `tables`
    float *(*tables)[2]; ///< [corner_max] by corner of faces that are not quads, or are; or NULL
    uint32_t corner_max;
    double build_ms;
    int64_t byte_count; ///< that Embree allocated
    uint32_t peer_count;
} surfaces;

typedef struct state {
    const peer_scene *where;
    surfaces *source;
    uint32_t *face_of_row; ///< [batch]
    float *out;            ///< of each patch [3][batch], and twice more with derivatives
    bool derivatives;
} state;

// -------------------------------------------------------------------------------------------------
// A frame

static void evaluate_patch(const state *self, uint32_t patch) {
    const surfaces *const source = self->source;
    const size_t floats = 3 * (size_t)source->batch;
    float *const out = self->out + patch * floats * (self->derivatives ? 3 : 1);
    for (uint32_t row = 0; row < source->batch; row++)
        self->face_of_row[row] = source->faces[patch];
    rtcInterpolateN(&(struct RTCInterpolateNArguments){
        .geometry = source->geometry,
        .primIDs = self->face_of_row,
        .u = source->parameters[patch],
        .v = source->parameters[patch] + source->batch,
        .N = source->batch,
        .bufferType = RTC_BUFFER_TYPE_VERTEX,
        .P = out,
        .dPdu = self->derivatives ? out + floats : NULL,
        .dPdv = self->derivatives ? out + 2 * floats : NULL,
        .valueCount = 3,
    });
}

static void run(void *self_state) {
    const state *const self = self_state;
    rtcUpdateGeometryBuffer(self->source->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(self->source->geometry);
    for (uint32_t patch = 0; patch < self->where->patch_count; patch++)
        evaluate_patch(self, patch);
}

static const float *position(const void *self_state, uint32_t patch, uint32_t row) {
    const state *const self = self_state;
    const size_t floats = 3 * (size_t)self->source->batch * (self->derivatives ? 3 : 1);
    return self->out + patch * floats + row;
}

// -------------------------------------------------------------------------------------------------
// Preparation

static bool count_bytes(void *user, ssize_t bytes, bool post) {
    (void)post;
    ((surfaces *)user)->byte_count += bytes;
    return true;
}

/// Of a patch at corner `corner` of a divided quad.
static void place_in_quad(uint32_t corner, float u, float v, float *face_u, float *face_v) {
    *face_u = u / 2;
    *face_v = v / 2;
    for (; corner > 0; corner--) {
        const float before = *face_u;
        *face_u = 1 - *face_v;
        *face_v = before;
    }
}

/// Of a patch at corner `corner` of a face that is not a quad: Embree packs the corner into whole
/// steps of 2.
static void place_in_polygon(uint32_t corner, float u, float v, float *face_u, float *face_v) {
    *face_u = 2 * (float)(corner % 4) + 0.5f + u;
    *face_v = 2 * (float)(corner / 4) + 0.5f + v;
}

static float *make_parameters(const peer_scene *where, uint32_t batch, uint32_t face_size,
                              uint32_t corner) {
    float *const parameters = bench_allocate(2 * (size_t)batch, sizeof *parameters);
    for (uint32_t row = 0; row < batch; row++) {
        const limn_row *const at = &where->domain->rows[row < where->row_count ? row : 0];
        const float u = (float)at->i / LIMN_GRID_SIZE, v = (float)at->j / LIMN_GRID_SIZE;
        float *const face_u = parameters + row, *const face_v = face_u + batch;
        *face_u = u;
        *face_v = v;
        if (!where->divided) continue;
        (face_size == 4 ? place_in_quad : place_in_polygon)(corner, u, v, face_u, face_v);
    }
    return parameters;
}

static void find_patches(surfaces *made, const peer_scene *where) {
    for (uint32_t f = 0; f < where->face_count; f++)
        made->corner_max =
            where->face_sizes[f] > made->corner_max ? where->face_sizes[f] : made->corner_max;
    made->tables = bench_allocate(made->corner_max, sizeof *made->tables);
    made->faces = bench_allocate(where->patch_count, sizeof *made->faces);
    made->parameters = bench_allocate(where->patch_count, sizeof *made->parameters);
    uint32_t patch = 0;
    for (uint32_t f = 0; f < where->face_count; f++) {
        const uint32_t size = where->face_sizes[f];
        for (uint32_t c = 0; c < (where->divided ? size : 1); c++) {
            float **const table = &made->tables[c][size == 4];
            if (!*table) *table = make_parameters(where, made->batch, size, c);
            made->faces[patch] = f;
            made->parameters[patch++] = *table;
        }
    }
}

/// What Embree reads may lie up to 16 bytes behind the end.
static void *copy_padded(const void *items, size_t count, size_t size) {
    char *const copy = bench_allocate(count * size + 64, 1);
    return memcpy(copy, items, count * size);
}

static void share(RTCGeometry geometry, enum RTCBufferType type, enum RTCFormat format,
                  const void *items, size_t stride, size_t count) {
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, items, 0, stride, count);
}

static void create_geometry(surfaces *made, const peer_scene *where) {
    uint32_t corner_count = 0;
    for (uint32_t f = 0; f < where->face_count; f++)
        corner_count += where->face_sizes[f];
    made->face_sizes = copy_padded(where->face_sizes, where->face_count, sizeof(uint32_t));
    made->face_corners = copy_padded(where->face_corners, corner_count, sizeof(uint32_t));
    made->controls = bench_allocate((size_t)where->control_count + 1, sizeof *made->controls);
    for (uint32_t v = 0; v < where->control_count; v++)
        memcpy(made->controls[v], where->controls[v], sizeof *where->controls);

    const RTCGeometry geometry = rtcNewGeometry(made->device, RTC_GEOMETRY_TYPE_SUBDIVISION);
    share(geometry, RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, made->face_sizes, sizeof(uint32_t),
          where->face_count);
    share(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, made->face_corners, sizeof(uint32_t),
          corner_count);
    share(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, made->controls,
          sizeof *made->controls, where->control_count);
    rtcSetGeometrySubdivisionMode(geometry, 0, RTC_SUBDIVISION_MODE_SMOOTH_BOUNDARY);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(made->scene, geometry);
    made->geometry = geometry;
    rtcCommitScene(made->scene);
}

static surfaces *create_surfaces(const peer_scene *where) {
    surfaces *const made = bench_allocate(1, sizeof *made);
    const double start = bench_seconds();
    made->batch = (where->row_count + BATCH_UNIT - 1) / BATCH_UNIT * BATCH_UNIT;
    made->device = rtcNewDevice("threads=1,set_affinity=0");
    if (made->device) {
        rtcSetDeviceMemoryMonitorFunction(made->device, count_bytes, made);
        made->scene = rtcNewScene(made->device);
        create_geometry(made, where);
    }
    made->build_ms = 1e3 * (bench_seconds() - start);
    find_patches(made, where);
    return made;
}

static void destroy_surfaces(surfaces *made) {
    for (uint32_t c = 0; c < made->corner_max; c++) {
        free(made->tables[c][0]);
        free(made->tables[c][1]);
    }
    free(made->tables);
    free(made->faces);
    free(made->parameters);
    if (made->geometry) rtcReleaseGeometry(made->geometry);
    if (made->scene) rtcReleaseScene(made->scene);
    if (made->device) rtcReleaseDevice(made->device);
    free(made->face_sizes);
    free(made->face_corners);
    free(made->controls);
    free(made);
}

static void destroy(void *self_state) {
    state *const self = self_state;
    if (--self->source->peer_count == 0) destroy_surfaces(self->source);
    free(self->face_of_row);
    free(self->out);
    free(self);
}

/// What Embree chose at run time.
static const char *isa_name(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return "avx512";
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return "avx2";
    return PEER_OPENSUBDIV_ISA;
}

static void append(peer_list *list, const peer_scene *where, surfaces *source, bool derivatives) {
    state *const self = bench_allocate(1, sizeof *self);
    const size_t floats = 3 * (size_t)source->batch * (derivatives ? 3 : 1);
    self->where = where;
    self->source = source;
    self->derivatives = derivatives;
    self->face_of_row = bench_allocate(source->batch, sizeof *self->face_of_row);
    self->out = bench_allocate(where->patch_count * floats, sizeof *self->out);
    source->peer_count++;
    *peer_append(list) = (peer){
        .name = "embree",
        .output = derivatives ? PEER_POSITION_DERIVATIVES : PEER_POSITION,
        .points = PEER_PATCH_POINTS,
        .isa = isa_name(source->device),
        .family = "",
        .threads = 1,
        .build_ms = source->build_ms,
        .load_ms = (double)NAN,
        .byte_count = source->byte_count > 0 ? (uint64_t)source->byte_count : 0,
        .state = self,
        .run = run,
        .position = position,
        .axis_stride = source->batch,
        .destroy = destroy,
    };
}

/// A vertex of one face is a corner of the boundary. Embree's points there are others, by up to
/// 0.002 of the diagonal.
static bool has_corners(const peer_scene *where) {
    topology mesh = scene_topology(where);
    const uint32_t corner_count = mesh.face_starts[mesh.face_count];
    uint32_t *const face_counts = bench_allocate(where->control_count, sizeof *face_counts);
    for (uint32_t c = 0; c < corner_count; c++)
        face_counts[mesh.face_vertices[c]]++;
    bool found = false;
    for (uint32_t v = 0; v < where->control_count; v++)
        found |= face_counts[v] == 1;
    free(face_counts);
    topology_destroy(&mesh);
    return found;
}

bool peers_add_embree(peer_list *list, const peer_scene *scene) {
    if (scene->scheme != LIMN_SCHEME_CATMARK) return true;
    if (has_corners(scene)) {
        fprintf(stderr,
                "limn-bench: %s: without Embree, which rounds corners of the boundary otherwise\n",
                scene->name);
        return true;
    }
    surfaces *const source = create_surfaces(scene);
    const enum RTCError error = rtcGetDeviceError(source->device);
    if (!source->device || error != RTC_ERROR_NONE) {
        fprintf(stderr, "limn-bench: %s: Embree fails with error %d\n", scene->name, (int)error);
        destroy_surfaces(source);
        return false;
    }
    append(list, scene, source, false);
    append(list, scene, source, true);
    return true;
}
