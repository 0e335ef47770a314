/* SPDX-License-Identifier: MIT */
/*
 * Broken glTF is refused, or mended with a note, and the words name what is broken. Each case
 * changes the good scene of tube.h in one place.
 */
#include "../../baker/scene.h"
#include "chain.h"
#include "check.h"
#include "limn/limn.h"
#include "tube.h"

typedef struct outcome {
    limn_bake_status status;
    char error[1024], notes[8192];
    uint32_t source_count, influence_count, position_count;
    uint32_t channel_count, value_counts[2]; ///< of the first mesh, as the next ones
    float least_colour;                      ///< above 0
    limni_tags tags;
    char image_name[64]; ///< of the first image
    uint64_t image_size;
    uint16_t joints[LIMN_INFLUENCE_MAX]; ///< of its first position
    float weights[LIMN_INFLUENCE_MAX];
} outcome;

static void keep_note(void *user, const char *text) {
    outcome *const o = user;
    glb_append(o->notes, sizeof o->notes, "%s\n", text);
}

/// Returns how many values there are.
static uint32_t check_channel(const limni_source *source, uint32_t c) {
    static const char *const names[] = {"uv", "colour"};
    const limni_source_channel *const channel = &source->channels[c];
    CHECK_TEXT(channel->name, names[c]);
    CHECK_EQUAL(channel->component_count, 2 + c);
    for (uint32_t k = 0; k < source->face_offsets[source->face_count]; k++)
        CHECK(channel->corner_values[k] < channel->value_count);
    return channel->value_count;
}

static float find_least(const limni_source_channel *channel) {
    float least = 1;
    for (uint32_t i = 0; i < 3 * channel->value_count; i++) {
        const float value = channel->values[i / 3][i % 3];
        if (value > 0 && value < least) least = value;
    }
    return least;
}

/// Vertices 0 to 3 are the first four positions.
static void check_creases(const limni_tags *tags) {
    for (uint32_t c = 0; c < tags->crease_count; c++) {
        CHECK_EQUAL(tags->creases[c].a, c);
        CHECK_EQUAL(tags->creases[c].b, c + 1);
    }
    if (tags->sharp_vertex_count) CHECK_EQUAL(tags->sharp_vertices[0].position, 3);
}

static void keep_image(const limni_character *character, outcome *o) {
    if (character->images.count == 0) return;
    const limn_file_image *const image = character->images.items;
    snprintf(o->image_name, sizeof o->image_name, "%s",
             (const char *)character->strings.items + image->name);
    o->image_size = image->size;
}

static outcome read_bytes(const unsigned char *bytes, size_t size) {
    outcome o = {0};
    limni_character character = {0};
    limni_context context = {.desc = {.note = keep_note, .user = &o, .images = true}};
    limni_scene scene = {.character = &character};
    char *const copy = malloc(size + 1); // exactly as large, for the address sanitizer
    memcpy(copy, bytes, size);
    copy[size] = '\0';
    o.status = limni_read_gltf(&context, "a.glb", "a", copy, size, &scene);
    free(copy);
    memcpy(o.error, context.error, sizeof o.error);
    if (o.status == LIMN_BAKE_OK) {
        o.source_count = scene.source_count;
        o.influence_count = scene.sources[0].rig.influence_count;
        o.position_count = scene.sources[0].position_count;
        memcpy(o.joints, scene.sources[0].rig.joints, o.influence_count * sizeof *o.joints);
        memcpy(o.weights, scene.sources[0].rig.weights, o.influence_count * sizeof *o.weights);
        o.channel_count = scene.sources[0].channel_count;
        for (uint32_t c = 0; c < o.channel_count && c < 2; c++)
            o.value_counts[c] = check_channel(&scene.sources[0], c);
        if (o.channel_count > 1) o.least_colour = find_least(&scene.sources[0].channels[1]);
        check_creases(&scene.sources[0].tags);
        o.tags = scene.sources[0].tags;
        keep_image(&character, &o);
    }
    limni_release_all(&context);
    return o;
}

