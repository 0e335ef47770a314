/* SPDX-License-Identifier: MIT */
/*
 * Opening files whose meshes are isolated: which result each kind of damage gives. Where a check
 * keeps reads inside a chunk, what lies behind the chunk is good too, so that nothing but this
 * check can refuse the file.
 */
#include "packs.h"

static const limn_bake_desc isolated = {.isolate = LIMN_ISOLATE_ALWAYS};
static const limn_bake_desc isolated_normals = {.isolate = LIMN_ISOLATE_ALWAYS,
                                                .normals = LIMN_NORMALS_EXACT};

static limn_file_piece *pieces_of(const blob *file) {
    return chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_PIECES);
}
static limn_file_chunk *piece_chunk(const blob *file) {
    return find_chunk(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_PIECES);
}
static size_t piece_count(const blob *file) {
    return (size_t)piece_chunk(file)->size / sizeof(limn_file_piece);
}
static limn_file_chunk *columns_chunk(const blob *file) {
    return find_chunk(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_COLUMNS);
}
static limn_file_chunk *stencils_chunk(const blob *file) {
    return find_chunk(file, STRIP, LIMN_CHUNK_STENCILS);
}
static limn_file_chunk *terms_chunk(const blob *file) {
    return find_chunk(file, STRIP, LIMN_CHUNK_TERMS);
}
static uint32_t *stencils_of(const blob *file) {
    return chunk_data(file, STRIP, LIMN_CHUNK_STENCILS);
}
static limn_file_term *terms_of(const blob *file) {
    return chunk_data(file, STRIP, LIMN_CHUNK_TERMS);
}
static uint32_t stencil_count(const blob *file) {
    return record_of(file, STRIP)->point_count - record_of(file, STRIP)->control_count;
}
/// The four pieces of a class, and behind them their columns.
static uint16_t *parts_of(const blob *file, const limn_file_class *class) {
    return (uint16_t *)chunk_data(file, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_COLUMNS) +
           class->table_offset / sizeof(uint16_t);
}
/// The class whose columns come last.
static limn_file_class *last_class(const blob *file) {
    limn_file_class *last = classes_of(file);
    for (uint32_t c = 0; c < header_of(file)->class_count; c++) {
        limn_file_class *const class = classes_of(file) + c;
        if (class->table_offset > last->table_offset) last = class;
    }
    return last;
}
/// The piece whose table comes last.
static limn_file_piece *last_piece(const blob *file) {
    limn_file_piece *last = pieces_of(file);
    for (size_t p = 0; p < piece_count(file); p++) {
        limn_file_piece *const piece = pieces_of(file) + p;
        if (piece->table_offset > last->table_offset) last = piece;
    }
    return last;
}

// ---- Pieces

WITHOUT(without_pieces, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_PIECES)
WITHOUT(without_columns, LIMN_FORMAT_NO_MESH, LIMN_CHUNK_COLUMNS)

static void pieces_cut(const blob *file) {
    piece_chunk(file)->size++;
}
/// Of one more piece, in the gap behind the others, that no class has.
static void piece_kind(const blob *file) {
    limn_file_piece *const added = pieces_of(file) + piece_count(file);
    *added = pieces_of(file)[0];
    added->kind = 2;
    piece_chunk(file)->size += sizeof *added;
}
static void piece_with_many_controls(const blob *file) {
    last_piece(file)->control_count = LIMN_FORMAT_CONTROLS_MAX + 1;
}
static void piece_table_misaligned(const blob *file) {
    pieces_of(file)->table_offset += 4;
}
static void piece_table_outside(const blob *file) {
    last_piece(file)->table_offset = tables_of(file)->size + LIMN_FORMAT_ALIGNMENT;
}
static void piece_table_overflows(const blob *file) {
    pieces_of(file)->table_offset = UINT64_MAX - 63;
}
static void piece_over_the_end(const blob *file) {
    last_piece(file)->control_count++;
}
static void piece_table_count(const blob *file) {
    for (size_t p = 0; p < piece_count(file); p++)
        pieces_of(file)[p].table_count = 0;
    for (uint32_t c = 0; c < header_of(file)->class_count; c++)
        classes_of(file)[c].table_count = 0;
}

