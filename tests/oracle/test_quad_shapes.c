/* SPDX-License-Identifier: MIT */
/*
 * The oracle answers for each Catmull-Clark and bilinear shape of OpenSubdiv's suite or says why
 * not, and where there are two ways to the same surface, uniform refinement and Bfr, they agree.
 */
#include "../../baker/source.h"
#include "../mesh_files.h"
#include "surface.h"

// -------------------------------------------------------------------------------------------------
// The shapes of OpenSubdiv's suite

/// A mesh file with its tags.
typedef struct shape {
    limni_context context;
    limni_source source;
    uint32_t *sizes;
    float *edge_sharpness, *vertex_sharpness;
    bool *holes;
    limni_opensubdiv_mesh mesh;
} shape;

static void tag_edges(const limni_source *source, float *sharpness) {
    for (uint32_t t = 0; t < source->tags.crease_count; t++) {
        const limni_crease *const crease = &source->tags.creases[t];
        for (uint32_t f = 0; f < source->face_count; f++) {
            const uint32_t begin = source->face_offsets[f], end = source->face_offsets[f + 1];
            for (uint32_t c = begin; c < end; c++) {
                const uint32_t a = source->face_corners[c];
                const uint32_t b = source->face_corners[c + 1 < end ? c + 1 : begin];
                if ((a == crease->a && b == crease->b) || (a == crease->b && b == crease->a))
                    sharpness[c] = crease->sharpness;
            }
        }
    }
}

/// Tags of what is not there are ignored.
static void tag_others(const limni_source *source, shape *read) {
    for (uint32_t t = 0; t < source->tags.sharp_vertex_count; t++) {
        const limni_sharp_vertex *const sharp = &source->tags.sharp_vertices[t];
        if (sharp->position < source->position_count)
            read->vertex_sharpness[sharp->position] = sharp->sharpness;
    }
    for (uint32_t t = 0; t < source->tags.hole_count; t++) {
        const uint32_t face = source->tags.holes[t].face;
        if (face < source->face_count) read->holes[face] = true;
    }
}

static bool read_shape(const char *path, shape *read) {
    limni_source *const source = &read->source;
    *read = (shape){0};
    if (limni_read_file(&read->context, path, source) != LIMN_BAKE_OK) return false;
    const uint32_t corner_count = source->face_offsets[source->face_count];
    read->sizes = calloc(source->face_count, sizeof *read->sizes);
    read->edge_sharpness = calloc(corner_count, sizeof *read->edge_sharpness);
    read->vertex_sharpness = calloc(source->position_count, sizeof *read->vertex_sharpness);
    read->holes = calloc(source->face_count, sizeof *read->holes);
    if (!read->sizes || !read->edge_sharpness || !read->vertex_sharpness || !read->holes) abort();
    bool divided = false;
    for (uint32_t f = 0; f < source->face_count; f++) {
        read->sizes[f] = source->face_offsets[f + 1] - source->face_offsets[f];
        divided |= read->sizes[f] != 4;
    }
    tag_edges(source, read->edge_sharpness);
    tag_others(source, read);
    read->mesh = (limni_opensubdiv_mesh){
        .positions = source->positions[0],
        .faces = source->face_corners,
        .face_sizes = read->sizes,
        .position_count = source->position_count,
        .face_count = source->face_count,
        .scheme = strstr(path, "bilinear_") ? LIMNI_OPENSUBDIV_BILINEAR : LIMNI_OPENSUBDIV_CATMARK,
        .divided = divided,
        .boundary = source->tags.boundary,
        .level = LIMN_LEVEL_MAX,
        .edge_sharpness = read->edge_sharpness,
        .vertex_sharpness = read->vertex_sharpness,
        .holes = read->holes,
        .creasing = source->tags.creasing,
    };
    return true;
}

static void release_shape(shape *read) {
    free(read->sizes);
    free(read->edge_sharpness);
    free(read->vertex_sharpness);
    free(read->holes);
    limni_release_all(&read->context);
}

