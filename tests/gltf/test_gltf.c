/* SPDX-License-Identifier: MIT */
/*
 * glTF from a file to control points in a moment of a clip, beside the reference, and to vertices
 * that are watertight by bits: a scene that is made here, and the models of LIMN_TEST_ASSETS.
 */
#include "check.h"
#include "gltf_reference.h"
#include "limn/bake.h"
#include "limn/character.h"
#include "shared_edges.h"
#include "tube.h"

#include <stdlib.h>

/// A baked file, and the document that it comes from.
typedef struct scene {
    limni_context context;
    limni_gltf document;
    limn_baker *baker;
    limn_pack pack;
    char notes[4096];
    int nodes[16]; ///< of the meshes
} scene;

static void keep_note(void *user, const char *text) {
    scene *const s = user;
    glb_append(s->notes, sizeof s->notes, "%s\n", text);
}

static char *read_all(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    if (!file) return NULL;
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *const bytes = malloc(*size + 1);
    if (fread(bytes, 1, *size, file) != *size) *size = 0;
    bytes[*size] = '\0';
    fclose(file);
    return bytes;
}

/// The nodes with meshes, depth first, as they come in the file.
static void list_nodes(const limni_gltf *d, int node, int *nodes, int *count) {
    if (d->nodes[node].mesh >= 0) nodes[(*count)++] = node;
    for (uint32_t c = 0; c < d->nodes[node].child_count; c++)
        list_nodes(d, d->nodes[node].children[c], nodes, count);
}

static bool is_child(const limni_gltf *d, int node) {
    for (uint32_t n = 0; n < d->node_count; n++) {
        for (uint32_t c = 0; c < d->nodes[n].child_count; c++) {
            if (d->nodes[n].children[c] == node) return true;
        }
    }
    return false;
}

static bool open_scene(scene *s, const char *path, bool images) {
    size_t size = 0;
    const void *blob;
    char *const bytes = read_all(path, &size);
    memset(s, 0, sizeof *s);
    if (!CHECK(bytes != NULL)) return false;
    const bool parsed =
        limni_gltf_parse(&s->context, path, bytes, size, &s->document) == LIMN_BAKE_OK;
    free(bytes);
    s->baker = limn_baker_create(&(limn_bake_desc){.isolate = LIMN_ISOLATE_ALWAYS,
                                                   .normals = LIMN_NORMALS_EXACT,
                                                   .note = keep_note,
                                                   .user = s,
                                                   .images = images});
    if (!CHECK(parsed) || !CHECK_EQUAL(limn_baker_add_file(s->baker, path), LIMN_BAKE_OK) ||
        !CHECK_EQUAL(limn_baker_finish(s->baker, &blob, &size), LIMN_BAKE_OK)) {
        fprintf(stderr, "    %s\n", limn_baker_error(s->baker));
        return false;
    }
    int count = 0;
    for (uint32_t n = 0; n < s->document.node_count; n++) {
        if (!is_child(&s->document, (int)n)) list_nodes(&s->document, (int)n, s->nodes, &count);
    }
    return CHECK_EQUAL(limn_pack_open(&s->pack, blob, size), LIMN_OK) &&
           CHECK_EQUAL(s->pack.mesh_count, (uint32_t)count);
}

static void close_scene(scene *s) {
    limn_baker_destroy(s->baker);
    limni_release_all(&s->context);
}

// ---- Poses

/// Control points of a mesh, posed as a program would.
static float *pose(const scene *s, uint32_t m, const limn_clip *clip, float time, limn_wrap wrap) {
    const limn_mesh mesh = limn_pack_mesh(&s->pack, m);
    const limn_skeleton skeleton = limn_pack_skeleton(&s->pack);
    const limn_skin skin = limn_mesh_skin(&s->pack, m);
    const limn_morph_targets targets = limn_mesh_morph_targets(&s->pack, m);
    const size_t size = (size_t)mesh.point_count * 3 * sizeof(float);
    float *const points = malloc(size), *const morphed = malloc(size);
    float *const matrices = calloc(skeleton.joint_count + 1, 12 * sizeof *matrices);
    float weights[64];
    memcpy(points, mesh.controls, size);
    if (targets.target_count) {
        limn_clip_morph_weights(&s->pack, m, clip, time, wrap, weights);
        memcpy(morphed, points, size);
        limn_morph_points(&targets, weights, morphed, 0, targets.point_count, points);
    }
    limn_clip_pose(&skeleton, clip, time, wrap, matrices);
    if (skin.point_count) {
        const limn_pose moved = {.skin = &skin, .matrices = matrices};
        limn_pose_points(&moved, points, 0, skin.point_count, points);
    }
    free(morphed);
    free(matrices);
    return points;
}