/// The scene with one text of its JSON in the place of another, which is there.
static outcome read_changed(glb *file, const char *from, const char *to) {
    static char json[1 << 16], changed[1 << 16];
    size_t size;
    glb_json(file, json, sizeof json);
    const char *const at = strstr(json, from);
    if (!CHECK(at != NULL)) {
        fprintf(stderr, "    %s\n", from);
        return (outcome){0};
    }
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - json), json, to, at + strlen(from));
    unsigned char *const bytes = glb_make(changed, file->bytes, file->size, &size);
    const outcome o = read_bytes(bytes, size);
    free(bytes);
    return o;
}

/// A change, and the words of the error.
typedef struct refusal {
    const char *from, *to, *error;
} refusal;

#define BUFFER "\"buffers\":[{"
#define TEXTURE "\"uri\":\"not_there.png\""

static const refusal refusals[] = {
    // The document
    {"\"version\":\"2.0\"", "\"version\":\"1.0\"", "a.glb: glTF version '1.0', but only 2 is read"},
    {"\"asset\":", "\"asset\"", "a.glb: not good glTF: "},
    {BUFFER, BUFFER "\"uri\":\"/etc/passwd\",",
     "buffer 0: '/etc/passwd' leaves the folder of the document"},
    {BUFFER, BUFFER "\"uri\":\"a/%2e%2e/../b.bin\",",
     "buffer 0: 'a/../../b.bin' leaves the folder of the document"},
    {BUFFER, BUFFER "\"uri\":\"..bin\",", "buffer 0: '..bin' cannot be found"},
    {BUFFER, BUFFER "\"uri\":\".\",", "buffer 0: '.' is not a regular file"},
    {BUFFER, BUFFER "\"uri\":\"data:application/octet-stream;base64,AAAA\",",
     "a.glb: not good glTF: buffer 0: its data URI is damaged, or has another size"},
    {BUFFER, BUFFER "\"uri\":\"data:model/x;base64,AAAA\",",
     "a.glb: not good glTF: buffer 0: its data URI has a type that is not read"},
    {"\"scene\":0", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"scene\":0",
     "it requires the extension KHR_draco_mesh_compression"},
    // Accessors
    {"\"name\":\"wall positions\",\"bufferView\":", "\"name\":\"wall positions\",\"bufferView\":9",
     "accessor 1 'wall positions' (POSITION of mesh 0 'tube', primitive 0)"},
    {"\"type\":\"VEC3\",\"count\":28", "\"type\":\"VEC3\",\"count\":2800000",
     "accessor 0 'wall target' (POSITION of morph target 0 of mesh 0 'tube', primitive 0)"},
    {"\"name\":\"wall joints\",\"bufferView\":4,\"componentType\":5121",
     "\"name\":\"wall joints\",\"bufferView\":4,\"componentType\":5126",
     "accessor 3 'wall joints' (JOINTS_0 of mesh 0 'tube', primitive 0): component type 5126"},
    {"\"name\":\"wall joints\",\"bufferView\":4,\"componentType\":5121",
     "\"name\":\"wall joints\",\"bufferView\":4,\"componentType\":5123",
     "28 elements from byte 0 on reach beyond buffer view 4, which has 112 bytes"},
    {"\"name\":\"wall uv\",\"bufferView\":3,",
     "\"name\":\"wall uv\",\"bufferView\":3,\"byteOffset\":8,",
     "28 elements from byte 8 on reach beyond buffer view 3, which has 224 bytes"},
    {"\"name\":\"wall uv\",\"bufferView\":3,\"componentType\":5126,\"type\":\"VEC2\"",
     "\"name\":\"wall uv\",\"bufferView\":3,\"componentType\":5126,\"type\":\"SCALAR\"",
     "(TEXCOORD_0 of mesh 0 'tube', primitive 0): it has 1 components, but 2 are needed"},
    {"\"type\":\"VEC4\",\"count\":28,\"normalized\":true", "\"type\":\"VEC4\",\"count\":27",
     "accessor 4 'wall weights' (WEIGHTS_0 of mesh 0 'tube', primitive 0): it has 27 elements, but "
     "28 are needed"},
    {"\"count\":7,\"indices\"", "\"count\":70,\"indices\"", "70 sparse elements of 28"},
    {"\"count\":7,\"indices\"", "\"count\":-7,\"indices\"", "sparse elements of 28"},
    {"\"count\":7,\"indices\"", "\"count\":4294967303,\"indices\"",
     "count is not a whole number from 0 to 4294967295"},
    {"\"byteLength\":14}", "\"byteLength\":4294967310}", "byteLength is not a whole number"},
    {"\"bufferView\":0,\"componentType\":5123},\"values\"",
     "\"bufferView\":0,\"componentType\":5126},\"values\"",
     "its sparse indices have component type"},
    {"\"values\":{\"bufferView\":1}", "\"values\":{\"bufferView\":77}",
     "there is no buffer view 77"},
    {"\"byteLength\":14}", "\"byteLength\":140000}", "buffer view 0 reaches beyond buffer 0"},
    {"\"name\":\"wall uv\",\"bufferView\":3,",
     "\"name\":\"wall uv\",\"bufferView\":3,\"byteOffset\":4294967292,",
     "28 elements from byte 4294967292 on reach beyond buffer view 3, which has 224 bytes"},
    {"{\"buffer\":0,\"byteOffset\":0,", "{\"buffer\":5,\"byteOffset\":0,", "there is no buffer 5"},
    {"\"byteOffset\":0,\"byteLength\":14}", "\"byteOffset\":0,\"byteLength\":14,\"byteStride\":3}",
     "byteStride"},
    {"\"indices\":5,\"material\"", "\"indices\":3,\"material\"", "a.glb: "},
    {"\"POSITION\":1,", "\"POSITION\":99,", "there is no accessor 99"},
    {"\"byteOffset\":0,", "\"byteOffset\" : -4,", "byteOffset is not a whole number from 0"},
    {"\"byteOffset\":0,", "\"byteOffset\":1.5,", "byteOffset is not a whole number from 0"},
    {"\"byteOffset\":0,", "\"byteOffset\":0,\"byteStride\":\"4\",",
     "byteStride is not a whole number from 0"},
    // Meshes
    {"\"material\":1,", "\"material\":7,", "material 7, but there are 2"},
    {"\"targets\":[{\"POSITION\":10}]", "\"targets\":[]",
     "mesh 0 'tube', primitive 1 has 0 morph targets, but mesh 0 'tube', primitive 0 has 1"},
    {"[[0,1,2.5]", "[[0,1000,2.5]", "mesh 0 'tube': extras.limn: a crease has a vertex"},
    {"[[0,1,2.5]", "[[0,1,-2.5]", "mesh 0 'tube': extras.limn: a crease has a negative sharpness"},
    {"[[0,1,2.5]", "[[0,2.5]", "mesh 0 'tube': extras.limn: creases[0] is not 3 numbers"},
    {"[[3,4]]", "[[0.5,4]]", "mesh 0 'tube': extras.limn: a corner is a vertex"},
    {"edge-and-corner", "egde", "mesh 0 'tube': extras.limn: there is no such boundary rule"},
    {"\"corners\"", "\"corner\"", "mesh 0 'tube': extras.limn: there is no 'corner'"},
    // Nodes
    {"\"mesh\":0,\"skin\":1", "\"mesh\":9,\"skin\":1", "node 4 'twin': it has mesh 9"},
    {"\"mesh\":0,\"skin\":1", "\"mesh\":0,\"skin\":9", "node 4 'twin': it has skin 9"},
    {"\"children\":[2]", "\"children\":[1]",
     "node 1 'lower': it is a child of two nodes, or twice"},
    {"\"children\":[2]", "\"children\":[0]", "node 0 'armature': it is its own ancestor"},
    {"\"children\":[2]", "\"children\":[-2]", "node 1 'lower': it has a child that does not exist"},
    {"\"nodes\":[0,3,4,5,7]", "\"nodes\":[0,33]", "the scene has node 33"},
    {"\"translation\":[0,1.5,0]", "\"translation\":[0,1e300,0]",
     "node 2 'upper': its place is not finite"},
    {"\"rotation\":[0,0.6,0,0.8]", "\"rotation\":[0,1e300,0,0.8]",
     "node 1 'lower': its place is not finite"},
    {"\"translation\":[0,1.5,0]", "\"translation\":[0,1.5]",
     "node 2 'upper': its translation is not 3 numbers"},
    {"\"rotation\":[0,0.6,0,0.8]", "\"rotation\":[0,0.6,0]",
     "node 1 'lower': its rotation is not 4 numbers"},
    {"\"rotation\":[0,0.6,0,0.8]", "\"scale\":[1,1,1,1]",
     "node 1 'lower': its scale is not 3 numbers"},
    {"\"rotation\":[0,0.6,0,0.8]", "\"matrix\":[1,0,0,0]",
     "node 1 'lower': its matrix is not 16 numbers"},
    {"\"baseColorFactor\":[", "\"baseColorFactor\":[1,", "`baseColorFactor`"},
    {"\"weights\":[0.5]", "\"weights\":[-1e300]",
     "mesh 0 'tube': the weight of morph target 0 is not finite"},
    // Skins and clips
    {"\"joints\":[1,2],\"inverseBindMatrices\":12", "\"joints\":[1,22],\"inverseBindMatrices\":12",
     "skin 1 'other': its joint 1 is node 22"},
    {"\"joints\":[1,2],\"inverseBindMatrices\":12", "\"joints\":[1,2,0],\"inverseBindMatrices\":12",
     "accessor 12 'other binds' (inverse bind matrices of skin 1 'other'): it has 2 elements, but "
     "3"},
    {"\"joints\":[1,2],\"inverseBindMatrices\":11", "\"joints\":[1],\"inverseBindMatrices\":11",
     "mesh 0 'tube', primitive 0: vertex 7 names joint 1, but its skin has 1"},
    {"\"joints\":[1,2],\"inverseBindMatrices\":12", "\"joints\":[],\"inverseBindMatrices\":12",
     "skin 1 'other' has no joints"},
    {"\"CUBICSPLINE\"", "\"BEZIER\"", "animation 0 'bend', channel 2: its sampler does not exist"},
    {"\"node\":2,\"path\"", "\"node\":22,\"path\"",
     "animation 0 'bend', channel 1: there is no such"},
    {"\"input\":16", "\"input\":17", "animation 0 'bend'"},
};