// -------------------------------------------------------------------------------------------------
// Two ways to the same answer

static double find_diagonal(const limni_opensubdiv_mesh *mesh) {
    double squares = 0;
    for (uint32_t axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY;
        for (uint32_t v = 0; v < mesh->position_count; v++) {
            low = fminf(low, mesh->positions[3 * v + axis]);
            high = fmaxf(high, mesh->positions[3 * v + axis]);
        }
        squares += (double)(high - low) * (double)(high - low);
    }
    return sqrt(squares);
}

enum { SHARPNESS_MAX = 5, PATCHES_MAX = 2000 }; ///< that two ways are compared for, to save time

static double largest_of_all;

/// Positions of `made` beside those of another description of the same surface, which may have more
/// patches at the end.
static void check_same(const char *name, const surface *made, const limni_opensubdiv_mesh *other) {
    surface again = must_evaluate(other);
    double largest = 0;
    for (size_t k = 0; k < (size_t)made->patch_count * ROW_COUNT; k++) {
        for (int axis = 0; axis < 3; axis++) {
            const double difference = fabs(made->limit[k][axis] - again.limit[k][axis]);
            if (difference > largest) largest = difference;
        }
    }
    largest /= find_diagonal(other);
    if (!CHECK(largest <= 1e-7)) fprintf(stderr, "    %s: %.2e\n", name, largest);
    if (largest > largest_of_all) largest_of_all = largest;
    release(&again);
}

/// With one more face, which is a hole and touches nothing, a mesh counts as tagged: Bfr's surfaces
/// instead of uniform refinement.
static void compare_surfaces(const char *name, const shape *read, const surface *made) {
    limni_opensubdiv_mesh mesh = read->mesh;
    const uint32_t corner_count = read->source.face_offsets[mesh.face_count];
    float *const positions = calloc(3 * ((size_t)mesh.position_count + 4), sizeof *positions);
    uint32_t *const faces = calloc((size_t)corner_count + 4, sizeof *faces);
    uint32_t *const sizes = calloc((size_t)mesh.face_count + 1, sizeof *sizes);
    bool *const holes = calloc((size_t)mesh.face_count + 1, sizeof *holes);
    if (!positions || !faces || !sizes || !holes) abort();
    memcpy(positions, mesh.positions, 3 * (size_t)mesh.position_count * sizeof *positions);
    memcpy(faces, mesh.faces, corner_count * sizeof *faces);
    memcpy(sizes, mesh.face_sizes, mesh.face_count * sizeof *sizes);
    memcpy(holes, mesh.holes, mesh.face_count * sizeof *holes);
    for (uint32_t c = 0; c < 4; c++)
        faces[corner_count + c] = mesh.position_count + c;
    sizes[mesh.face_count] = 4;
    holes[mesh.face_count] = true;
    mesh.positions = positions;
    mesh.faces = faces;
    mesh.face_sizes = sizes;
    mesh.edge_sharpness = mesh.vertex_sharpness = NULL;
    mesh.holes = holes;
    mesh.position_count += 4;
    mesh.face_count++;
    check_same(name, made, &mesh);
    free(positions);
    free(faces);
    free(sizes);
    free(holes);
}

/// Whether Chaikin's method cannot differ from the other, as creases are equally sharp, or for ever,
/// and its uniform refinement does not take long.
static bool allows_chaikin(const limni_source *source) {
    bool for_ever = true, equal = true;
    const limni_tags *const tags = &source->tags;
    for (uint32_t t = 0; t < tags->crease_count; t++) {
        const float sharpness = tags->creases[t].sharpness, first = tags->creases[0].sharpness;
        for_ever &= sharpness >= LIMNI_SHARP_FOR_EVER;
        equal &= sharpness <= first && sharpness >= first && sharpness < SHARPNESS_MAX;
    }
    for (uint32_t t = 0; t < tags->sharp_vertex_count; t++) {
        const float sharpness = tags->sharp_vertices[t].sharpness;
        if (sharpness > SHARPNESS_MAX && sharpness < LIMNI_SHARP_FOR_EVER) return false;
    }
    return for_ever || equal;
}