// ---- Classes in pieces

static void class_pairs(const blob *file) {
    classes_of(file)->pair_count = 1;
}
static void class_depth(const blob *file) {
    classes_of(file)->depth = LIMN_FORMAT_PIECE_DEPTH - 1;
}
/// Whole, but one byte on.
static void columns_misaligned(const blob *file) {
    limn_file_class *const class = last_class(file);
    unsigned char *const parts = (unsigned char *)parts_of(file, class);
    memmove(parts + 1, parts, (size_t)(columns_chunk(file)->size - class->table_offset));
    class->table_offset++;
    columns_chunk(file)->size++;
}
static void columns_over_the_end(const blob *file) {
    columns_chunk(file)->size -= sizeof(uint16_t);
}
static void columns_behind_the_end(const blob *file) {
    columns_chunk(file)->size = last_class(file)->table_offset - sizeof(uint16_t);
}
static void columns_overflow(const blob *file) {
    classes_of(file)->table_offset = UINT64_MAX - 1;
}
/// A piece that is there, but not counted.
static void part_outside(const blob *file) {
    piece_chunk(file)->size -= sizeof(limn_file_piece);
}
static void part_far_outside(const blob *file) {
    parts_of(file, classes_of(file))[LIMN_FORMAT_PIECE_COUNT - 1] = UINT16_MAX;
}
static void part_of_quad(const blob *file) {
    pieces_of(file)[parts_of(file, classes_of(file))[0]].domain = LIMN_DOMAIN_QUAD;
}
static void piece_domain(const blob *file) {
    pieces_of(file)->domain = LIMN_DOMAIN_COUNT;
}
/// The middle one, at a corner.
static void part_of_other_kind(const blob *file) {
    uint16_t *const parts = parts_of(file, classes_of(file));
    CHECK(pieces_of(file)[parts[3]].control_count >= pieces_of(file)[parts[0]].control_count);
    parts[0] = parts[3];
}
static void part_without_tangents(const blob *file) {
    classes_of(file)->table_count = 3;
}
static uint16_t *column_of(const blob *file, uint32_t *column_count) {
    uint16_t *const parts = parts_of(file, last_class(file));
    *column_count = pieces_of(file)[parts[LIMN_FORMAT_PIECE_COUNT - 1]].control_count;
    return parts + LIMN_FORMAT_PIECE_COUNT * (1 + last_class(file)->control_count) - 1;
}
static void column_outside(const blob *file) {
    uint32_t column_count;
    uint16_t *const column = column_of(file, &column_count);
    *column = (uint16_t)column_count;
}
static void column_far_outside(const blob *file) {
    uint32_t column_count;
    *column_of(file, &column_count) = LIMN_FORMAT_NO_COLUMN - 1;
}
/// Not damage: no piece needs to have all points.
static void column_unused(const blob *file) {
    uint32_t column_count;
    *column_of(file, &column_count) = LIMN_FORMAT_NO_COLUMN;
}

// ---- Meshes and their patches

static void set_point_count(const blob *file, uint32_t count) {
    record_of(file, STRIP)->point_count = count;
    find_chunk(file, STRIP, LIMN_CHUNK_CONTROLS)->size = count * sizeof(float[3]);
}
static void points_without_some_controls(const blob *file) {
    set_point_count(file, 2 * record_of(file, STRIP)->control_count - 1);
}
static void points_beyond_the_bind_pose(const blob *file) {
    record_of(file, STRIP)->point_count++;
}
static void points_overflow(const blob *file) {
    record_of(file, STRIP)->point_count = UINT32_MAX;
}
static void no_points(const blob *file) {
    set_point_count(file, 0);
}
/// Its base vertices are then one point, which no patch has for its corners.
static void one_divided(const blob *file) {
    record_of(file, STRIP)->divided_count = 1;
}
static void all_divided(const blob *file) {
    limn_file_mesh *const record = record_of(file, STRIP);
    record->divided_count = record->point_count - record->control_count - 1;
}
static void divided_overflows(const blob *file) {
    record_of(file, STRIP)->divided_count = UINT32_MAX;
}
/// A mesh that is not isolated, of classes in pieces.
static void point_count_of_dense(const blob *file) {
    set_point_count(file, record_of(file, STRIP)->control_count);
}
/// An isolated mesh, of which one class has a table.
static void class_of_dense(const blob *file) {
    limn_file_class *const class = &classes_of(file)[runs_of(file, STRIP)[1].class_index];
    class->depth = LIMN_FORMAT_DEPTH;
    class->table_offset = 0;
}
static void point_not_a_number(const blob *file) {
    controls_of(file, STRIP)[3 * record_of(file, STRIP)->point_count - 1] = NAN;
}