static double diagonal_of(const double *points, size_t count) {
    double sum = 0;
    for (size_t axis = 0; axis < 3; axis++) {
        double low = points[axis], high = low;
        for (size_t i = 1; i < count; i++) {
            low = fmin(low, points[3 * i + axis]);
            high = fmax(high, points[3 * i + axis]);
        }
        sum += (high - low) * (high - low);
    }
    return sqrt(sum);
}

static double distance(const float *a, const double *b) {
    double largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fabs((double)a[axis] - b[axis]));
    return largest;
}

/// Every vertex has a control point with its place that goes where it goes, and every control point
/// is one of these.
static double compare(const scene *s, uint32_t m, const limni_gltf_animation *animation,
                      const limn_clip *clip, float time, double moment, limn_wrap wrap) {
    const limn_mesh mesh = limn_pack_mesh(&s->pack, m);
    const int node = s->nodes[m];
    float *const posed = pose(s, m, clip, time, wrap);
    bool *const met = calloc(mesh.control_count, sizeof *met);
    double largest = 0;
    const reference_moment at = {&s->document, animation, moment};
    const uint32_t primitive_count =
        s->document.meshes[s->document.nodes[node].mesh].primitive_count;
    for (uint32_t p = 0; p < primitive_count; p++) {
        size_t count;
        double *const bind = reference_vertices(&at, node, p, false, &count);
        double *const want = reference_vertices(&at, node, p, true, &count);
        const double diagonal = diagonal_of(bind, count), reached = diagonal_of(want, count);
        for (size_t v = 0; v < count; v++) {
            double best = INFINITY;
            for (uint32_t c = 0; c < mesh.control_count; c++) {
                if (distance(mesh.controls + 3 * (size_t)c, bind + 3 * v) > 1e-7 * diagonal)
                    continue;
                const double off = distance(posed + 3 * (size_t)c, want + 3 * v) / reached;
                met[c] |= off <= 1e-6;
                best = fmin(best, off);
            }
            largest = fmax(largest, best);
        }
        free(bind);
        free(want);
    }
    CHECK(largest <= 1e-6);
    for (uint32_t c = 0; c < mesh.control_count; c++)
        CHECK(met[c]);
    free(posed);
    free(met);
    return largest;
}

/// moments  [count] of each clip
static double test_clips(const scene *s, const double *moments, size_t count) {
    double largest = 0;
    const uint32_t clip_count = limn_pack_clip_count(&s->pack);
    CHECK_EQUAL(clip_count, s->document.animation_count);
    for (uint32_t m = 0; m < s->pack.mesh_count; m++) {
        largest = fmax(largest, compare(s, m, NULL, NULL, 0, 0, LIMN_WRAP_CLAMP));
        for (uint32_t c = 0; c < clip_count; c++) {
            const limn_clip clip = limn_pack_clip(&s->pack, c);
            for (size_t i = 0; i < count; i++) {
                const float time = (float)(moments[i] * (double)clip.duration);
                largest = fmax(largest, compare(s, m, &s->document.animations[c], &clip, time,
                                                (double)time, LIMN_WRAP_CLAMP));
            }
        }
    }
    return largest;
}

// ---- Watertight

/// Evaluates and compares one frame of a mesh. Returns how many edges are shared.
static uint32_t check_frame(const limn_mesh *mesh, float *controls) {
    const limn_plan plan = limn_plan_uniform(mesh, 2);
    float *const normals = malloc((size_t)mesh->normal_count * sizeof(float[3]));
    vertex *const vertices = malloc((size_t)plan.vertex_count * sizeof *vertices);
    limn_mesh_refine(mesh, controls);
    limn_mesh_control_normals(mesh, controls, normals);
    limn_evaluate(&plan, controls, 0, plan.patch_count,
                  &(limn_output){.vertices = vertices,
                                 .stride = sizeof *vertices,
                                 .normals = vertices->normal,
                                 .normal_stride = sizeof *vertices,
                                 .control_normals = normals});
    const uint32_t shared = check_shared_edges(&plan, vertices);
    free(normals);
    free(vertices);
    return shared;
}

