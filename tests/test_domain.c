/* SPDX-License-Identifier: MIT */
/* The domains against their definitions. */
#include "check.h"
#include "coefficients.h"
#include "limn/limn.h"

enum { ROWS_MAX = 289, PLACES_MAX = 296 };

static const limn_domain *domain;

static bool is_quad(void) {
    return domain->kind == LIMN_DOMAIN_QUAD;
}

static uint32_t row_at(int i, int j) {
    const uint32_t row_count = domain->row_counts[LIMN_LEVEL_MAX];
    for (uint32_t row = 0; row < row_count; row++) {
        if (domain->rows[row].i == i && domain->rows[row].j == j) return row;
    }
    return row_count;
}

static void test_counts(void) {
    static const int rows[2][LIMN_LEVEL_COUNT] = {{3, 6, 15, 45, 153}, {4, 9, 25, 81, 289}};
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++) {
        CHECK_EQUAL(domain->row_counts[level], rows[is_quad()][level]);
        CHECK_EQUAL(domain->index_counts[level], (is_quad() ? 6 : 3) << 2 * level);
    }
}

/// Every grid point is a row exactly once, and appears at the level where its coordinates divide.
static void test_rows_are_nested(void) {
    bool seen[LIMN_GRID_SIZE + 1][LIMN_GRID_SIZE + 1] = {{false}};
    for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++) {
        const limn_row r = domain->rows[row];
        CHECK(r.i <= LIMN_GRID_SIZE && r.j <= LIMN_GRID_SIZE && !seen[r.i][r.j]);
        CHECK(is_quad() || r.i + r.j <= LIMN_GRID_SIZE);
        CHECK_EQUAL(r.mirror, row_at(r.j, r.i));
        seen[r.i][r.j] = true;
        int level = 0;
        while ((r.i | r.j) % (LIMN_GRID_SIZE >> level) != 0)
            level++;
        CHECK_EQUAL(r.level, level);
        CHECK(row < domain->row_counts[level]);
        CHECK(level == 0 || row >= domain->row_counts[level - 1]);
    }
}

/// Parents are rows of an earlier level, and the row is half-way between them.
static void test_parents(void) {
    for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++) {
        const limn_row r = domain->rows[row];
        const limn_row a = domain->rows[r.parents[0]], b = domain->rows[r.parents[1]];
        CHECK(2 * r.i == a.i + b.i && 2 * r.j == a.j + b.j);
        CHECK(r.level == 0 ? r.parents[0] == row : a.level < r.level && b.level < r.level);
        const bool has_elder = r.edges && r.level > 1; // then one parent is the elder
        const uint16_t elder = a.level < b.level ? r.parents[0] : r.parents[1];
        CHECK_EQUAL(r.sources[0], has_elder ? elder : r.parents[0]);
        CHECK_EQUAL(r.sources[1], has_elder ? elder : r.parents[1]);
        CHECK(!has_elder || a.level != b.level);
        // The parents are joined by an edge of the level before: their own direction, one step
        // long.
        const int step = r.level ? LIMN_GRID_SIZE >> (r.level - 1) : 0;
        const int di = b.i - a.i, dj = b.j - a.j;
        CHECK((di == 0 && (dj == step || dj == -step)) ||
              (dj == 0 && (di == step || di == -step)) ||
              (di == (is_quad() ? dj : -dj) && (di == step || di == -step)));
    }
}

static void test_edges(void) {
    enum { END = LIMN_GRID_SIZE };
    for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++) {
        const limn_row r = domain->rows[row];
        const int of_triangle = (r.j == 0) | (r.i + r.j == END) << 1 | (r.i == 0) << 2;
        const int of_quad = (r.j == 0) | (r.i == END) << 1 | (r.j == END) << 2 | (r.i == 0) << 3;
        CHECK_EQUAL(r.edges, is_quad() ? of_quad : of_triangle);
    }
    for (int t = 0; t <= END; t++) {
        CHECK_EQUAL(domain->edge_rows[0][t], row_at(t, 0));
        CHECK_EQUAL(domain->edge_rows[1][t], is_quad() ? row_at(END, t) : row_at(END - t, t));
        CHECK_EQUAL(domain->edge_rows[2][t], is_quad() ? row_at(END - t, END) : row_at(0, END - t));
        if (is_quad()) CHECK_EQUAL(domain->edge_rows[3][t], row_at(0, END - t));
    }
}