/// The k-th index of the first patch, in ascending order.
static uint32_t *ascending_index(const blob *file, uint32_t k) {
    const uint8_t *const slots = chunk_data(file, STRIP, LIMN_CHUNK_SLOTS);
    return indices_of(file, STRIP) + slots[k];
}
static uint32_t patch_size(const blob *file) {
    return classes_of(file)[runs_of(file, STRIP)->class_index].control_count;
}
static void index_of_control(const blob *file) {
    *ascending_index(file, 0) = record_of(file, STRIP)->control_count - 1;
}
static void index_outside(const blob *file) {
    *ascending_index(file, patch_size(file) - 1) = record_of(file, STRIP)->point_count;
}
/// The last corner and the point behind it, which is no corner, in each other's place.
static void corner_on_edge(const blob *file) {
    uint8_t *const slots = chunk_data(file, STRIP, LIMN_CHUNK_SLOTS);
    const uint32_t corner_end = 2 * record_of(file, STRIP)->control_count;
    uint32_t k = 0;
    while (*ascending_index(file, k) < corner_end)
        k++;
    uint32_t corner = k - 1;
    while (slots[corner] >= 3)
        corner--;
    const uint8_t slot = slots[corner];
    const uint32_t index = *ascending_index(file, corner);
    *ascending_index(file, corner) = *ascending_index(file, k);
    *ascending_index(file, k) = index;
    slots[corner] = slots[k];
    slots[k] = slot;
}

// ---- Stencils

WITHOUT(without_stencils, STRIP, LIMN_CHUNK_STENCILS)
WITHOUT(without_terms, STRIP, LIMN_CHUNK_TERMS)
static void without_both(const blob *file) {
    without_stencils(file);
    without_terms(file);
}

static void stencils_too_long(const blob *file) {
    stencils_chunk(file)->size += sizeof(uint32_t);
}
static void stencils_too_short(const blob *file) {
    stencils_chunk(file)->size -= sizeof(uint32_t);
}
static void terms_cut(const blob *file) {
    terms_chunk(file)->size++;
}
static void terms_missing(const blob *file) {
    terms_chunk(file)->size -= sizeof(limn_file_term);
}
static void stencils_begin_later(const blob *file) {
    stencils_of(file)[0] = 1;
}
static void stencils_end_early(const blob *file) {
    stencils_of(file)[stencil_count(file)]--;
}
static void stencils_descend(const blob *file) {
    stencils_of(file)[2] = stencils_of(file)[3] + 1;
}
static void stencils_outside(const blob *file) {
    stencils_of(file)[1] = UINT32_MAX;
}
static void term_of_itself(const blob *file) {
    terms_of(file)[stencils_of(file)[1]].point = record_of(file, STRIP)->control_count + 1;
}
/// Not damage.
static void term_before_itself(const blob *file) {
    terms_of(file)[stencils_of(file)[1]].point = record_of(file, STRIP)->control_count;
}
static void last_term_far_outside(const blob *file) {
    terms_of(file)[terms_chunk(file)->size / sizeof(limn_file_term) - 1].point = UINT32_MAX;
}
static void weight_not_a_number(const blob *file) {
    terms_of(file)[0].weight = NAN;
}
static void last_weight_infinite(const blob *file) {
    terms_of(file)[terms_chunk(file)->size / sizeof(limn_file_term) - 1].weight = INFINITY;
}