static void test_refusals(glb *file) {
    for (size_t r = 0; r < sizeof refusals / sizeof *refusals; r++) {
        const outcome o = read_changed(file, refusals[r].from, refusals[r].to);
        if (!CHECK_EQUAL(o.status, LIMN_BAKE_BAD_INPUT) ||
            !CHECK_CONTAINS(o.error, refusals[r].error))
            fprintf(stderr, "    by %s\n", refusals[r].to);
    }
}

// ---- Numbers

/// The bytes of an accessor, found by their values.
static void *find_bytes(glb *file, const void *values, size_t size) {
    for (size_t at = 0; at + size <= file->size; at += 4) {
        if (memcmp(file->bytes + at, values, size) == 0) return file->bytes + at;
    }
    CHECK(false);
    return file->bytes;
}

static outcome read_with(const glb *good, const void *from, const void *to, size_t size) {
    static glb file;
    file = *good;
    memcpy(find_bytes(&file, from, size), to, size);
    return read_changed(&file, "\"scene\":0", "\"scene\":0");
}

static void expect_refusal(const outcome *o, const char *error) {
    CHECK_EQUAL(o->status, LIMN_BAKE_BAD_INPUT);
    CHECK_CONTAINS(o->error, error);
}

static void test_numbers(const glb *good) {
    const float last[4] = {0, -1.5f, 0, 1}, projective[4] = {0, 0, 0, 2};
    const float not_finite[4] = {0, NAN, 0, 1};
    const float times[3] = {0.25f, 0.5f, 2}, backwards[3] = {0.25f, 0.25f, 2};
    const float place[3] = {0, 3, 0}, far_place[3] = {0, INFINITY, 0};
    const float lid[4] = {1, 0, 0, 0}, negative[4] = {1, -0.5f, 0, 0};
    const uint16_t moved[4] = {14, 15, 16, 17}, twice[4] = {14, 14, 16, 17};
    const uint16_t wall[3] = {0, 1, 8}, beyond[3] = {0, 1, 28};
    outcome o = read_with(good, last, not_finite, sizeof last);
    expect_refusal(&o,
                   "accessor 11 'binds' (inverse bind matrices of skin 0 'body'): element 1 is not "
                   "finite");
    o = read_with(good, last, projective, sizeof last);
    expect_refusal(&o, "skin 0 'body': the last row of inverse bind matrix 1 is not 0, 0, 0, 1");
    o = read_with(good, times, backwards, sizeof times);
    expect_refusal(&o,
                   "animation 0 'bend', channel 3: time 1 is negative, not finite, or not after");
    o = read_with(good, place, far_place, sizeof place);
    expect_refusal(&o,
                   "'lid positions' (POSITION of mesh 0 'tube', primitive 1): element 0 is not");
    o = read_with(good, lid, negative, sizeof lid);
    expect_refusal(&o, "mesh 0 'tube', primitive 1: vertex 0 has a negative weight");
    o = read_with(good, moved, twice, sizeof moved);
    expect_refusal(&o, "sparse index 1 is 14, of 28 elements");
    o = read_with(good, wall, beyond, sizeof wall);
    expect_refusal(&o, "mesh 0 'tube', primitive 0: face 0 has vertex 28, but there are 28");
}

