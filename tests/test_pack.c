/* SPDX-License-Identifier: MIT */
/* Opening a file: what the view shows of a good one, and which result each kind of damage gives. */
#include "packs.h"

static const limn_bake_desc with_normals = {.normals = LIMN_NORMALS_EXACT};
static const limn_bake_desc butterfly = {.scheme = LIMN_SCHEME_BUTTERFLY,
                                         .normals = LIMN_NORMALS_EXACT};
static const limn_bake_desc catmark = {.scheme = LIMN_SCHEME_CATMARK,
                                       .normals = LIMN_NORMALS_EXACT};

#ifdef TEST_WITH_XXHASH
#include <xxhash.h>
#endif

// ---- Views

static bool is_permutation(const limn_mesh *mesh) {
    unsigned char *const seen = calloc(mesh->patch_count, 1);
    if (!seen) abort();
    bool valid = true;
    for (uint32_t p = 0; p < mesh->patch_count; p++) {
        const uint32_t face = limn_mesh_face(mesh, p).face;
        valid = valid && face < mesh->patch_count && !seen[face];
        if (valid) seen[face] = 1;
    }
    free(seen);
    return valid;
}

/// What the patches say about one control point that is their corner.
typedef struct corner {
    bool known;
    float limit[3];
    uint32_t valence, boundary;
} corner;

static void check_corner(corner *seen, const corner *now) {
    if (!seen->known) *seen = *now;
    CHECK(memcmp(seen->limit, now->limit, sizeof now->limit) == 0);
    CHECK_EQUAL(seen->valence, now->valence);
    CHECK_EQUAL(seen->boundary, now->boundary);
}

/// At level 0 the vertices of a patch are its corners. Turned the right way, all patches round a
/// control point agree on its limit, its valence and whether it lies on a boundary.
static void check_rotations(const mesh_case *expected, const limn_mesh *mesh) {
    const uint32_t size = mesh->domain->corner_count;
    corner corners[WHEEL_SIZE + 1] = {0};
    float *const vertices = evaluate(mesh, 0);
    for (uint32_t r = 0; r < mesh->run_count; r++) {
        const limn_file_run *const run = &mesh->runs[r];
        const limn_file_class *const class = &mesh->classes[run->class_index];
        for (uint32_t p = run->first_patch; p < run->first_patch + run->patch_count; p++) {
            const limn_patch_face face = limn_mesh_face(mesh, p);
            for (uint32_t c = 0; c < size; c++) {
                const uint32_t at = size * face.face + (c + face.rotation) % size;
                corner now = {.known = true,
                              .valence = class->valences[c],
                              .boundary = class->boundary_corners >> c & 1};
                memcpy(now.limit, vertices + 3 * (size * (size_t)p + c), sizeof now.limit);
                check_corner(&corners[expected->faces[at]], &now);
            }
        }
    }
    free(vertices);
}

static void check_bounds(const mesh_case *expected, const limn_mesh *mesh) {
    for (int axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY;
        for (uint32_t i = 0; i < mesh->domain->corner_count * expected->face_count; i++) {
            const uint32_t c = expected->faces[i]; // what no face uses does not count
            low = fminf(low, expected->positions[3 * c + (uint32_t)axis]);
            high = fmaxf(high, expected->positions[3 * c + (uint32_t)axis]);
        }
        CHECK(mesh->bounds_min[axis] == low && mesh->bounds_max[axis] == high);
    }
}

static void check_view(const mesh_case *expected, const limn_pack *pack, uint32_t m) {
    const limn_mesh mesh = limn_pack_mesh(pack, m);
    CHECK_TEXT(mesh.name, expected->name);
    CHECK(mesh.domain ==
          limn_domain_get(expected->face_sizes ? LIMN_DOMAIN_QUAD : LIMN_DOMAIN_TRIANGLE));
    CHECK(mesh.kernels == pack->kernels);
    CHECK_EQUAL(mesh.patch_count, expected->face_count);
    if (!CHECK_EQUAL(mesh.control_count, expected->position_count)) return;
    CHECK(memcmp(mesh.controls, expected->positions, mesh.control_count * 3 * sizeof(float)) == 0);
    check_bounds(expected, &mesh);
    CHECK(is_permutation(&mesh));
    check_rotations(expected, &mesh);
}

static void check_views(const limn_bake_desc *desc, const mesh_case *const *meshes, size_t count,
                        const char *info) {
    const blob file = bake_with(desc, meshes, count);
    limn_pack pack;
    if (CHECK_EQUAL(limn_pack_open(&pack, file.bytes, file.size), LIMN_OK)) {
        CHECK(pack.blob == file.bytes);
        CHECK_EQUAL(pack.blob_size, file.size);
        CHECK_TEXT(pack.info, info);
        CHECK(pack.kernels == limn_kernels_select(LIMN_ISA_ALL, LIMN_FAMILY_REPRODUCIBLE));
        CHECK_EQUAL(pack.class_count, header_of(&file)->class_count);
        CHECK_EQUAL(pack.mesh_count, count);
        for (uint32_t m = 0; m < pack.mesh_count; m++)
            check_view(meshes[m], &pack, m);
    }
    free(file.bytes);
}