/// Uniform refinement instead of surfaces.
static void compare_vertices(const char *name, const shape *read, const surface *made) {
    limni_opensubdiv_mesh mesh = read->mesh;
    mesh.creasing = LIMN_CREASING_CHAIKIN;
    check_same(name, made, &mesh);
}

// -------------------------------------------------------------------------------------------------
// All shapes

static bool is_finite(const surface *made, size_t vertex) {
    const double *const values[3] = {made->limit[vertex], made->tangents[vertex][0],
                                     made->tangents[vertex][1]};
    bool finite = true;
    for (int axis = 0; axis < 9; axis++)
        finite &= isfinite(values[axis / 3][axis % 3]) != 0;
    return finite;
}

/// Numbers everywhere but on holes. Returns how many faces have none.
static uint32_t check_numbers(const shape *read, const surface *made) {
    uint32_t missing_count = 0;
    size_t vertex = 0;
    for (uint32_t f = 0; f < read->mesh.face_count; f++) {
        const size_t count = (size_t)(read->mesh.divided ? read->sizes[f] : 1) * ROW_COUNT;
        size_t finite_count = 0;
        for (size_t end = vertex + count; vertex < end; vertex++)
            finite_count += is_finite(made, vertex);
        CHECK(finite_count == 0 || finite_count == count);
        missing_count += finite_count == 0;
        if (read->mesh.boundary == LIMN_BOUNDARY_NONE) continue;
        CHECK_EQUAL(finite_count == 0, read->holes[f]);
    }
    return missing_count;
}

static bool is_tagged(const limni_tags *tags) {
    return tags->crease_count + tags->sharp_vertex_count + tags->hole_count > 0;
}

static void compare(const char *name, const shape *read, const surface *made) {
    const bool chaikin = read->mesh.creasing == LIMN_CREASING_CHAIKIN;
    if (read->mesh.boundary == LIMN_BOUNDARY_NONE || read->source.tags.hole_count > 0 ||
        made->patch_count > PATCHES_MAX)
        return;
    if (!is_tagged(&read->source.tags))
        compare_surfaces(name, read, made);
    else if (!chaikin && allows_chaikin(&read->source))
        compare_vertices(name, read, made);
}

static int shape_count, refused_count;

/// What is refused: faces that use a vertex twice, as the baker does.
static void visit(const char *path) {
    const char *const name = strrchr(path, '/') + 1;
    shape read;
    if (!strstr(path, "opensubdiv_shapes/") || strncmp(name, "loop_", 5) == 0) return;
    shape_count++;
    if (!CHECK(read_shape(path, &read))) {
        fprintf(stderr, "    %s\n", read.context.error);
        return;
    }
    surface made = evaluate(&read.mesh);
    if (made.limit) {
        const uint32_t missing_count = check_numbers(&read, &made);
        printf("%-32s %5u %s, %u holes\n", name, made.patch_count,
               read.mesh.divided ? "parts of faces" : "faces", missing_count);
        compare(name, &read, &made);
    } else {
        printf("%-32s refused: %s\n", name, made.error);
        CHECK_CONTAINS(made.error, "uses a vertex twice");
        CHECK_CONTAINS(name, "nonman_");
        refused_count++;
    }
    release(&made);
    release_shape(&read);
}

int main(void) {
    CHECK(mesh_files_visit(visit) > 0);
    printf("%d shapes, %d refused; two ways differ by %.2e of the diagonal at most\n", shape_count,
           refused_count, largest_of_all);
    if (shape_count > 0) CHECK(shape_count == 91 && refused_count == 4);
    return check_report();
}