// ---- What is mended or passed over

static void expect_note(const outcome *o, const char *note) {
    CHECK_EQUAL(o->status, LIMN_BAKE_OK);
    CHECK_TEXT(o->error, "");
    CHECK_CONTAINS(o->notes, note);
}

/// Images that are left out.
static void test_images(glb *file) {
    static const char *const elsewhere[] = {"/etc/passwd", "../../a.png", ".", "%2e%2e/a.png"};
    char changed[64], note[128];
    for (size_t e = 0; e < sizeof elsewhere / sizeof *elsewhere; e++) {
        snprintf(changed, sizeof changed, "\"uri\":\"%s\"", elsewhere[e]);
        snprintf(note, sizeof note, "image 0: the texture '%s' is missing", elsewhere[e]);
        const outcome o = read_changed(file, TEXTURE, changed);
        expect_note(&o, note);
        CHECK_EQUAL(o.image_size, 0);
    }
    outcome o = read_changed(file, TEXTURE, "\"name\":\"x\",\"bufferView\":0");
    expect_note(&o, "image 0 'x': it is left out: it is neither PNG nor JPEG");
    CHECK_EQUAL(o.image_size, 0);
    o = read_changed(file, TEXTURE, "\"uri\":\"data:image/webp;base64,UklGRg==\"");
    expect_note(&o, "image 0: it is left out: it is neither PNG nor JPEG");
    CHECK_TEXT(o.image_name, "image 0");
    o = read_changed(file, TEXTURE, "\"uri\":\"data:image/png;base64,iVBORw0KGgo=\"");
    CHECK_EQUAL(o.image_size, 8);
    CHECK_TEXT(o.image_name, "image 0");
    o = read_changed(file, TEXTURE, "\"uri\":\"data:image/jpeg;base64,/9j/\"");
    CHECK_EQUAL(o.image_size, 3);
}