static void test_views(void) {
    const mesh_case *const meshes[] = {&tetrahedron, &twin, &strip, &wheel};
    check_views(NULL, meshes, 4, "scheme=loop weights=loop boundary=edge-only normals=none");
    check_views(&butterfly, meshes, 3,
                "scheme=butterfly tension=0 boundary=edge-only normals=exact");
    check_views(&catmark, (const mesh_case *[]){&box}, 1,
                "scheme=catmark boundary=edge-only normals=exact");
}

static void test_wide_class(void) {
    const blob file = bake((const mesh_case *[]){&tetrahedron, &wheel}, 2);
    const limn_file_run *const run = runs_of(&file, 1);
    CHECK(classes_of(&file)[run->class_index].control_count > LIMN_FORMAT_NARROW_SLOTS);
    free(file.bytes);
}

/// A mesh of a kind that is there already brings no tables.
static void test_sharing(void) {
    const blob one = bake((const mesh_case *[]){&tetrahedron, &wheel}, 2);
    const blob two = bake((const mesh_case *[]){&tetrahedron, &wheel, &twin}, 3);
    CHECK_EQUAL(header_of(&two)->class_count, header_of(&one)->class_count);
    CHECK_EQUAL(find_chunk(&two, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES)->size,
                find_chunk(&one, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES)->size);
    free(one.bytes);
    free(two.bytes);
}

/// Vertices with the same surroundings share the masks of their normals.
static void test_sharing_masks(void) {
    const limn_bake_desc *const descs[] = {&with_normals, &butterfly};
    for (size_t d = 0; d < COUNT(descs); d++) {
        const blob file = bake_with(descs[d], (const mesh_case *[]){&tetrahedron, &strip}, 2);
        CHECK_EQUAL(find_chunk(&file, TETRAHEDRON, LIMN_CHUNK_RINGS)->size, 12 * sizeof(uint32_t));
        CHECK_EQUAL(find_chunk(&file, TETRAHEDRON, LIMN_CHUNK_WEIGHTS)->size,
                    2 * 3 * sizeof(float));
        free(file.bytes);
    }
}

// ---- Damage that the header shows

static void test_sizes(void) {
    const blob file = bake_tetrahedron();
    for (size_t size = 0; size < file.size; size++) {
        const blob prefix = copy_blob(&file, size);
        CHECK_EQUAL(open_result(prefix.bytes, size), LIMN_ERROR_TRUNCATED);
        free(prefix.bytes);
    }
    CHECK_EQUAL(open_result(NULL, 0), LIMN_ERROR_TRUNCATED);

    const blob longer = make_blob(file.size + 1);
    memcpy(longer.bytes, file.bytes, file.size);
    longer.bytes[file.size] = 0;
    CHECK_EQUAL(open_result(longer.bytes, file.size), LIMN_OK);
    CHECK_EQUAL(open_result(longer.bytes, file.size + 1), LIMN_ERROR_SIZE);
    free(longer.bytes);
    free(file.bytes);
}

static void test_alignment(void) {
    const blob file = bake_tetrahedron();
    const blob room = make_blob(file.size + LIMN_FORMAT_ALIGNMENT);
    for (size_t offset = 0; offset <= LIMN_FORMAT_ALIGNMENT; offset++) {
        memcpy(room.bytes + offset, file.bytes, file.size);
        const bool aligned = offset % LIMN_FORMAT_ALIGNMENT == 0;
        CHECK_EQUAL(open_result(room.bytes + offset, file.size),
                    aligned ? LIMN_OK : LIMN_ERROR_ALIGNMENT);
    }
    free(room.bytes);
    free(file.bytes);
}

static void test_headers(void) {
    const blob file = bake_tetrahedron();
    limn_file_header *const header = header_of(&file);
    const limn_file_header good = *header;
    for (size_t c = 0; c < sizeof header->magic; c++) {
        header->magic[c] = (char)(header->magic[c] ^ 0x20);
        CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_ERROR_MAGIC);
        *header = good;
    }
    const uint32_t versions[] = {0, LIMN_FORMAT_VERSION + 1, LIMN_FORMAT_VERSION << 24, UINT32_MAX};
    for (size_t v = 0; v < COUNT(versions); v++) {
        header->version = versions[v];
        CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_ERROR_VERSION);
        *header = good;
    }
    header->size = UINT64_MAX;
    CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_ERROR_TRUNCATED);
    header->size = 0;
    CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_ERROR_SIZE);
    *header = good;
    header->checksum ^= 1;
    CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_ERROR_CHECKSUM);
    free(file.bytes);
}