static const damage damages[] = {
    DAMAGE(without_pieces, LIMN_ERROR_PIECE),
    DAMAGE(without_columns, LIMN_ERROR_PIECE),
    DAMAGE(pieces_cut, LIMN_ERROR_PIECE),
    DAMAGE(piece_kind, LIMN_ERROR_PIECE),
    DAMAGE(piece_table_misaligned, LIMN_ERROR_PIECE),
    DAMAGE(piece_table_outside, LIMN_ERROR_PIECE),
    DAMAGE(piece_table_overflows, LIMN_ERROR_PIECE),
    DAMAGE(piece_over_the_end, LIMN_ERROR_PIECE),
    DAMAGE(piece_table_count, LIMN_ERROR_PIECE),
    DAMAGE(class_pairs, LIMN_ERROR_PIECE),
    DAMAGE(class_depth, LIMN_ERROR_CLASS),
    DAMAGE(columns_misaligned, LIMN_ERROR_PIECE),
    DAMAGE(columns_over_the_end, LIMN_ERROR_PIECE),
    DAMAGE(columns_behind_the_end, LIMN_ERROR_PIECE),
    DAMAGE(columns_overflow, LIMN_ERROR_PIECE),
    DAMAGE(part_outside, LIMN_ERROR_PIECE),
    DAMAGE(part_far_outside, LIMN_ERROR_PIECE),
    DAMAGE(part_of_quad, LIMN_ERROR_PIECE),
    DAMAGE(piece_domain, LIMN_ERROR_PIECE),
    DAMAGE(part_of_other_kind, LIMN_ERROR_PIECE),
    DAMAGE(part_without_tangents, LIMN_ERROR_PIECE),
    DAMAGE(column_outside, LIMN_ERROR_PIECE),
    DAMAGE(column_far_outside, LIMN_ERROR_PIECE),
    DAMAGE(column_unused, LIMN_OK),
    DAMAGE(points_without_some_controls, LIMN_ERROR_MESH),
    DAMAGE(points_beyond_the_bind_pose, LIMN_ERROR_MESH),
    DAMAGE(points_overflow, LIMN_ERROR_MESH),
    DAMAGE(no_points, LIMN_ERROR_MESH),
    DAMAGE(point_not_a_number, LIMN_ERROR_CONTROLS),
    DAMAGE(one_divided, LIMN_ERROR_INDEX),
    DAMAGE(all_divided, LIMN_ERROR_MESH),
    DAMAGE(divided_overflows, LIMN_ERROR_MESH),
    DAMAGE(point_count_of_dense, LIMN_ERROR_RUN),
    DAMAGE(class_of_dense, LIMN_ERROR_RUN),
    DAMAGE(index_of_control, LIMN_ERROR_INDEX),
    DAMAGE(index_outside, LIMN_ERROR_INDEX),
    DAMAGE(corner_on_edge, LIMN_ERROR_INDEX),
    DAMAGE(without_stencils, LIMN_ERROR_CHUNK),
    DAMAGE(without_terms, LIMN_ERROR_CHUNK),
    DAMAGE(without_both, LIMN_ERROR_CHUNK),
    DAMAGE(stencils_too_long, LIMN_ERROR_STENCIL),
    DAMAGE(stencils_too_short, LIMN_ERROR_STENCIL),
    DAMAGE(terms_cut, LIMN_ERROR_STENCIL),
    DAMAGE(terms_missing, LIMN_ERROR_STENCIL),
    DAMAGE(stencils_begin_later, LIMN_ERROR_STENCIL),
    DAMAGE(stencils_end_early, LIMN_ERROR_STENCIL),
    DAMAGE(stencils_descend, LIMN_ERROR_STENCIL),
    DAMAGE(stencils_outside, LIMN_ERROR_STENCIL),
    DAMAGE(term_of_itself, LIMN_ERROR_STENCIL),
    DAMAGE(term_before_itself, LIMN_OK),
    DAMAGE(last_term_far_outside, LIMN_ERROR_STENCIL),
    DAMAGE(weight_not_a_number, LIMN_ERROR_STENCIL),
    DAMAGE(last_weight_infinite, LIMN_ERROR_STENCIL),
};