/// What has no part in the good scene.
static void test_odd(glb *file) {
    outcome o = read_changed(file, "\"WEIGHTS_0\":4}", "\"WEIGHTS_0\":4,\"JOINTS_1\":3}");
    expect_note(&o, "mesh 0 'tube', primitive 0: it has JOINTS_1 or WEIGHTS_1, but not both");
    o = read_changed(file, "\"targetNames\":[", "\"targetNames\":[\"more\",");
    expect_note(&o, "mesh 0 'tube': 2 names for 1 morph targets");
    o = read_changed(file, "\"baseColorTexture\":{\"index\":0}",
                     "\"baseColorTexture\":{\"index\":0,\"texCoord\":3}");
    expect_note(&o, "mesh 0 'tube', primitive 0: the texture of its material 'wall' needs set 3 of "
                    "texture coordinates, but the mesh has 1");
    o = read_changed(file, "\"WEIGHTS_0\":4}", "\"WEIGHTS_0\":4,\"COLOR_0\":3}");
    expect_note(&o, "COLOR_0 of mesh 0 'tube', primitive 0: mended: its integers are taken as");
    CHECK_NEAR(o.least_colour, 1 / 255.0f, 1e-9f);
}

static void test_mended(glb *file) {
    const uint8_t first[4] = {255, 0, 0, 0}, none[4] = {0, 0, 0, 0}, half[4] = {100, 0, 0, 0};
    static glb changed;
    changed = *file;
    memcpy(find_bytes(&changed, first, 4), none, 4); // both columns of the seam
    outcome o = read_changed(&changed, "\"scene\":0", "\"scene\":0");
    expect_note(&o, "mesh 0 'tube': mended: the weights of 1 vertices (the first is 0) are all 0");
    CHECK_EQUAL(o.position_count, 25); // as the first joint has all of the weight there
    changed = *file;
    memcpy(find_bytes(&changed, first, 4), half, 4);
    o = read_changed(&changed, "\"scene\":0", "\"scene\":0");
    expect_note(&o, "mesh 0 'tube': mended: the weights of 1 vertices did not sum to 1");
    o = read_changed(file, "\"WEIGHTS_0\":4}", "\"WEIGHTS_0\":4,\"JOINTS_1\":3,\"WEIGHTS_1\":4}");
    expect_note(&o, "mesh 0 'tube': mended: the weights of 28 vertices did not sum to 1");
    CHECK_EQUAL(o.influence_count, 2); // the same joints
    o = read_changed(file, "\"mode\":6,", "\"mode\":1,");
    expect_note(&o, "mesh 0 'tube', primitive 1: it has no triangles; it is passed over");
    o = read_changed(file, "\"COLOR_0\":", "\"_TEMPERATURE\":");
    expect_note(&o, "mesh 0 'tube', primitive 1: the attribute _TEMPERATURE is passed over");
    o = read_changed(file, "\"scene\":0",
                     "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"scene\":0");
    expect_note(&o, "the extension KHR_lights_punctual is passed over");
    o = read_changed(file, "\"name\":\"upper\",", "\"name\":\"upper\",\"camera\":0,");
    expect_note(&o, "node 2 'upper': its camera is passed over");
    o = read_changed(file, "\"node\":6,\"path\"", "\"node\":7,\"path\"");
    CHECK_EQUAL(o.status, LIMN_BAKE_OK); // the base turns instead
    o = read_changed(file, "\"baseColorTexture\":{\"index\":0}",
                     "\"baseColorTexture\":{\"index\":4}");
    expect_note(&o, "material 0 'wall': its texture 4 has no image that is understood");
    test_images(file);
    o = read_changed(file, "\"JOINTS_0\":7,", "");
    expect_note(&o, "the weights of 8 vertices (the first is 28) are all 0");
    CHECK_EQUAL(o.position_count, 31); // the ring below the lid moves otherwise
    CHECK_CONTAINS(o.notes, "6 positions have the place of another and are kept apart");
}