// ---- Damage anywhere

/// Every single changed byte is found, in the gaps between chunks too.
static void test_changed_bytes(void) {
    const unsigned char patterns[] = {0x01, 0x80, 0xff};
    const blob file = bake_tetrahedron();
    for (size_t at = 0; at < file.size; at++) {
        for (size_t p = 0; p < COUNT(patterns); p++) {
            file.bytes[at] ^= patterns[p];
            CHECK(open_result(file.bytes, file.size) != LIMN_OK);
            file.bytes[at] ^= patterns[p];
        }
    }
    CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_OK);
    free(file.bytes);
}

static void test_mended_bytes(void) {
    const blob file = bake_tetrahedron();
    check_mended_bytes(&file);
    free(file.bytes);
}

// ---- Damage of every kind

WITHOUT(without_info, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_INFO)
WITHOUT(without_classes, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLASSES)
WITHOUT(without_tables, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES)
WITHOUT(without_mesh, STRIP, LIMN_CHUNK_MESH)
WITHOUT(without_name, STRIP, LIMN_CHUNK_NAME)
WITHOUT(without_controls, STRIP, LIMN_CHUNK_CONTROLS)
WITHOUT(without_runs, STRIP, LIMN_CHUNK_RUNS)
WITHOUT(without_faces, STRIP, LIMN_CHUNK_FACES)
WITHOUT(without_indices, STRIP, LIMN_CHUNK_INDICES)
WITHOUT(without_slots, STRIP, LIMN_CHUNK_SLOTS)
WITHOUT(without_errors, STRIP, LIMN_CHUNK_ERRORS)

static void no_chunks(const blob *file) {
    header_of(file)->chunk_count = 0;
}
static void too_many_chunks(const blob *file) {
    header_of(file)->chunk_count = UINT32_MAX;
}
static void fewer_meshes(const blob *file) {
    header_of(file)->mesh_count--;
}
static void more_meshes(const blob *file) {
    header_of(file)->mesh_count = UINT32_MAX;
}
static void repeated_chunk(const blob *file) {
    directory_of(file)[1] = directory_of(file)[0];
}
static void unsorted_chunks(const blob *file) {
    const limn_file_chunk first = directory_of(file)[3];
    directory_of(file)[3] = directory_of(file)[4];
    directory_of(file)[4] = first;
}
static void misaligned_chunk(const blob *file) {
    tables_of(file)->offset += 4;
}
static void chunk_behind_the_end(const blob *file) {
    tables_of(file)->offset = (file->size / LIMN_FORMAT_ALIGNMENT + 1) * LIMN_FORMAT_ALIGNMENT;
    tables_of(file)->size = 0;
}
static void chunk_over_the_end(const blob *file) {
    tables_of(file)->size = file->size - tables_of(file)->offset + 1;
}
static void chunk_size_overflows(const blob *file) {
    tables_of(file)->size = UINT64_MAX - 63;
}
/// Not damage: tables alone are a file too.
static void no_meshes(const blob *file) {
    header_of(file)->mesh_count = 0;
    header_of(file)->chunk_count = 3;
}
static void fewer_classes(const blob *file) {
    header_of(file)->class_count--;
}

/// Not damage: what is reserved is not read.
static void reserved_words(const blob *file) {
    memset(header_of(file)->reserved, 0xff, sizeof header_of(file)->reserved);
    directory_of(file)->reserved = UINT32_MAX;
    runs_of(file, STRIP)->reserved = UINT32_MAX;
    for (uint32_t c = 0; c < header_of(file)->class_count; c++)
        classes_of(file)[c].reserved = UINT32_MAX;
}

static void open_info(const blob *file) {
    find_chunk(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_INFO)->size--;
}
static void open_name(const blob *file) {
    char *const name = chunk_data(file, WHEEL, LIMN_CHUNK_NAME);
    name[strlen(name)] = '!';
}
static void empty_name(const blob *file) {
    find_chunk(file, WHEEL, LIMN_CHUNK_NAME)->size = 0;
}

static void class_domain(const blob *file) {
    classes_of(file)->domain = LIMN_DOMAIN_COUNT;
}
static void class_depth(const blob *file) {
    classes_of(file)->depth = LIMN_LEVEL_MAX + 1;
}
static void class_without_controls(const blob *file) {
    classes_of(file)->control_count = 0;
}
static void class_with_many_controls(const blob *file) {
    classes_of(file)->control_count = UINT32_MAX;
}
static void class_bound_negative(const blob *file) {
    classes_of(file)->negative = -0x1p-20f;
}
static void class_bound_infinite(const blob *file) {
    classes_of(file)->negative = INFINITY;
}
static void class_bound_not_a_number(const blob *file) {
    classes_of(file)->negative = NAN;
}
/// Not damage: any bound will do.
static void class_bound_large(const blob *file) {
    classes_of(file)->negative = 0x1p100f;
}
static void class_table_misaligned(const blob *file) {
    classes_of(file)->table_offset += 4;
}
static void class_table_outside(const blob *file) {
    classes_of(file)->table_offset = tables_of(file)->size;
}
static void class_table_overflows(const blob *file) {
    classes_of(file)->table_offset = UINT64_MAX - 63;
}
static void table_not_a_number(const blob *file) {
    *(float *)chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES) = NAN;
}
static void table_infinite(const blob *file) {
    float *const table = chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_TABLES);
    table[tables_of(file)->size / sizeof *table - 1] = -INFINITY;
}