/// Rows of a pair are mirror images inside; pairs and single rows together are `wanted` rows, each
/// once; the rest of a column is padding.
static void check_places(const limni_layout *layout, uint32_t first_row) {
    int seen[PLACES_MAX] = {0};
    for (uint32_t place = 0; place < layout->row_stride; place++) {
        const uint32_t row = layout->rows[place], pair = place - layout->pair_table_row;
        if (row == LIMNI_NO_ROW) continue;
        CHECK(row < domain->row_counts[LIMN_LEVEL_MAX]);
        seen[row]++;
        if (pair >= layout->pair_counts[LIMN_LEVEL_MAX]) continue;
        CHECK_EQUAL(row, layout->pair_rows[pair / 8] + pair % 8);
        CHECK_EQUAL(domain->rows[row].mirror, layout->mirror_rows[pair / 8] + pair % 8);
        CHECK(domain->rows[row].edges == 0);
        seen[domain->rows[row].mirror]++;
    }
    for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++)
        CHECK_EQUAL(seen[row], row >= first_row ? 1 : 0);
}

/// What a level reads is there, is a prefix of what the next one reads, and is all of its rows.
static void check_levels(const limni_layout *layout, uint32_t first_row) {
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        bool read[PLACES_MAX] = {false};
        for (uint32_t s = 0; s < LIMNI_SEGMENT_MAX; s++) {
            const limni_segment segment = layout->segments[level][s];
            for (uint32_t r = 0; r < segment.count; r++) {
                const uint32_t row = layout->rows[segment.table_row + r];
                if (row == LIMNI_NO_ROW) continue;
                CHECK_EQUAL(row, segment.row + r);
                read[row] = true;
            }
        }
        for (uint32_t pair = 0; pair < layout->pair_counts[level]; pair++) {
            const uint32_t row = layout->rows[layout->pair_table_row + pair];
            read[row] = read[domain->rows[row].mirror] = true;
        }
        for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
            for (uint32_t r = 0; r < layout->edge_counts[level]; r++) {
                const uint32_t row = layout->rows[edge * LIMNI_EDGE_ROWS + r];
                if (row != LIMNI_NO_ROW) read[row] = true;
            }
        }
        for (uint32_t row = first_row; row < domain->row_counts[level]; row++)
            CHECK(read[row]);
        if (level > 0) {
            CHECK(layout->pair_counts[level] >= layout->pair_counts[level - 1]);
            CHECK(layout->edge_counts[level] >= layout->edge_counts[level - 1]);
        }
    }
}

/// Places 4 to 7 of an edge, and 8 to 15, are consecutive rows, and but one is on the edge. From
/// `inside_level` on, the rows inside are those of segments and pairs.
static void check_edges(const limni_layout *layout) {
    for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
        const uint16_t *const rows = &layout->rows[edge * LIMNI_EDGE_ROWS];
        uint32_t on_edge = 0;
        for (uint32_t r = 0; r < LIMNI_EDGE_ROWS; r++) {
            CHECK(r < 4 || r % 8 == 0 || r == 4 || rows[r] == rows[r - 1] + 1);
            if (rows[r] == LIMNI_NO_ROW) continue;
            on_edge += domain->rows[rows[r]].edges == 1u << edge;
            CHECK(domain->rows[rows[r]].edges ||
                  domain->rows[rows[r]].level < layout->inside_level);
        }
        CHECK_EQUAL(on_edge, LIMNI_EDGE_ROWS - 1);
    }
}

static void test_layouts(void) {
    for (uint16_t pairs = 0; pairs < (is_quad() ? 1 : 2); pairs++) {
        const limn_file_class class = {.domain = (uint16_t)domain->kind, .pair_count = pairs};
        const limni_layout *const positions = limni_layout_get(domain->kind, false, pairs);
        const limni_layout *const tangents = limni_layout_get(domain->kind, true, pairs);
        CHECK_EQUAL(positions->row_stride, limn_file_row_stride(&class));
        CHECK_EQUAL(tangents->row_stride, limn_file_row_stride(&class));
        check_places(positions, 0);
        check_levels(positions, 0);
        check_places(tangents, domain->corner_count);
        check_levels(tangents, domain->corner_count);
        check_edges(tangents);
    }
}

// ---- Pieces

/// In the grid of the patch.
typedef struct place {
    int i, j;
} place;

/// Of two corners; twice as far, as the middle may be between two places.
static place middle_of(int a, int b) {
    const limn_row c = domain->rows[a], d = domain->rows[b];
    return (place){c.i + d.i, c.j + d.j};
}