// ---- Many influences

enum { MANY = 10 };

/// A triangle whose first vertex follows ten joints, in sets of four.
static void make_many(glb *file) {
    static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    char attributes[256] = "", nodes[256] = "", joints_of_skin[64] = "";
    memset(file, 0, sizeof *file);
    const int position = glb_floats(file, "corners", corners[0], "VEC3", 3, 3);
    for (int set = 0; 4 * set < MANY; set++) {
        uint8_t joints[3][4] = {{0}};
        float weights[3][4] = {{0}};
        for (int i = 0; i < 4 && 4 * set + i < MANY; i++) {
            joints[0][i] = (uint8_t)(4 * set + i);
            weights[0][i] = (float)(1 + (4 * set + i) * 7 % MANY) / 55; // 1 to 10 of 55
        }
        weights[1][0] = weights[2][0] = set == 0;
        const int joint = glb_accessor(file, "j", joints, sizeof joints, 5121, "VEC4", 3, "");
        const int weight = glb_floats(file, "w", weights[0], "VEC4", 4, 3);
        glb_append(attributes, sizeof attributes, ",\"JOINTS_%d\":%d,\"WEIGHTS_%d\":%d", set, joint,
                   set, weight);
    }
    for (int j = 0; j < MANY; j++) {
        glb_append(nodes, sizeof nodes, ",{}");
        glb_append(joints_of_skin, sizeof joints_of_skin, "%s%d", j ? "," : "", j + 1);
    }
    glb_append(file->rest, sizeof file->rest,
               "\"nodes\":[{\"mesh\":0,\"skin\":0}%s],\"skins\":[{\"joints\":[%s]}],"
               "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":%d%s}}]}]",
               nodes, joints_of_skin, position, attributes);
}