/// Frames of every clip, of all meshes.
static void test_watertight(const scene *s) {
    enum { FRAMES = 8 };
    for (uint32_t m = 0; m < s->pack.mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(&s->pack, m);
        for (uint32_t frame = 0; frame < FRAMES * limn_pack_clip_count(&s->pack); frame++) {
            const limn_clip clip = limn_pack_clip(&s->pack, frame / FRAMES);
            const float time = clip.duration * (float)(frame % FRAMES) / (FRAMES - 1);
            float *const controls = pose(s, m, &clip, time, LIMN_WRAP_CLAMP);
            CHECK(check_frame(&mesh, controls) > mesh.patch_count);
            free(controls);
        }
    }
}

// ---- The scene that is made here

static void write_tube(const char *path) {
    static glb file;
    static char json[1 << 16];
    size_t size;
    tube_make(&file);
    glb_json(&file, json, sizeof json);
    unsigned char *const bytes = glb_make(json, file.bytes, file.size, &size);
    FILE *const out = fopen(path, "wb");
    if (CHECK(out != NULL)) {
        CHECK_EQUAL(fwrite(bytes, 1, size, out), size);
        fclose(out);
    }
    free(bytes);
}

static void test_skeleton(const scene *s) {
    static const char *const names[] = {"armature", "lower",  "lower",    "upper",
                                        "upper",    "mirror", "propeller"};
    static const uint32_t parents[] = {LIMN_NONE, 0, 1, 1, 3, LIMN_NONE, 5};
    const limn_skeleton skeleton = limn_pack_skeleton(&s->pack);
    if (!CHECK_EQUAL(skeleton.joint_count, 7)) return;
    for (uint32_t j = 0; j < 7; j++) {
        const limn_joint joint = limn_skeleton_joint(&skeleton, j);
        CHECK_TEXT(joint.name, names[j]);
        CHECK_EQUAL(joint.parent, parents[j]);
    }
    // A further bind of a node does not move by itself.
    CHECK(limn_skeleton_joint(&skeleton, 2).scale[0] == 1);
    CHECK(limn_skeleton_joint(&skeleton, 2).inverse_bind[7] == -0.5f);
    CHECK(limn_skeleton_joint(&skeleton, 3).translation[1] == 1.5f);
}

static void test_meshes(const scene *s) {
    static const char *const names[] = {"tube", "twin", "propeller", "base"};
    static const uint32_t influences[] = {2, 2, 1, 0}, points[] = {25, 25, 4, 4};
    for (uint32_t m = 0; m < 4; m++) {
        const limn_mesh mesh = limn_pack_mesh(&s->pack, m);
        const limn_skin skin = limn_mesh_skin(&s->pack, m);
        CHECK_TEXT(mesh.name, names[m]);
        CHECK_EQUAL(skin.influence_count, influences[m]);
        CHECK_EQUAL(mesh.control_count, points[m]); // the seam is one row of points
        CHECK_EQUAL(skin.point_count, influences[m] ? points[m] : 0);
    }
    const limn_morph_targets targets = limn_mesh_morph_targets(&s->pack, 0);
    CHECK_EQUAL(targets.target_count, 1);
    CHECK_EQUAL(targets.first[1], TUBE_SIDES); // sparse
    CHECK_TEXT(limn_mesh_morph_name(&s->pack, 0, 0), "swell");
    float weight = 0;
    limn_clip_morph_weights(&s->pack, 0, NULL, 0, LIMN_WRAP_CLAMP, &weight);
    CHECK(weight == 0.25f);
    limn_clip_morph_weights(&s->pack, 1, NULL, 0, LIMN_WRAP_CLAMP, &weight);
    CHECK(weight == 0.5f);
    CHECK_EQUAL(limn_mesh_morph_targets(&s->pack, 3).target_count, 0);
}

static void test_materials(const scene *s) {
    CHECK_EQUAL(limn_pack_material_count(&s->pack), 2);
    const limn_material wall = limn_pack_material(&s->pack, 0);
    CHECK_TEXT(wall.name, "wall");
    CHECK_TEXT(wall.image_name, "not_there.png");
    CHECK(wall.base_colour[1] == 0.5f && wall.image_bytes == NULL);
    CHECK(limn_pack_material(&s->pack, 1).image_name == NULL);
    for (uint32_t m = 0; m < 2; m++) {
        if (!CHECK_EQUAL(limn_mesh_material_range_count(&s->pack, m), 2)) continue;
        const limn_mesh mesh = limn_pack_mesh(&s->pack, m);
        for (uint32_t r = 0; r < 2; r++) {
            const limn_material_range range = limn_mesh_material_range(&s->pack, m, r);
            CHECK_EQUAL(range.material, r);
            CHECK_EQUAL(range.patch_count, r ? LID_TRIANGLES : TUBE_TRIANGLES);
            for (uint32_t p = 0; p < range.patch_count; p++)
                CHECK((limn_mesh_face(&mesh, range.first_patch + p).face >= TUBE_TRIANGLES) == r);
        }
    }
    CHECK_EQUAL(limn_mesh_material_range_count(&s->pack, 3), 0);
}