static void mesh_controls(const blob *file) {
    record_of(file, STRIP)->control_count++;
}
static void mesh_patches(const blob *file) {
    record_of(file, STRIP)->patch_count--;
}
static void mesh_runs(const blob *file) {
    record_of(file, STRIP)->run_count = UINT32_MAX;
}
static void mesh_indices(const blob *file) {
    record_of(file, STRIP)->index_count = UINT64_MAX / 4 + 1;
}
static void mesh_errors(const blob *file) {
    find_chunk(file, STRIP, LIMN_CHUNK_ERRORS)->size -= sizeof(uint16_t);
}
static void mesh_divided(const blob *file) {
    record_of(file, STRIP)->divided_count = 1;
}
static void mesh_divided_overflows(const blob *file) {
    record_of(file, STRIP)->divided_count = UINT32_MAX;
}
/// Not damage: faces are numbered with 32 bits, and holes have no data.
static void mesh_holes(const blob *file) {
    record_of(file, STRIP)->hole_count = UINT32_MAX - record_of(file, STRIP)->patch_count;
}
static void mesh_holes_overflow(const blob *file) {
    mesh_holes(file);
    record_of(file, STRIP)->hole_count++;
}
static void mesh_of_quads(const blob *file) {
    record_of(file, STRIP)->domain = LIMN_DOMAIN_QUAD;
}
static void mesh_domain(const blob *file) {
    record_of(file, STRIP)->domain = LIMN_DOMAIN_COUNT;
}

static void control_not_a_number(const blob *file) {
    controls_of(file, WHEEL)[3 * WHEEL_SIZE + 2] = NAN;
}
static void bounds_infinite(const blob *file) {
    record_of(file, WHEEL)->bounds_max[2] = INFINITY;
}
static void origin_infinite(const blob *file) {
    record_of(file, WHEEL)->origin[0] = INFINITY;
}

static void run_class(const blob *file) {
    runs_of(file, STRIP)[1].class_index = header_of(file)->class_count;
}
static void run_first_patch(const blob *file) {
    runs_of(file, STRIP)[1].first_patch++;
}
static void run_first_index(const blob *file) {
    runs_of(file, STRIP)[1].first_index++;
}
static void run_first_slot(const blob *file) {
    runs_of(file, WHEEL)[0].first_slot++;
}
static void run_empty(const blob *file) {
    runs_of(file, STRIP)[0].patch_count = 0;
}
static void run_too_long(const blob *file) {
    runs_of(file, STRIP)[0].patch_count = UINT32_MAX;
}
static void run_missing(const blob *file) {
    record_of(file, STRIP)->run_count--;
    find_chunk(file, STRIP, LIMN_CHUNK_RUNS)->size -= sizeof(limn_file_run);
}
static void slots_missing(const blob *file) {
    find_chunk(file, WHEEL, LIMN_CHUNK_SLOTS)->size -= 2;
}

static void face_outside(const blob *file) {
    faces_of(file, STRIP)[2] = 3 << 2;
}
static void face_rotation(const blob *file) {
    faces_of(file, STRIP)[0] |= 3;
}

static void index_outside(const blob *file) {
    indices_of(file, TETRAHEDRON)[3] = 4;
}
static void index_far_outside(const blob *file) {
    indices_of(file, TETRAHEDRON)[15] = UINT32_MAX;
}
static void index_repeated(const blob *file) {
    indices_of(file, TETRAHEDRON)[4] = indices_of(file, TETRAHEDRON)[5];
}
static void index_descending(const blob *file) {
    uint32_t *const indices = indices_of(file, WHEEL);
    const uint32_t last = indices[WHEEL_SIZE];
    indices[WHEEL_SIZE] = indices[WHEEL_SIZE - 1];
    indices[WHEEL_SIZE - 1] = last;
}
static void slot_narrow(const blob *file) {
    *(uint8_t *)chunk_data(file, TETRAHEDRON, LIMN_CHUNK_SLOTS) = 4;
}
static void slot_wide(const blob *file) {
    uint16_t *const slots = chunk_data(file, WHEEL, LIMN_CHUNK_SLOTS);
    slots[WHEEL_SIZE * (WHEEL_SIZE + 1) - 1] = WHEEL_SIZE + 1;
}