/// Of a corner's piece, the corner itself and the middles of the edges that start and end there; of
/// the middle one, the middles of edges. Likewise.
static place corner_of_piece(int piece, int corner) {
    const int count = (int)domain->corner_count;
    if (piece == count) return middle_of(corner, (corner + 1) % count);
    return middle_of(piece, (piece + corner) % count);
}

/// Weighs the corners of the piece; of a quad all but that in the middle of the patch, as it is a
/// parallelogram.
static place place_in_patch(int piece, limn_row row) {
    const place a = corner_of_piece(piece, 0), b = corner_of_piece(piece, 1);
    const place c = corner_of_piece(piece, (int)domain->corner_count - 1);
    const int rest = LIMN_GRID_SIZE - row.i - row.j, unit = 2 * LIMN_GRID_SIZE;
    const int i = rest * a.i + row.i * b.i + row.j * c.i;
    const int j = rest * a.j + row.i * b.j + row.j * c.j;
    CHECK(i % unit == 0 && j % unit == 0);
    return (place){i / unit, j / unit};
}

static const limni_pieces *pieces;

/// The row of the patch that waits at a place among those of all pieces, or LIMNI_NO_ROW.
static uint32_t row_waiting(const limni_piece_layout layouts[2], uint32_t staged, uint32_t *piece,
                            uint32_t *at) {
    const uint32_t stride = layouts[LIMNI_PIECE_CORNER].row_stride;
    *piece = staged / stride < domain->corner_count ? staged / stride : LIMN_FORMAT_PIECE_COUNT - 1;
    *at = staged - *piece * stride;
    const limni_piece_layout *const layout = &layouts[limni_piece_kind_of(domain, *piece)];
    if (*at >= layout->row_stride || layout->rows[*at] == LIMNI_NO_ROW) return LIMNI_NO_ROW;
    const place p = place_in_patch((int)*piece, domain->rows[layout->rows[*at]]);
    return row_at(p.i, p.j);
}

static void check_piece_layout(const limni_piece_layout *layout, limni_piece_kind kind) {
    const limn_file_piece record = {.kind = (uint8_t)kind, .domain = (uint8_t)domain->kind};
    CHECK_EQUAL(layout->row_stride, limn_file_piece_stride(&record));
    CHECK_EQUAL(layout->row_stride % LIMN_FORMAT_ROW_BLOCK, 0);
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        CHECK_EQUAL(layout->counts[level] % LIMN_FORMAT_ROW_BLOCK, 0);
        CHECK(layout->counts[level] <= layout->row_stride);
        CHECK(level == 0 || layout->counts[level] >= layout->counts[level - 1]);
    }
    bool seen[PLACES_MAX] = {false};
    for (uint32_t at = 0; at < layout->row_stride; at++) {
        const uint32_t row = layout->rows[at];
        if (row == LIMNI_NO_ROW) continue;
        CHECK(row < domain->row_counts[LIMN_LEVEL_MAX - 1] && !seen[row]);
        seen[row] = true;
    }
}

/// Copies in order, four rows each, as kernels make them: what is then in the rows of a level is
/// what waited for them, at places that this level has summed.
static void check_copies(const limni_piece_layout layouts[2], const limni_piece_copy *copies,
                         uint32_t count, uint32_t level, uint32_t first_row) {
    uint32_t staged[PLACES_MAX + 4];
    memset(staged, 0xff, sizeof staged);
    for (uint32_t c = 0; c < count; c++) {
        for (uint32_t r = 0; r < 4; r++) {
            CHECK(copies[c].from + r < LIMNI_PIECE_PLACES + 4 && copies[c].to + r < PLACES_MAX);
            staged[copies[c].to + r] = copies[c].from + r;
        }
    }
    for (uint32_t row = first_row; row < domain->row_counts[level]; row++) {
        uint32_t piece, at;
        CHECK_EQUAL(row_waiting(layouts, staged[row], &piece, &at), row);
        CHECK(at < layouts[limni_piece_kind_of(domain, piece)].counts[level]);
    }
}

/// Every row of the patch is one of a single piece, but the middle of a quad, which all have; of the
/// corners' tangents there are none.
static void check_owners(const limni_piece_layout layouts[2], uint32_t first_row) {
    int owners[PLACES_MAX] = {0};
    for (uint32_t staged = 0; staged < LIMNI_PIECE_PLACES; staged++) {
        uint32_t piece, at;
        const uint32_t row = row_waiting(layouts, staged, &piece, &at);
        if (row != LIMNI_NO_ROW) owners[row]++;
    }
    for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++)
        CHECK_EQUAL(owners[row], row < first_row ? 0 : is_quad() && row == 8 ? 4 : 1);
}