/// The two weakest are dropped: those of joints 0 and 3, with 1 and 2 of 55.
static void test_many(void) {
    static glb file;
    make_many(&file);
    const outcome o = read_changed(&file, "\"nodes\"", "\"nodes\"");
    expect_note(&o, "2 influences dropped: a vertex has more than 8, and the strongest stay");
    CHECK_EQUAL(o.influence_count, LIMN_INFLUENCE_MAX);
    for (uint32_t i = 0; i < LIMN_INFLUENCE_MAX; i++) {
        CHECK_NEAR(o.weights[i], (10 - (float)i) / 52, 1e-6f);
        CHECK_EQUAL(o.joints[i] * 7u % MANY + 1, 10 - i);
    }
}

static void test_deep(void) {
    static glb file;
    chain_make(&file, LIMN_FORMAT_DEPTH_OF_JOINTS - 1);
    outcome o = read_changed(&file, "\"nodes\"", "\"nodes\"");
    CHECK_EQUAL(o.status, LIMN_BAKE_OK);
    chain_make(&file, LIMN_FORMAT_DEPTH_OF_JOINTS);
    o = read_changed(&file, "\"nodes\"", "\"nodes\"");
    expect_refusal(&o, "node 256: more than 254 joints above it");
}

/// Bytes that end anywhere are refused, or as good as whole.
static void test_truncated(const glb *file) {
    static char json[1 << 16];
    size_t size;
    glb_json(file, json, sizeof json);
    unsigned char *const bytes = glb_make(json, file->bytes, file->size, &size);
    for (size_t end = 0; end < size; end += end < 64 ? 1 : 97)
        CHECK_EQUAL(read_bytes(bytes, end).status, LIMN_BAKE_BAD_INPUT);
    char words[96];
    snprintf(words, sizeof words, "its header says %zu bytes, but it has %zu bytes", size,
             size - 1);
    CHECK_CONTAINS(read_bytes(bytes, size - 1).error, words);
    bytes[15]++; // of the length of the JSON
    CHECK_CONTAINS(read_bytes(bytes, size).error, "bytes from byte 20 on reaches beyond its ");
    bytes[15]--;
    CHECK_EQUAL(read_bytes(bytes, size).status, LIMN_BAKE_OK);
    free(bytes);
}

int main(void) {
    static glb file;
    tube_make(&file);
    const outcome good = read_changed(&file, "\"scene\":0", "\"scene\":0");
    CHECK_EQUAL(good.status, LIMN_BAKE_OK);
    CHECK_EQUAL(good.source_count, 4);
    CHECK_EQUAL(good.influence_count, 2);
    CHECK_EQUAL(good.channel_count, 2);
    CHECK_EQUAL(good.value_counts[0], TUBE_VERTICES + LID_VERTICES - 1); // the seam has two
    CHECK_EQUAL(good.value_counts[1], 25 + LID_VERTICES - 1);
    CHECK_EQUAL(good.tags.crease_count, 2);
    CHECK_EQUAL(good.tags.sharp_vertex_count, 1);
    CHECK_EQUAL(good.tags.boundary, LIMN_BOUNDARY_EDGE_AND_CORNER);
    test_refusals(&file);
    test_numbers(&file);
    test_mended(&file);
    test_odd(&file);
    test_many();
    test_deep();
    test_truncated(&file);
    return check_report();
}