static void slot_repeated(const blob *file) {
    uint8_t *const slots = chunk_data(file, TETRAHEDRON, LIMN_CHUNK_SLOTS);
    slots[1] = slots[0];
}
static void class_pairs_exceed(const blob *file) {
    classes_of(file)->pair_count = (uint16_t)((classes_of(file)->control_count + 1) / 2);
}
static void class_pairs_in_wide(const blob *file) {
    limn_file_class *class = classes_of(file);
    while (class->control_count <= LIMN_FORMAT_PAIRED_MAX)
        class ++;
    class->pair_count = 1;
}

static const damage damages[] = {
    DAMAGE(without_info, LIMN_ERROR_CHUNK),
    DAMAGE(without_classes, LIMN_ERROR_CHUNK),
    DAMAGE(without_tables, LIMN_ERROR_CHUNK),
    DAMAGE(without_mesh, LIMN_ERROR_CHUNK),
    DAMAGE(without_name, LIMN_ERROR_CHUNK),
    DAMAGE(without_controls, LIMN_ERROR_CHUNK),
    DAMAGE(without_runs, LIMN_ERROR_CHUNK),
    DAMAGE(without_faces, LIMN_ERROR_CHUNK),
    DAMAGE(without_indices, LIMN_ERROR_CHUNK),
    DAMAGE(without_slots, LIMN_ERROR_CHUNK),
    DAMAGE(without_errors, LIMN_ERROR_CHUNK),
    DAMAGE(no_chunks, LIMN_ERROR_CHUNK),
    DAMAGE(too_many_chunks, LIMN_ERROR_CHUNK),
    DAMAGE(fewer_meshes, LIMN_ERROR_CHUNK),
    DAMAGE(more_meshes, LIMN_ERROR_CHUNK),
    DAMAGE(repeated_chunk, LIMN_ERROR_CHUNK),
    DAMAGE(unsorted_chunks, LIMN_ERROR_CHUNK),
    DAMAGE(misaligned_chunk, LIMN_ERROR_CHUNK),
    DAMAGE(chunk_behind_the_end, LIMN_ERROR_CHUNK),
    DAMAGE(chunk_over_the_end, LIMN_ERROR_CHUNK),
    DAMAGE(chunk_size_overflows, LIMN_ERROR_CHUNK),
    DAMAGE(no_meshes, LIMN_OK),
    DAMAGE(fewer_classes, LIMN_ERROR_CHUNK),
    DAMAGE(reserved_words, LIMN_OK),
    DAMAGE(open_info, LIMN_ERROR_TEXT),
    DAMAGE(open_name, LIMN_ERROR_TEXT),
    DAMAGE(empty_name, LIMN_ERROR_TEXT),
    DAMAGE(class_domain, LIMN_ERROR_CLASS),
    DAMAGE(class_depth, LIMN_ERROR_CLASS),
    DAMAGE(class_without_controls, LIMN_ERROR_CLASS),
    DAMAGE(class_with_many_controls, LIMN_ERROR_CLASS),
    DAMAGE(class_bound_negative, LIMN_ERROR_CLASS),
    DAMAGE(class_bound_infinite, LIMN_ERROR_CLASS),
    DAMAGE(class_bound_not_a_number, LIMN_ERROR_CLASS),
    DAMAGE(class_bound_large, LIMN_OK),
    DAMAGE(class_table_misaligned, LIMN_ERROR_CLASS),
    DAMAGE(class_table_outside, LIMN_ERROR_CLASS),
    DAMAGE(class_table_overflows, LIMN_ERROR_CLASS),
    DAMAGE(table_not_a_number, LIMN_ERROR_TABLE),
    DAMAGE(table_infinite, LIMN_ERROR_TABLE),
    DAMAGE(mesh_controls, LIMN_ERROR_MESH),
    DAMAGE(mesh_patches, LIMN_ERROR_MESH),
    DAMAGE(mesh_runs, LIMN_ERROR_MESH),
    DAMAGE(mesh_indices, LIMN_ERROR_MESH),
    DAMAGE(mesh_errors, LIMN_ERROR_MESH),
    DAMAGE(mesh_divided, LIMN_ERROR_MESH),
    DAMAGE(mesh_divided_overflows, LIMN_ERROR_MESH),
    DAMAGE(mesh_holes, LIMN_OK),
    DAMAGE(mesh_holes_overflow, LIMN_ERROR_MESH),
    DAMAGE(mesh_of_quads, LIMN_ERROR_MESH),
    DAMAGE(mesh_domain, LIMN_ERROR_MESH),
    DAMAGE(control_not_a_number, LIMN_ERROR_CONTROLS),
    DAMAGE(bounds_infinite, LIMN_ERROR_CONTROLS),
    DAMAGE(origin_infinite, LIMN_ERROR_CONTROLS),
    DAMAGE(run_class, LIMN_ERROR_RUN),
    DAMAGE(run_first_patch, LIMN_ERROR_RUN),
    DAMAGE(run_first_index, LIMN_ERROR_RUN),
    DAMAGE(run_first_slot, LIMN_ERROR_RUN),
    DAMAGE(run_empty, LIMN_ERROR_RUN),
    DAMAGE(run_too_long, LIMN_ERROR_RUN),
    DAMAGE(run_missing, LIMN_ERROR_RUN),
    DAMAGE(slots_missing, LIMN_ERROR_RUN),
    DAMAGE(face_outside, LIMN_ERROR_FACE),
    DAMAGE(face_rotation, LIMN_ERROR_FACE),
    DAMAGE(index_outside, LIMN_ERROR_INDEX),
    DAMAGE(index_far_outside, LIMN_ERROR_INDEX),
    DAMAGE(index_repeated, LIMN_ERROR_INDEX),
    DAMAGE(index_descending, LIMN_ERROR_INDEX),
    DAMAGE(slot_narrow, LIMN_ERROR_SLOT),
    DAMAGE(slot_wide, LIMN_ERROR_SLOT),
    DAMAGE(slot_repeated, LIMN_ERROR_INDEX),
    DAMAGE(class_pairs_exceed, LIMN_ERROR_CLASS),
    DAMAGE(class_pairs_in_wide, LIMN_ERROR_CLASS),
};