/// The blocks of a corner's tangents that are summed relative to an end of an edge have all rows of
/// the half edges at the corner: the first that of the edge that starts there, and its middle; of a
/// quad the other one has the middle of the patch, too.
static void check_half_edges(void) {
    enum { END = LIMN_GRID_SIZE };
    const limni_piece_layout *const layout = &pieces->tangents[LIMNI_PIECE_CORNER];
    for (uint32_t at = 0; at < layout->row_stride; at++) {
        if (layout->rows[at] == LIMNI_NO_ROW) continue;
        const limn_row row = domain->rows[layout->rows[at]];
        const bool along = row.j == 0, back = row.i == 0 && row.j < END;
        const bool middle = is_quad() && row.i == END && row.j == END;
        CHECK_EQUAL(at < 8, along);
        CHECK_EQUAL(at >= 8 && at < 16, back || middle);
        CHECK(is_quad() ? row.j < END || middle // the rest belongs to other pieces
                        : row.i + row.j < END || along);
        CHECK(row.i + row.j > 0);
    }
    if (is_quad()) return;
    const limni_piece_layout *const middle = &pieces->tangents[LIMNI_PIECE_MIDDLE];
    for (uint32_t at = 0; at < middle->row_stride; at++) {
        if (middle->rows[at] == LIMNI_NO_ROW) continue;
        const place p = place_in_patch(3, domain->rows[middle->rows[at]]);
        CHECK_EQUAL(domain->rows[row_at(p.i, p.j)].edges, 0);
    }
}

static void test_pieces(void) {
    pieces = limni_pieces_get(domain->kind);
    CHECK(domain->corner_count * pieces->positions[LIMNI_PIECE_CORNER].row_stride +
              pieces->positions[LIMNI_PIECE_MIDDLE].row_stride <=
          LIMNI_PIECE_PLACES);
    const int last_kind = (int)limni_piece_kind_of(domain, LIMN_FORMAT_PIECE_COUNT - 1);
    for (int kind = LIMNI_PIECE_CORNER; kind <= last_kind; kind++) {
        check_piece_layout(&pieces->positions[kind], (limni_piece_kind)kind);
        check_piece_layout(&pieces->tangents[kind], (limni_piece_kind)kind);
    }
    check_owners(pieces->positions, 0);
    check_owners(pieces->tangents, domain->corner_count);
    check_half_edges();
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        check_copies(pieces->positions, pieces->position_copies,
                     pieces->position_copy_counts[level], level, 0);
        check_copies(pieces->tangents, pieces->normal_copies, pieces->normal_copy_counts[level],
                     level, domain->corner_count);
    }
}

// ---- Order and indices

/// The order within a level's new rows is part of the format: edges along their directions, then
/// the interior: of a triangle the mirror line, one side, piece by piece, and the other.
static void test_order_of_triangle(void) {
    static const uint8_t level_2[9][2] = {{4, 0}, {12, 0}, {12, 4}, {4, 12}, {0, 12},
                                          {0, 4}, {4, 4},  {8, 4},  {4, 8}};
    for (int r = 0; r < 9; r++)
        CHECK_EQUAL(row_at(level_2[r][0], level_2[r][1]), (uint32_t)(6 + r));
    static const uint8_t level_3[18][2] = {{2, 2},  {6, 6},  {4, 2}, {12, 2}, {10, 4}, {10, 2},
                                           {6, 2},  {8, 2},  {6, 4}, {8, 6},  {2, 4},  {2, 12},
                                           {4, 10}, {2, 10}, {2, 6}, {2, 8},  {4, 6},  {6, 8}};
    for (int r = 0; r < 18; r++)
        CHECK_EQUAL(row_at(level_3[r][0], level_3[r][1]), (uint32_t)(27 + r));
    CHECK_EQUAL(row_at(8, 0), 3u);
    CHECK_EQUAL(row_at(8, 8), 4u);
    CHECK_EQUAL(row_at(0, 8), 5u);
}