static void test_damages(const blob *file) {
    CHECK(runs_of(file, STRIP)[1].first_patch > 0);
    check_damages(file, damages, COUNT(damages));
}

/// With room for all its columns.
static void test_many_controls(const blob *file) {
    static const damage too_many[] = {DAMAGE(piece_with_many_controls, LIMN_ERROR_PIECE)};
    const size_t columns = LIMN_FORMAT_CONTROLS_MAX + 64, column_size = 48 * sizeof(float);
    const blob longer = grow_tables(file, columns * column_size);
    CHECK_EQUAL(open_result(longer.bytes, longer.size), LIMN_OK);
    check_damages(&longer, too_many, 1);
    free(longer.bytes);
}

/// Normals are those of control points: rings do not reach to the points behind them.
static void ring_of_points(const blob *file) {
    *(uint32_t *)chunk_data(file, 0, LIMN_CHUNK_RINGS) = record_of(file, 0)->control_count;
}
static void test_normals(void) {
    static const damage outside[] = {DAMAGE(ring_of_points, LIMN_ERROR_NORMALS)};
    const blob file = bake_with(&isolated_normals, (const mesh_case *[]){&strip}, 1);
    CHECK_EQUAL(open_result(file.bytes, file.size), LIMN_OK);
    check_damages(&file, outside, 1);
    check_mended_words(&file);
    free(file.bytes);
}

/// Meshes that are not isolated have neither chunk.
static void test_stencils_of_dense(void) {
    const blob file = bake_tetrahedron();
    const limn_file_chunk stencils = {.kind = LIMN_CHUNK_STENCILS};
    const limn_file_chunk terms = {.kind = LIMN_CHUNK_TERMS};
    const blob with_stencils = insert_chunk(&file, &stencils);
    const blob with_terms = insert_chunk(&file, &terms);
    const blob with_both = insert_chunk(&with_terms, &stencils);
    CHECK_EQUAL(open_result(with_stencils.bytes, with_stencils.size), LIMN_ERROR_CHUNK);
    CHECK_EQUAL(open_result(with_terms.bytes, with_terms.size), LIMN_ERROR_CHUNK);
    CHECK_EQUAL(open_result(with_both.bytes, with_both.size), LIMN_ERROR_CHUNK);
    free(file.bytes);
    free(with_stencils.bytes);
    free(with_terms.bytes);
    free(with_both.bytes);
}

/// The bind pose has the points of level 1 already: the same bits.
static void test_bind_pose(const blob *file) {
    limn_pack pack;
    if (!CHECK_EQUAL(limn_pack_open(&pack, file->bytes, file->size), LIMN_OK)) return;
    for (uint32_t m = 0; m < pack.mesh_count; m++) {
        const limn_mesh mesh = limn_pack_mesh(&pack, m);
        const size_t size = mesh.point_count * sizeof(float[3]);
        float *const points = malloc(size);
        if (!points) abort();
        CHECK(mesh.point_count >= 2 * mesh.control_count);
        memcpy(points, mesh.controls, mesh.control_count * sizeof(float[3]));
        limn_mesh_refine(&mesh, points);
        CHECK(memcmp(points, mesh.controls, size) == 0);
        free(points);
    }
}

static void test_mended_bytes(void) {
    const blob file = bake_with(&isolated, (const mesh_case *[]){&tetrahedron}, 1);
    check_mended_bytes(&file);
    free(file.bytes);
}

int main(void) {
    make_wheel();
    const blob file = bake_with(&isolated, (const mesh_case *[]){&tetrahedron, &strip, &wheel}, 3);
    test_bind_pose(&file);
    test_damages(&file);
    test_many_controls(&file);
    test_normals();
    test_stencils_of_dense();
    test_mended_bytes();
    bake_and_mend(&isolated, (const mesh_case *[]){&tetrahedron, &twin}, 2);
    free(file.bytes);
    return check_report();
}