static void test_damages(void) {
    const blob file = bake((const mesh_case *[]){&tetrahedron, &strip, &wheel}, 3);
    CHECK(runs_of(&file, STRIP)[1].first_patch > 0);
    check_damages(&file, damages, COUNT(damages));
    free(file.bytes);
}

// ---- Chunks that this version does not know

static void check_inserted(uint32_t mesh, uint32_t kind, uint32_t flags, limn_result expected) {
    const blob file = bake_tetrahedron();
    const blob longer =
        insert_chunk(&file, &(limn_file_chunk){.mesh = mesh, .kind = kind, .flags = flags});
    CHECK_EQUAL(open_result(longer.bytes, longer.size), expected);
    if (expected == LIMN_OK) CHECK(check_safe(&longer));
    free(longer.bytes);
    free(file.bytes);
}

/// The order of the directory is asked for from its very beginning.
static void test_order(void) {
    const blob file = bake_tetrahedron();
    const blob longer =
        insert_chunk(&file, &(limn_file_chunk){.mesh = LIMN_FORMAT_NO_MESH, .kind = 0});
    const blob longest =
        insert_chunk(&longer, &(limn_file_chunk){.mesh = LIMN_FORMAT_NO_MESH, .kind = 1});
    CHECK_EQUAL(directory_of(&longest)[1].kind, 1);
    CHECK_EQUAL(open_result(longest.bytes, longest.size), LIMN_OK);
    directory_of(&longest)[0].kind = 2;
    fix_checksum(&longest);
    CHECK_EQUAL(open_result(longest.bytes, longest.size), LIMN_ERROR_CHUNK);
    free(longest.bytes);
    free(longer.bytes);
    free(file.bytes);
}

static void test_unknown_chunks(void) {
    const uint32_t places[] = {LIMN_FORMAT_NO_MESH, 0};
    const uint32_t kinds[] = {LIMN_FORMAT_KIND('A', 'A', 'A', 'A'),
                              LIMN_FORMAT_KIND('K', 'I', 'N', 'D'),
                              LIMN_FORMAT_KIND('z', 'z', 'z', 'z'), UINT32_MAX, 0};
    for (size_t p = 0; p < COUNT(places); p++) {
        for (size_t k = 0; k < COUNT(kinds); k++) {
            check_inserted(places[p], kinds[k], 0, LIMN_OK);
            check_inserted(places[p], kinds[k], LIMN_CHUNK_REQUIRED, LIMN_ERROR_UNKNOWN_CHUNK);
        }
    }
    check_inserted(0, LIMN_CHUNK_TABLES, LIMN_CHUNK_REQUIRED, LIMN_ERROR_UNKNOWN_CHUNK);
    check_inserted(LIMN_FORMAT_NO_MESH, LIMN_CHUNK_SLOTS, LIMN_CHUNK_REQUIRED,
                   LIMN_ERROR_UNKNOWN_CHUNK);
    check_inserted(0, LIMN_CHUNK_SLOTS, LIMN_CHUNK_REQUIRED, LIMN_ERROR_CHUNK);
    check_inserted(1, LIMN_FORMAT_KIND('A', 'A', 'A', 'A'), 0, LIMN_ERROR_CHUNK);
}

// ---- Texts, checksum