/// Of a quad piece by piece, each as its corner sees it.
static void test_order_of_quad(void) {
    static const uint8_t level_1[9][2] = {{0, 0},  {16, 0}, {16, 16}, {0, 16}, {8, 0},
                                          {16, 8}, {8, 16}, {0, 8},   {8, 8}};
    for (int r = 0; r < 9; r++)
        CHECK_EQUAL(row_at(level_1[r][0], level_1[r][1]), (uint32_t)r);
    static const uint8_t level_2[16][2] = {{4, 0},   {12, 0}, {16, 4}, {16, 12}, {12, 16}, {4, 16},
                                           {0, 12},  {0, 4},  {4, 4},  {8, 4},   {12, 4},  {12, 8},
                                           {12, 12}, {8, 12}, {4, 12}, {4, 8}};
    for (int r = 0; r < 16; r++)
        CHECK_EQUAL(row_at(level_2[r][0], level_2[r][1]), (uint32_t)(9 + r));
    static const uint8_t corner_0[10][2] = {{2, 2}, {4, 2}, {6, 2}, {8, 2}, {2, 4},
                                            {6, 4}, {2, 6}, {4, 6}, {6, 6}, {8, 6}};
    for (int r = 0; r < 10; r++) {
        const int i = corner_0[r][0], j = corner_0[r][1];
        CHECK_EQUAL(row_at(i, j), (uint32_t)(41 + r));
        CHECK_EQUAL(row_at(16 - j, i), (uint32_t)(51 + r));
        CHECK_EQUAL(row_at(16 - i, 16 - j), (uint32_t)(61 + r));
        CHECK_EQUAL(row_at(j, 16 - i), (uint32_t)(71 + r));
    }
}

/// Whether a row lies in a triangle.
static bool is_inside(const uint16_t *triangle, limn_row p) {
    bool inside = true;
    for (uint32_t c = 0; c < 3; c++) {
        const limn_row a = domain->rows[triangle[c]], b = domain->rows[triangle[(c + 1) % 3]];
        inside &= (b.i - a.i) * (p.j - a.j) - (b.j - a.j) * (p.i - a.i) >= 0;
    }
    return inside;
}

/// Each triangle lies in one of the level before: where no row has moved yet, the surface is that.
static void test_refinement(void) {
    for (int level = 1; level < LIMN_LEVEL_COUNT; level++) {
        const uint16_t *const fine = domain->indices[level];
        const uint16_t *const coarse = domain->indices[level - 1];
        for (uint32_t i = 0; i < domain->index_counts[level]; i += 3) {
            uint32_t within = 0;
            for (uint32_t k = 0; k < domain->index_counts[level - 1]; k += 3) {
                bool inside = true;
                for (uint32_t c = 0; c < 3; c++)
                    inside &= is_inside(coarse + k, domain->rows[fine[i + c]]);
                within += inside;
            }
            CHECK_EQUAL(within, 1);
        }
    }
}

/// Triangles of a level: counter-clockwise, equally large, and together the whole patch: every
/// inner edge is used once in each direction.
static void test_indices(void) {
    for (int level = 0; level < LIMN_LEVEL_COUNT; level++) {
        static unsigned char used[ROWS_MAX][ROWS_MAX];
        memset(used, 0, sizeof used);
        const uint16_t *const indices = domain->indices[level];
        const int step = LIMN_GRID_SIZE >> level;
        for (uint32_t i = 0; i < domain->index_counts[level]; i += 3) {
            const limn_row a = domain->rows[indices[i]], b = domain->rows[indices[i + 1]];
            const limn_row c = domain->rows[indices[i + 2]];
            CHECK_EQUAL((b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i), step * step);
            for (uint32_t corner = 0; corner < 3; corner++) {
                CHECK(indices[i + corner] < domain->row_counts[level]);
                CHECK_EQUAL(used[indices[i + corner]][indices[i + (corner + 1) % 3]]++, 0);
            }
        }
        for (int a = 0; a < domain->row_counts[level]; a++) {
            for (int b = 0; b < domain->row_counts[level]; b++) {
                const bool on_boundary = domain->rows[a].edges & domain->rows[b].edges;
                if (used[a][b]) CHECK(on_boundary != used[b][a]);
            }
        }
    }
}

static void test_domain(limn_domain_kind kind) {
    domain = limn_domain_get(kind);
    CHECK_EQUAL(domain->kind, kind);
    CHECK_EQUAL(domain->corner_count, is_quad() ? 4 : 3);
    test_counts();
    test_rows_are_nested();
    test_parents();
    test_edges();
    if (is_quad()) {
        test_order_of_quad();
    } else {
        test_order_of_triangle();
    }
    test_layouts();
    test_pieces();
    test_indices();
    test_refinement();
}

int main(void) {
    test_domain(LIMN_DOMAIN_TRIANGLE);
    test_domain(LIMN_DOMAIN_QUAD);
    return check_report();
}