/// Six times the volume of a closed mesh.
static double volume_of(const limn_mesh *mesh) {
    double volume = 0;
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        uint32_t corners[LIMN_CORNER_MAX];
        limn_mesh_corners(mesh, p, corners);
        const float *const a = mesh->controls + 3 * (size_t)corners[0];
        const float *const b = mesh->controls + 3 * (size_t)corners[1];
        const float *const c = mesh->controls + 3 * (size_t)corners[2];
        for (int axis = 0; axis < 3; axis++)
            volume += (double)(a[axis] * (b[(axis + 1) % 3] * c[(axis + 2) % 3] -
                                          b[(axis + 2) % 3] * c[(axis + 1) % 3]));
    }
    return volume;
}

/// Mirrored meshes are turned inside out again.
static void test_winding(const scene *s) {
    const limn_mesh propeller = limn_pack_mesh(&s->pack, 2), base = limn_pack_mesh(&s->pack, 3);
    CHECK_NEAR(volume_of(&propeller), 2, 1e-5);
    CHECK_NEAR(volume_of(&base), 8, 1e-5);
}

static void test_wrap(const scene *s) {
    const limn_clip bend = limn_pack_clip(&s->pack, 0);
    const limni_gltf_animation *const animation = &s->document.animations[0];
    CHECK_TEXT(bend.name, "bend");
    CHECK(bend.duration == 2);
    compare(s, 0, animation, &bend, 2.75f, 0.75, LIMN_WRAP_REPEAT);
    compare(s, 0, animation, &bend, -1.5f, 0.5, LIMN_WRAP_REPEAT);
    compare(s, 0, animation, &bend, 2.75f, 2, LIMN_WRAP_CLAMP);
    compare(s, 0, animation, &bend, -1, 0, LIMN_WRAP_CLAMP);
    compare(s, 0, animation, &bend, 4, 0, LIMN_WRAP_REPEAT); // begins again
}

static void test_notes(const scene *s) {
    static const char *const notes[] = {
        "image 0: the texture 'not_there.png' is missing",
        "material 1 'lid': only its base colour is read, not normalTexture",
        "mesh 0 'tube': 1 of its 2 parts have no uv, and get 0",
    };
    for (size_t n = 0; n < sizeof notes / sizeof *notes; n++)
        CHECK_CONTAINS(s->notes, notes[n]);
}

static void test_tube(void) {
    scene s;
    write_tube("test_gltf.glb");
    if (open_scene(&s, "test_gltf.glb", true)) {
        test_skeleton(&s);
        test_meshes(&s);
        test_materials(&s);
        test_winding(&s);
        test_wrap(&s);
        test_notes(&s);
        static const double moments[] = {0, 0.1, 0.31, 0.5, 0.77, 0.999, 1};
        printf("made here: control points within %.2g\n", test_clips(&s, moments, 7));
    }
    close_scene(&s);
    remove("test_gltf.glb");
}

// ---- Shared models

static void test_models(void) {
    static const char *const files[] = {"CesiumMan.glb", "Fox.glb", "RiggedFigure.glb",
                                        "rigged_simple.gltf", "MorphStressTest.gltf"};
    const char *const folder = getenv("LIMN_TEST_ASSETS");
    for (size_t f = 0; folder && folder[0] && f < sizeof files / sizeof *files; f++) {
        char path[1024];
        scene s;
        snprintf(path, sizeof path, "%s/animated/%s", folder, files[f]);
        FILE *const file = fopen(path, "rb");
        if (!file) continue;
        fclose(file);
        if (open_scene(&s, path, false)) {
            printf("%s: control points within %.2g\n", files[f],
                   test_clips(&s, (const double[]){0.31, 0.77}, 2));
            test_watertight(&s);
        }
        close_scene(&s);
    }
}

int main(void) {
    test_tube();
    test_models();
    return check_report();
}