static void test_result_texts(void) {
    static const limn_result results[] = {
#define RESULT(name, text) name,
        LIMN_RESULTS(RESULT)
#undef RESULT
    };
    const char *const unknown = limn_result_text((limn_result)COUNT(results));
    CHECK_TEXT(unknown, "not a limn_result");
    CHECK_TEXT(limn_result_text((limn_result)0x7fffffff), unknown);
    for (size_t a = 0; a < COUNT(results); a++) {
        CHECK_EQUAL(results[a], a);
        CHECK(strlen(limn_result_text(results[a])) > 5);
        CHECK(strcmp(limn_result_text(results[a]), unknown) != 0);
        for (size_t b = 0; b < a; b++)
            CHECK(strcmp(limn_result_text(results[a]), limn_result_text(results[b])) != 0);
    }
}

static void test_checksum(void) {
    // The published value for nothing; the others are compared with the library.
    CHECK(limni_checksum("", 0) == 0xEF46DB3751D8E999u);
#ifdef TEST_WITH_XXHASH
    unsigned char bytes[201 + 3];
    for (size_t b = 0; b < sizeof bytes; b++)
        bytes[b] = (unsigned char)(b * 167 + (b >> 3));
    for (size_t size = 0; size <= 200; size++) {
        for (size_t offset = 0; offset < 3; offset++)
            CHECK(limni_checksum(bytes + offset, size) == XXH64(bytes + offset, size, 0));
    }
#else
    printf("built without xxhash: the checksum is not compared\n");
#endif
}

/// A class that is good itself, but of the other domain.
static void test_run_of_other_domain(void) {
    const blob file = bake_tetrahedron();
    const blob longer = grow_tables(&file, 1 << 14);
    CHECK_EQUAL(open_result(longer.bytes, longer.size), LIMN_OK);
    classes_of(&longer)->domain = LIMN_DOMAIN_QUAD;
    classes_of(&longer)->pair_count = 0;
    fix_checksum(&longer);
    CHECK_EQUAL(open_result(longer.bytes, longer.size), LIMN_ERROR_RUN);
    free(longer.bytes);
    free(file.bytes);
}

/// A run without patches that follows the others without a gap.
static void test_empty_run(void) {
    const blob file = bake_tetrahedron();
    limn_file_chunk *const chunk = find_chunk(&file, 0, LIMN_CHUNK_RUNS);
    limn_file_run *const run = runs_of(&file, 0);
    const uint64_t index_count = record_of(&file, 0)->index_count;
    CHECK_EQUAL(chunk->size, sizeof *run); // and there is room for another before the next chunk
    chunk->size += sizeof *run;
    record_of(&file, 0)->run_count++;
    run[1] = (limn_file_run){
        .first_patch = run->patch_count, .first_index = index_count, .first_slot = index_count};
    fix_checksum(&file);
    CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_ERROR_RUN);
    free(file.bytes);
}

/// What must be refused of the data for normals.
static void test_damaged_normals(void) {
    const blob file = bake_with(&with_normals, (const mesh_case *[]){&tetrahedron}, 1);
    const limn_file_chunk *const records = find_chunk(&file, 0, LIMN_CHUNK_NORMALS);
    const limn_file_chunk *const ring = find_chunk(&file, 0, LIMN_CHUNK_RINGS);
    const limn_file_chunk *const weights = find_chunk(&file, 0, LIMN_CHUNK_WEIGHTS);
    const limn_file_chunk *const classes =
        find_chunk(&file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_CLASSES);
    const struct {
        uint64_t at;
        uint32_t value;
        limn_result expected;
    } cases[] = {
        {records->offset + offsetof(limn_file_normal, first_ring), 10, LIMN_ERROR_NORMALS},
        {records->offset + offsetof(limn_file_normal, ring_count), 0xffffffff, LIMN_ERROR_NORMALS},
        // One ring for two base vertices; for all of them, normals would take quadratic time.
        {records->offset + sizeof(limn_file_normal), 0, LIMN_ERROR_NORMALS},
        {records->offset + offsetof(limn_file_normal, first_weight), 1, LIMN_ERROR_NORMALS},
        {ring->offset, 4, LIMN_ERROR_NORMALS},
        {weights->offset, 0x7fc00000, LIMN_ERROR_NORMALS},
        {classes->offset + offsetof(limn_file_class, table_count), 1, LIMN_ERROR_NORMALS},
        {classes->offset + offsetof(limn_file_class, table_count), 2, LIMN_ERROR_CLASS},
        {classes->offset + offsetof(limn_file_class, table_count), 4, LIMN_ERROR_CLASS},
    };
    for (size_t c = 0; c < COUNT(cases); c++) {
        const blob changed = copy_blob(&file, file.size);
        memcpy(changed.bytes + cases[c].at, &cases[c].value, sizeof cases[c].value);
        fix_checksum(&changed);
        CHECK_EQUAL(open_result(changed.bytes, changed.size), cases[c].expected);
        free(changed.bytes);
    }
    free(file.bytes);
}

/// Three edges that stay sharp around one vertex: a corner, and three darts.
static const uint32_t crease_edges[] = {0, 1, 0, 2, 0, 3};
static const float crease_sharpness[] = {10, 10, 10};

