/* SPDX-License-Identifier: MIT */
/*
 * FBX and Collada: a box that bends, beside what its numbers say; assets/imp.gltf written in both
 * formats by assimp, beside what is made of the glTF; and broken files.
 */
#include "../../baker/scene.h"
#include "check.h"
#include "export.h"
#include "limn/bake.h"
#include "limn/character.h"

#include <math.h>
#include <stdlib.h>

// ---- Files

static char *read_all(const char *path, size_t *size) {
    FILE *const file = fopen(path, "rb");
    if (!CHECK(file != NULL)) exit(check_report());
    char *const bytes = calloc(1 << 20, 1);
    *size = fread(bytes, 1, (1 << 20) - 1, file);
    fclose(file);
    return bytes;
}

static void write_all(const char *path, const char *bytes, size_t size) {
    FILE *const file = fopen(path, "wb");
    if (!CHECK(file != NULL)) return;
    CHECK_EQUAL(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

/// box.fbx or box.dae of the corpus. Returns the text, for the caller to free.
static char *read_box(const char *extension, size_t *size) {
    const char *const assets = getenv("LIMN_ASSETS");
    char path[1024];
    snprintf(path, sizeof path, "%s/../tests/fuzz/corpus/%s/box.%s", assets ? assets : "assets",
             extension, extension);
    return read_all(path, size);
}

/// Writes the box into this folder, with one text in the place of another, which is there.
static void write_box(const char *path, const char *from, const char *to) {
    size_t size;
    char *const text = read_box(strrchr(path, '.') + 1, &size);
    char *const changed = malloc(size + strlen(to) + 1), *const at = strstr(text, from);
    if (!CHECK(at != NULL)) fprintf(stderr, "    %s\n", from);
    if (at) {
        const int length =
            sprintf(changed, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
        write_all(path, changed, (size_t)length);
    }
    free(changed);
    free(text);
}

// ---- Baking

typedef struct baked {
    limn_baker *baker;
    limn_pack pack;
    char notes[8192];
} baked;

static void keep_note(void *user, const char *text) {
    char *const notes = user;
    const size_t length = strlen(notes);
    snprintf(notes + length, 8192 - length, "%s\n", text);
}

static limn_bake_status try_bake(baked *b, const char *path) {
    const void *blob;
    size_t size;
    *b = (baked){0};
    b->baker = limn_baker_create(&(limn_bake_desc){
        .scheme = LIMN_SCHEME_CATMARK, .note = keep_note, .user = b->notes, .images = true});
    limn_bake_status status = limn_baker_add_file(b->baker, path);
    if (status == LIMN_BAKE_OK) status = limn_baker_finish(b->baker, &blob, &size);
    if (status == LIMN_BAKE_OK) CHECK_EQUAL(limn_pack_open(&b->pack, blob, size), LIMN_OK);
    return status;
}

/// Control points in a moment of the first clip, moved by joints, and by morph targets if
/// `morphed`. For the caller to free.
static float (*pose(const baked *b, float time, bool morphed))[3] {
    const limn_mesh mesh = limn_pack_mesh(&b->pack, 0);
    const limn_skeleton skeleton = limn_pack_skeleton(&b->pack);
    const limn_skin skin = limn_mesh_skin(&b->pack, 0);
    const limn_morph_targets targets = limn_mesh_morph_targets(&b->pack, 0);
    const limn_clip clip = limn_pack_clip(&b->pack, 0);
    float(*const points)[3] = malloc(mesh.point_count * sizeof *points);
    float *const matrices = calloc(skeleton.joint_count, 12 * sizeof *matrices);
    float weights[8];
    memcpy(points, mesh.controls, mesh.point_count * sizeof *points);
    if (morphed && CHECK(targets.target_count <= 8)) {
        limn_clip_morph_weights(&b->pack, 0, &clip, time, LIMN_WRAP_CLAMP, weights);
        limn_morph_points(&targets, weights, mesh.controls, 0, targets.point_count, points[0]);
    }
    limn_clip_pose(&skeleton, &clip, time, LIMN_WRAP_CLAMP, matrices);
    const limn_pose moved = {.skin = &skin, .matrices = matrices};
    limn_pose_points(&moved, points[0], 0, skin.point_count, points[0]);
    free(matrices);
    return points;
}

// ---- The box

/// Where the box has a point `p` of the bind pose: above 1 it turns about z, halfway at 1, and its
/// top bulges before. angle: in right angles
static void bend(const double p[3], double angle, double bulge, double out[3]) {
    const double radians = acos(0) * angle, y = p[1] + (p[1] > 1.5 ? bulge : 0);
    const double share = p[1] < 0.5 ? 0 : p[1] < 1.5 ? 0.5 : 1;
    const double turned[3] = {p[0] * cos(radians) - (y - 1) * sin(radians),
                              1 + p[0] * sin(radians) + (y - 1) * cos(radians), p[2]};
    out[0] = (1 - share) * p[0] + share * turned[0];
    out[1] = (1 - share) * y + share * turned[1];
    out[2] = p[2];
}

/// The box of Collada is in centimetres, and z is up in it; that of FBX is as we have it.
/// It turns by 90 degrees in a second, from `start` right angles on.
static void check_bend(const baked *b, bool is_collada, float time, double start) {
    const limn_mesh mesh = limn_pack_mesh(&b->pack, 0);
    float(*const points)[3] = pose(b, time, !is_collada);
    for (uint32_t c = 0; c < mesh.control_count; c++) {
        const double x = (double)mesh.controls[3 * c], y = (double)mesh.controls[3 * c + 1];
        const double z = (double)mesh.controls[3 * c + 2];
        const double of_fbx[3] = {x, y, z}, of_collada[3] = {x / 100, z / 100, -y / 100};
        double want[3];
        bend(is_collada ? of_collada : of_fbx, start + (double)time,
             is_collada ? 0 : 0.5 * (double)time, want);
        for (int axis = 0; axis < 3; axis++)
            CHECK_NEAR((double)points[c][axis], want[axis], 2e-6);
    }
    free(points);
}

static void check_materials(const baked *b) {
    const limn_material wall = limn_pack_material(&b->pack, 0),
                        lid = limn_pack_material(&b->pack, 1);
    CHECK_EQUAL(limn_pack_material_count(&b->pack), 2);
    CHECK_TEXT(wall.name, "wall");
    CHECK_TEXT(wall.image_name, "brick.png");
    CHECK_EQUAL(wall.image_size, 8);
    CHECK_TEXT(lid.name, "lid");
    CHECK(lid.base_colour[0] == 0.25f && lid.base_colour[2] == 0.75f && lid.image_name == NULL);
    if (!CHECK_EQUAL(limn_mesh_material_range_count(&b->pack, 0), 2)) return;
    CHECK_EQUAL(limn_mesh_material_range(&b->pack, 0, 0).patch_count, 8);
    CHECK_EQUAL(limn_mesh_material_range(&b->pack, 0, 1).patch_count, 2);
}

static void check_skeleton(const baked *b) {
    const limn_skeleton skeleton = limn_pack_skeleton(&b->pack);
    if (!CHECK_EQUAL(skeleton.joint_count, 3)) return; // assimp adds a root
    CHECK_TEXT(limn_skeleton_joint(&skeleton, 1).name, "lower");
    CHECK_TEXT(limn_skeleton_joint(&skeleton, 2).name, "upper");
    CHECK_EQUAL(limn_skeleton_joint(&skeleton, 2).parent, 1);
}

/// Its texture is in the folder.
static void test_box(const char *path) {
    const bool is_collada = strstr(path, ".dae") != NULL;
    baked b;
    write_box(path, "brick", "brick");
    write_all("brick.png", "\x89PNG\r\n\x1a\n", 8);
    if (CHECK_EQUAL(try_bake(&b, path), LIMN_BAKE_OK)) {
        const limn_mesh mesh = limn_pack_mesh(&b.pack, 0);
        CHECK_TEXT(mesh.name, "body");
        CHECK_EQUAL(mesh.control_count, 12); // faces of both materials share points
        CHECK_EQUAL(mesh.patch_count, 10);   // which are quads
        if (CHECK_EQUAL(mesh.channel_count, 1)) {
            const limn_channel uv = limn_mesh_channel(&b.pack, &mesh, 0);
            CHECK_EQUAL(uv.mesh.control_count, 15 + 8); // a seam, and lids
        }
        check_materials(&b);
        check_skeleton(&b);
        for (int quarter = 0; quarter <= 4; quarter++)
            check_bend(&b, is_collada, (float)quarter / 4, 0);
    } else {
        fprintf(stderr, "    %s\n", limn_baker_error(b.baker));
    }
    limn_baker_destroy(b.baker);
    remove("brick.png");
    remove(path);
}

static void test_bulge(void) {
    baked b;
    write_box("test_assimp.fbx", "brick", "brick");
    if (CHECK_EQUAL(try_bake(&b, "test_assimp.fbx"), LIMN_BAKE_OK)) {
        CHECK_EQUAL(limn_mesh_morph_targets(&b.pack, 0).target_count, 1);
        CHECK_TEXT(limn_mesh_morph_name(&b.pack, 0, 0), "bulge");
        float weight = 1;
        limn_clip_morph_weights(&b.pack, 0, NULL, 0, LIMN_WRAP_CLAMP, &weight);
        CHECK(weight == 0);
    }
    limn_baker_destroy(b.baker);
    remove("test_assimp.fbx");
}

#define UPPER "\"A\", 0, 1, 0\n" // the end of its properties
#define PROPERTY(name, value) "\t\t\tP: \"" name "\", \"Vector3D\", \"Vector\", \"\", " value "\n"

/// A rotation before that of the clip, and a pivot: assimp makes nodes of these, which are joints
/// only where it moves them.
static void test_turned(void) {
    static const char *const properties[] = {
        UPPER PROPERTY("PreRotation", "0, 0, 90"),
        UPPER PROPERTY("RotationPivot", "0, 0, 0.5") PROPERTY("PreRotation", "0, 0, 90"),
    };
    static const uint32_t joint_counts[] = {3, 8};
    for (int p = 0; p < 2; p++) {
        baked b;
        write_box("test_assimp.fbx", UPPER, properties[p]);
        if (CHECK_EQUAL(try_bake(&b, "test_assimp.fbx"), LIMN_BAKE_OK)) {
            CHECK_EQUAL(limn_pack_skeleton(&b.pack).joint_count, joint_counts[p]);
            for (int quarter = 0; quarter <= 4; quarter++)
                check_bend(&b, false, (float)quarter / 4, 1);
        }
        limn_baker_destroy(b.baker);
        remove("test_assimp.fbx");
    }
}

/// An image inside the file.
static void test_inside(void) {
    baked b;
    write_box("test_assimp.fbx", "\tTexture: 32,",
              "\tVideo: 33, \"Video::brick\", \"Clip\" {\n\t\tType: \"Clip\"\n"
              "\t\tRelativeFilename: \".\\brick.png\"\n"
              "\t\tContent: , \"iVBORw0KGgo=\"\n\t}\n\tTexture: 32,");
    if (CHECK_EQUAL(try_bake(&b, "test_assimp.fbx"), LIMN_BAKE_OK))
        CHECK_EQUAL(limn_pack_material(&b.pack, 0).image_size, 8);
    limn_baker_destroy(b.baker);
    remove("test_assimp.fbx");
}

// ---- The imp

/// The mesh of a file, before it is baked.
typedef struct source {
    limni_context context;
    limni_character character;
    limni_scene scene;
    limni_source *mesh;
} source;

static bool read_source(source *s, const char *path) {
    *s = (source){.scene.character = &s->character};
    if (!CHECK_EQUAL(limni_read_scene(&s->context, path, &s->scene), LIMN_BAKE_OK) ||
        !CHECK_EQUAL(s->scene.source_count, 1))
        return false;
    s->mesh = s->scene.sources;
    return true;
}

/// Faces and their corners come in the same order; formats have six digits behind the point.
static void compare_corners(const limni_source *a, const limni_source *b) {
    if (!CHECK_EQUAL(a->face_count, b->face_count) || !CHECK_EQUAL(b->channel_count, 1) ||
        !CHECK_EQUAL(a->position_count, b->position_count) ||
        !CHECK_EQUAL(a->channels[0].value_count, b->channels[0].value_count))
        return;
    CHECK_EQUAL(memcmp(a->face_offsets, b->face_offsets, a->face_count * sizeof(uint32_t)), 0);
    for (uint32_t c = 0; c < a->face_offsets[a->face_count]; c++) {
        const float *const p = a->positions[a->face_corners[c]];
        const float *const q = b->positions[b->face_corners[c]];
        const float *const u = a->channels[0].values[a->channels[0].corner_values[c]];
        const float *const v = b->channels[0].values[b->channels[0].corner_values[c]];
        for (int axis = 0; axis < 3; axis++) {
            CHECK_NEAR(p[axis], q[axis], 1e-6f);
            CHECK_NEAR(u[axis], v[axis], 1e-6f);
        }
    }
}

/// Positions become control points in their order.
static void compare_poses(const source *s, const source *t, const baked *a, const baked *b) {
    enum { MOMENTS = 13 };
    const limni_source *const from = s->mesh, *const to = t->mesh;
    const limn_clip clip = limn_pack_clip(&a->pack, 0);
    double largest = 0;
    CHECK_NEAR(limn_pack_clip(&b->pack, 0).duration, clip.duration, 1e-6f);
    CHECK_EQUAL(memcmp(limn_pack_mesh(&b->pack, 0).controls, to->positions,
                       to->position_count * sizeof *to->positions),
                0);
    for (int m = 0; m < MOMENTS; m++) {
        const float time = clip.duration * (float)m / (MOMENTS - 1);
        float(*const p)[3] = pose(a, time, false), (*const q)[3] = pose(b, time, false);
        for (uint32_t c = 0; c < from->face_offsets[from->face_count]; c++) {
            for (int axis = 0; axis < 3; axis++)
                largest = fmax(largest, fabs((double)p[from->face_corners[c]][axis] -
                                             (double)q[to->face_corners[c]][axis]));
        }
        free(p);
        free(q);
    }
    printf("posed points within %.2g of those of the glTF\n", largest);
    CHECK(largest < 2e-5);
}

/// assets/imp.gltf, and what assimp makes of it in another format.
static void test_imp(const char *format, const char *path) {
    char gltf[1024];
    const char *const assets = getenv("LIMN_ASSETS");
    snprintf(gltf, sizeof gltf, "%s/imp.gltf", assets ? assets : "assets");
    source s, t;
    baked a, b;
    if (!CHECK(export_scene(gltf, format, path))) return;
    if (read_source(&s, gltf) && read_source(&t, path)) {
        compare_corners(s.mesh, t.mesh);
        CHECK_EQUAL(try_bake(&a, gltf), LIMN_BAKE_OK);
        CHECK_EQUAL(try_bake(&b, path), LIMN_BAKE_OK);
        compare_poses(&s, &t, &a, &b);
        limn_baker_destroy(a.baker);
        limn_baker_destroy(b.baker);
    }
    limni_release_all(&s.context);
    limni_release_all(&t.context);
    remove(path);
}

// ---- What is lost, and what is broken

typedef struct change {
    const char *path, *from, *to, *words;
} change;

#define DAE "test_assimp.dae"
#define FBX "test_assimp.fbx"

static const change noted[] = {
    {FBX, "brick", "brick", "the sharpness of edges (LayerElementEdgeCrease) is lost"},
    {FBX, "brick", "brick", "lengths are as in the file, in units of 100 cm"},
    {FBX, "brick", "brick", "curves of animations are taken as straight between their keys"},
    {FBX, "brick", "brick", "the weights of its morph targets at rest are lost, and are 0"},
    {FBX, "brick", "brick", "the texture 'brick.png' is missing"},
    {FBX, "\"UpAxis\", \"int\", \"Integer\", \"\", 1", "\"UpAxis\", \"int\", \"Integer\", \"\", 2",
     "z is up in it, and stays so"},
    {FBX, "RelativeFilename: \".\\brick.png\"", "RelativeFilename: \"..\\x\\brick.png\"",
     "the texture '../x/brick.png' is missing"},
    {FBX, "Normals", "Ignored", "assimp found no morph targets (BlendShapeChannel)"},
    {FBX, "\tGeometry: 11,",
     "\tGeometry: 12, \"Geometry::half\", \"Shape\" {\n\t\tVersion: 100\n\t\tIndexes: *1 "
     "{\n\t\t\ta: 8\n"
     "\t\t}\n\t\tVertices: *3 {\n\t\t\ta: 0,1,0\n\t\t}\n\t\tNormals: *3 {\n\t\t\ta: "
     "0,0,0\n\t\t}\n\t}\n"
     "\tGeometry: 11,",
     "morph target 'half' is one of several shapes on the way to one"},
    {DAE, "LINEAR LINEAR", "BEZIER BEZIER", "curves of animations (BEZIER) are taken as straight"},
    {DAE, "<library_visual_scenes><visual_scene id=\"scene\" name=\"scene\">",
     "<library_cameras><camera id=\"c\"><optics><technique_common><perspective><xfov>40</xfov>"
     "</perspective></technique_common></optics></camera></library_cameras>"
     "<library_visual_scenes><visual_scene id=\"scene\" name=\"scene\">"
     "<node id=\"eye\" name=\"eye\"><instance_camera url=\"#c\"/></node>",
     "'eye': its camera is passed over"},
};

static void test_notes(void) {
    for (size_t n = 0; n < sizeof noted / sizeof *noted; n++) {
        baked b;
        write_box(noted[n].path, noted[n].from, noted[n].to);
        if (!CHECK_EQUAL(try_bake(&b, noted[n].path), LIMN_BAKE_OK) ||
            !CHECK_CONTAINS(b.notes, noted[n].words))
            fprintf(stderr, "    by %s: %s\n", noted[n].to, limn_baker_error(b.baker));
        limn_baker_destroy(b.baker);
        remove(noted[n].path);
    }
}

static const change refused[] = {
    {DAE, "</COLLADA>", "", "not good Collada: "},
    {DAE, "<polylist material=\"wall\" count=\"8\">", "<polylist material=\"wall\" count=\"9\">",
     "not good Collada: "},
    {DAE, "0 0 1 1 5 6 4 5", "0 0 1 1 55 6 4 5", "not good Collada: "},
    {DAE, "-100 100 0 ", "-100 nan 0 ", "mesh 0 'box': the place of vertex 9 is not finite"},
    {FBX, "0,0,1,0,0,-1,0,1", "0,0,1,0,0,-1,0,2",
     "the inverse bind matrix of bone 'upper' is not finite, or its last row"},
    {FBX, "a: 1,1,1,1,0.5", "a: 1,1,-1,1,0.5", "mesh 0 'box': vertex 5 has a negative weight"},
    {DAE, ">0 1</float_array>", "></float_array>", DAE ": "},
    {DAE, "<v>0 0 ", "<v>0 77 ", DAE ": not good Collada: assimp breaks down over it"},
    {FBX, "PolygonVertexIndex", "Polygons", FBX ": its scene has no mesh with faces"},
    {FBX, "0,1,5,-5", "0,1,55,-5", FBX ": its scene has no mesh with faces"},
    {FBX, "Objects:  {", "Objects:  {{", FBX ": not good FBX: "},
};

static void test_refusals(void) {
    for (size_t r = 0; r < sizeof refused / sizeof *refused; r++) {
        baked b;
        write_box(refused[r].path, refused[r].from, refused[r].to);
        if (!CHECK_EQUAL(try_bake(&b, refused[r].path), LIMN_BAKE_BAD_INPUT) ||
            !CHECK_CONTAINS(limn_baker_error(b.baker), refused[r].words))
            fprintf(stderr, "    by %s\n", refused[r].to);
        limn_baker_destroy(b.baker);
        remove(refused[r].path);
    }
}

/// Assimp would abort.
static void test_empty(void) {
    baked b;
    write_all(DAE, "", 0);
    CHECK_EQUAL(try_bake(&b, DAE), LIMN_BAKE_BAD_INPUT);
    CHECK_TEXT(limn_baker_error(b.baker), DAE ": not good Collada: it is empty");
    limn_baker_destroy(b.baker);
    remove(DAE);
}

int main(void) {
    test_box("test_assimp.fbx");
    test_box("test_assimp.dae");
    test_bulge();
    test_turned();
    test_inside();
    test_imp("fbxa", "test_assimp_imp.fbx");
    test_imp("collada", "test_assimp_imp.dae");
    test_notes();
    test_refusals();
    test_empty();
    return check_report();
}