static mesh_case creased_tetrahedron(void) {
    mesh_case creased = tetrahedron;
    creased.crease_edges = crease_edges;
    creased.crease_sharpness = crease_sharpness;
    creased.crease_count = 3;
    return creased;
}

static void remove_normals(const blob *file) {
    remove_chunk(file, 0, LIMN_CHUNK_NORMALS);
    remove_chunk(file, 0, LIMN_CHUNK_RINGS);
    remove_chunk(file, 0, LIMN_CHUNK_WEIGHTS);
}
static void sides_alone(const blob *file) {
    remove_normals(file);
    remove_chunk(file, 0, LIMN_CHUNK_CORNERS);
}
static void corners_alone(const blob *file) {
    remove_normals(file);
    remove_chunk(file, 0, LIMN_CHUNK_SIDES);
}
/// Not damage: positions have their creases without.
static void creases_alone(const blob *file) {
    sides_alone(file);
    remove_chunk(file, 0, LIMN_CHUNK_SIDES);
}
WITHOUT(normals_without_rings, 0, LIMN_CHUNK_RINGS)
WITHOUT(normals_without_weights, 0, LIMN_CHUNK_WEIGHTS)
WITHOUT(normals_without_sides, 0, LIMN_CHUNK_SIDES)
WITHOUT(normals_without_corners, 0, LIMN_CHUNK_CORNERS)

static const damage crease_damages[] = {
    DAMAGE(remove_normals, LIMN_ERROR_CHUNK),
    DAMAGE(sides_alone, LIMN_ERROR_CHUNK),
    DAMAGE(corners_alone, LIMN_ERROR_CHUNK),
    DAMAGE(creases_alone, LIMN_OK),
    DAMAGE(normals_without_rings, LIMN_ERROR_CHUNK),
    DAMAGE(normals_without_weights, LIMN_ERROR_CHUNK),
    DAMAGE(normals_without_sides, LIMN_ERROR_CHUNK),
    DAMAGE(normals_without_corners, LIMN_ERROR_CHUNK),
};

/// What must be refused of the data for creases.
static void test_damaged_creases(void) {
    const mesh_case creased = creased_tetrahedron();
    const blob file = bake_with(&with_normals, (const mesh_case *[]){&creased}, 1);
    const limn_file_chunk *const creases = find_chunk(&file, 0, LIMN_CHUNK_CREASES);
    const limn_file_chunk *const sides = find_chunk(&file, 0, LIMN_CHUNK_SIDES);
    const limn_file_chunk *const corners = find_chunk(&file, 0, LIMN_CHUNK_CORNERS);
    CHECK_EQUAL(sides->size, 2 * sizeof(limn_file_side)); // two more at the corner
    const uint64_t normal = sides->offset + offsetof(limn_file_side, normal);
    const struct {
        uint64_t at;
        uint32_t value;
        limn_result expected;
    } cases[] = {
        {creases->offset, 8, LIMN_ERROR_MESH},
        {sides->offset, 4, LIMN_ERROR_NORMALS},
        {normal + offsetof(limn_file_normal, first_ring), 3,
         LIMN_ERROR_NORMALS}, // of another vertex
        {normal + offsetof(limn_file_normal, ring_count), 2, LIMN_ERROR_NORMALS},
        {normal + offsetof(limn_file_normal, first_weight), 0xffffff00, LIMN_ERROR_NORMALS},
        {corners->offset, 6, LIMN_ERROR_NORMALS},
    };
    for (size_t c = 0; c < COUNT(cases); c++) {
        const blob changed = copy_blob(&file, file.size);
        memcpy(changed.bytes + cases[c].at, &cases[c].value, sizeof cases[c].value);
        fix_checksum(&changed);
        CHECK_EQUAL(open_result(changed.bytes, changed.size), cases[c].expected);
        free(changed.bytes);
    }
    check_damages(&file, crease_damages, COUNT(crease_damages));
    check_mended_words(&file);
    free(file.bytes);
}

int main(void) {
    make_wheel();
    test_views();
    test_wide_class();
    test_sharing();
    test_sharing_masks();
    test_sizes();
    test_alignment();
    test_headers();
    test_changed_bytes();
    test_mended_bytes();
    bake_and_mend(NULL, (const mesh_case *[]){&tetrahedron, &twin}, 2);
    bake_and_mend(NULL, (const mesh_case *[]){&strip}, 1);
    bake_and_mend(&with_normals, (const mesh_case *[]){&strip, &twin}, 2);
    bake_and_mend(&butterfly, (const mesh_case *[]){&strip}, 1);
    bake_and_mend(&catmark, (const mesh_case *[]){&box}, 1);
    test_run_of_other_domain();
    test_empty_run();
    test_damaged_normals();
    test_damaged_creases();
    test_damages();
    test_unknown_chunks();
    test_order();
    test_result_texts();
    test_checksum();
    return check_report();
}
