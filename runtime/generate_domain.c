/* SPDX-License-Identifier: MIT */
/*
 * Writes domain_triangle.c to standard output. The result is committed, so that cross builds need
 * no host program; the test `domain_generated` compares the two. A second domain is a second
 * description here (its grid test, its edges, its cells), and the same tables.
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { LEVEL_COUNT = 5, LEVEL_MAX = 4, GRID = 16, ROW_BLOCK = 8, CORNERS = 3, ROW_MAX = 153 };
enum { PAIRED = 3 }; ///< the first level with pairs of rows
enum { EDGE_ROWS = 16, NO_ROW = 0xffff };

typedef struct point {
    int i, j;
} point;

static const point corners[CORNERS] = {{0, 0}, {GRID, 0}, {0, GRID}};

static point rows[ROW_MAX];
static int row_levels[ROW_MAX];
static int row_count;
static int row_counts[LEVEL_COUNT];
static int pair_rows[LEVEL_COUNT];   ///< the first new row on one side of the mirror line
static int mirror_rows[LEVEL_COUNT]; ///< the first on the other

static int row_at(int i, int j) {
    for (int row = 0; row < row_count; row++) {
        if (rows[row].i == i && rows[row].j == j) return row;
    }
    fprintf(stderr, "no row at (%d, %d)\n", i, j);
    exit(1);
}

static bool has_row(int i, int j) {
    for (int row = 0; row < row_count; row++) {
        if (rows[row].i == i && rows[row].j == j) return true;
    }
    return false;
}

static point edge_point(int edge, int t) {
    const point a = corners[edge], b = corners[(edge + 1) % CORNERS];
    return (point){a.i + (b.i - a.i) / GRID * t, a.j + (b.j - a.j) / GRID * t};
}

static int edges_of(point p) {
    return (p.j == 0 ? 1 : 0) | (p.i + p.j == GRID ? 2 : 0) | (p.i == 0 ? 4 : 0);
}

static void add_row(point p, int level) {
    if (has_row(p.i, p.j)) return;
    row_levels[row_count] = level;
    rows[row_count++] = p;
}

enum { IN_CORNER, IN_NEXT_CORNER, IN_MIDDLE }; ///< pieces on the side i > j of the mirror line

static int place_of(point p) {
    if (p.i + p.j < GRID / 2) return IN_CORNER;
    return p.i > GRID / 2 ? IN_NEXT_CORNER : IN_MIDDLE;
}

/// Rows on one side of the mirror line that a level adds to one piece, by ascending j, then i; or
/// their images. `turn` takes the frame of the piece to that of the patch.
///
/// side  0: rows on the line i = j, 1: those with i > j, -1: their images in the frame
static void add_side(int level, int piece, int side, bool image, point (*turn)(int i, int j)) {
    const int step = GRID >> level;
    for (int j = step; j < GRID; j += step) {
        for (int i = side ? j + step : j; i + j < GRID; i += side ? step : GRID) {
            const point p = side < 0 ? turn(j, i) : turn(i, j);
            if (place_of(p) == piece) add_row(image ? (point){p.j, p.i} : p, level);
        }
    }
}

static point as_is(int i, int j) {
    return (point){i, j};
}

/// From the frame of corner 1.
static point from_next_corner(int i, int j) {
    return (point){GRID - i - j, i};
}

/// Rows inside the triangle that a level adds on the side i > j, or their images: those of the
/// piece at corner 0; those at corner 1, in the order in which corner 0 has its own, which is that
/// of its mirror line, of one side of it, and of the other; those in the middle.
static void add_interior_side(int level, bool image) {
    add_side(level, IN_CORNER, 1, image, as_is);
    for (int own = 0; own < 3; own++)
        add_side(level, IN_NEXT_CORNER, own == 2 ? -1 : own, image, from_next_corner);
    add_side(level, IN_MIDDLE, 1, image, as_is);
}

// Nested order: what level n adds comes after all of level n - 1; edges first, each along its
// direction, then the interior: the rows on the mirror line, those on one side of it, and their
// images, so that a patch that is its own mirror image can be evaluated by halves; on one side
// piece by piece, so that the rows of a piece are consecutive.
static void number_rows(void) {
    for (int level = 0; level < LEVEL_COUNT; level++) {
        const int step = GRID >> level;
        for (int corner = 0; corner < CORNERS; corner++)
            add_row(corners[corner], level);
        for (int edge = 0; edge < CORNERS; edge++) {
            for (int t = step; t < GRID; t += step)
                add_row(edge_point(edge, t), level);
        }
        for (int i = step; 2 * i < GRID; i += step)
            add_row((point){i, i}, level);
        pair_rows[level] = row_count;
        add_interior_side(level, false);
        mirror_rows[level] = row_count;
        add_interior_side(level, true);
        row_counts[level] = row_count;
    }
}

/// The parent of the lower level; of two corners, -1.
static int find_elder(int a, int b) {
    if (row_levels[a] == row_levels[b]) return -1;
    return row_levels[a] < row_levels[b] ? a : b;
}

static void print_rows(void) {
    printf("static const limn_row rows[%d] = {\n", row_count);
    for (int row = 0; row < row_count; row++) {
        const point p = rows[row];
        const int step = GRID >> row_levels[row];
        int a = row, b = row;
        if (row_levels[row] > 0) {
            // The direction in which the coordinates are odd multiples of the step is the spawning
            // edge.
            const int di = p.i / step % 2 * step, dj = p.j / step % 2 * step;
            a = di && dj ? row_at(p.i + di, p.j - dj) : row_at(p.i - di, p.j - dj);
            b = di && dj ? row_at(p.i - di, p.j + dj) : row_at(p.i + di, p.j + dj);
        }
        const int elder = edges_of(p) ? find_elder(a, b) : -1;
        printf("    {%d, %d, %d, %d, {%d, %d}, {%d, %d}, %d},\n", p.i, p.j, row_levels[row],
               edges_of(p), a, b, elder < 0 ? a : elder, elder < 0 ? b : elder, row_at(p.j, p.i));
    }
    printf("};\n\n");
}

static void print_edges(void) {
    printf("static const limn_edge_rows edge_rows[%d] = {\n", CORNERS);
    for (int edge = 0; edge < CORNERS; edge++) {
        printf("    {");
        for (int t = 0; t <= GRID; t++) {
            const point p = edge_point(edge, t);
            printf("%d%s", row_at(p.i, p.j), t < GRID ? ", " : "},\n");
        }
    }
    printf("};\n\n");
}

static int index_total;

static void print_triangle(point a, point b, point c) {
    printf("    %d, %d, %d,\n", row_at(a.i, a.j), row_at(b.i, b.j), row_at(c.i, c.j));
    index_total += 3;
}

static int print_indices(int level) {
    const int step = GRID >> level;
    index_total = 0;
    printf("static const uint16_t indices_%d[] = {\n", level);
    for (int j = 0; j < GRID; j += step) {
        for (int i = 0; i + j < GRID; i += step) {
            const point a = {i, j}, b = {i + step, j}, c = {i, j + step}, d = {i + step, j + step};
            print_triangle(a, b, c);
            if (d.i + d.j <= GRID) print_triangle(b, d, c);
        }
    }
    printf("};\n\n");
    return index_total;
}

static int pad(int count) {
    return (count + ROW_BLOCK - 1) / ROW_BLOCK * ROW_BLOCK;
}

static void print_list(const char *name, const int values[LEVEL_COUNT]) {
    printf("    .%s = {", name);
    for (int level = 0; level < LEVEL_COUNT; level++)
        printf("%d%s", values[level], level < LEVEL_MAX ? ", " : "},\n");
}

// ---- Layouts

typedef struct segment {
    int table_row, row, count;
} segment;

/// See limni_layout; the fields are the same.
typedef struct layout {
    int row_stride, rows[ROW_MAX + 2 * CORNERS * EDGE_ROWS];
    segment segments[LEVEL_COUNT][2];
    int pair_counts[LEVEL_COUNT], pair_table_row;
    int edge_counts[LEVEL_COUNT];
} layout;

/// Appends places for rows [row, row + count), padded. `level` and finer ones read them as a
/// segment.
static void add_segment(layout *l, int level, int row, int count) {
    const segment added = {l->row_stride, row, pad(count)};
    for (int r = 0; r < added.count; r++)
        l->rows[l->row_stride++] = r < count ? row + r : NO_ROW;
    for (; level < LEVEL_COUNT; level++)
        l->segments[level][l->segments[level][0].count > 0] = added;
}

/// Appends the pairs of all levels.
static void add_pairs(layout *l) {
    l->pair_table_row = l->row_stride;
    for (int level = PAIRED; level < LEVEL_COUNT; level++) {
        const int count = mirror_rows[level] - pair_rows[level];
        l->pair_counts[level] = l->pair_counts[level - 1] + count;
        for (int r = 0; r < count; r++)
            l->rows[l->row_stride++] = pair_rows[level] + r;
    }
}

/// Positions without a mirror line: the rows of a level are one segment.
static layout plain_positions(void) {
    layout l = {0};
    add_segment(&l, LEVEL_MAX, 0, ROW_MAX);
    for (int level = 0; level < LEVEL_MAX; level++)
        l.segments[level][0].count = pad(row_counts[level]);
    return l;
}

/// With one, rows come in pairs from level 3 on, where the pairs of a level fill whole blocks of 8;
/// below, nothing would be gained. In a column: the other rows up to level 3; all pairs; the other
/// rows of level 4.
static layout mirrored_positions(void) {
    layout l = {0};
    add_segment(&l, PAIRED, 0, pair_rows[PAIRED]);
    for (int level = 0; level < PAIRED; level++)
        l.segments[level][0].count = pad(row_counts[level]);
    add_pairs(&l);
    add_segment(&l, LEVEL_MAX, row_counts[LEVEL_MAX - 1],
                pair_rows[LEVEL_MAX] - row_counts[LEVEL_MAX - 1]);
    return l;
}

/// The first row inside that a level adds.
static int first_inside(int level) {
    return row_counts[level - 1] + CORNERS * (1 << (level - 1));
}

/// Appends two blocks for every edge: its rows up to level 3, with one of the rows inside that
/// level 2 adds, and its rows of level 4.
static void add_edges(layout *l) {
    static const int along[EDGE_ROWS] = {8, 4, 12, -1, 2, 6, 10, 14, 1, 3, 5, 7, 9, 11, 13, 15};
    static const int counts[LEVEL_COUNT] = {0, 1, 4, 8, 16};
    for (int edge = 0; edge < CORNERS; edge++) {
        for (int r = 0; r < EDGE_ROWS; r++) {
            const point p =
                along[r] > 0 ? edge_point(edge, along[r]) : rows[first_inside(2) + edge];
            l->rows[l->row_stride++] = row_at(p.i, p.j);
        }
    }
    for (int level = 0; level < LEVEL_COUNT; level++)
        l->edge_counts[level] = counts[level];
}

/// Tangents, which corners do not need: edges; then what is inside, level by level.
static layout tangents(bool mirrored) {
    layout l = {0};
    add_edges(&l);
    for (int level = PAIRED; level < LEVEL_COUNT; level++) {
        const int first = first_inside(level);
        add_segment(&l, level, first, (mirrored ? pair_rows : row_counts)[level] - first);
        if (mirrored && level == PAIRED) add_pairs(&l);
    }
    return l;
}

static void print_rows_of(const char *name, const layout *l) {
    printf("static const uint16_t %s_rows[] = {", name);
    for (int r = 0; r < l->row_stride; r++)
        printf("%s%d", r == 0 ? "" : r % 16 == 0 ? ",\n    " : ", ", l->rows[r]);
    printf("};\n\n");
}

static void print_blocks(const char *name, const int first_rows[LEVEL_COUNT]) {
    printf("    .%s = {", name);
    for (int level = PAIRED; level < LEVEL_COUNT; level++) {
        for (int at = 0; at < mirror_rows[level] - pair_rows[level]; at += ROW_BLOCK)
            printf("%s%d", level == PAIRED && at == 0 ? "" : ", ", first_rows[level] + at);
    }
    printf("},\n");
}

static void print_layout(const char *rows_name, const layout *l) {
    printf("    {.row_stride = %d,\n    .rows = %s_rows,\n    .segments = {\n", l->row_stride,
           rows_name);
    for (int level = 0; level < LEVEL_COUNT; level++) {
        const segment *const s = l->segments[level];
        printf("        {{%d, %d, %d}, {%d, %d, %d}},\n", s[0].table_row, s[0].row, s[0].count,
               s[1].table_row, s[1].row, s[1].count);
    }
    printf("    },\n");
    if (l->pair_counts[LEVEL_MAX]) {
        print_list("pair_counts", l->pair_counts);
        printf("    .pair_table_row = %d,\n", l->pair_table_row);
        print_blocks("pair_rows", pair_rows);
        print_blocks("mirror_rows", mirror_rows);
    }
    print_list("edge_counts", l->edge_counts);
    printf("    },\n");
}

static void print_layouts(void) {
    const layout layouts[4] = {plain_positions(), mirrored_positions(), tangents(false),
                               tangents(true)};
    static const char *const names[4] = {"plain_position", "mirrored_position", "plain_tangent",
                                         "mirrored_tangent"};
    for (int l = 0; l < 4; l++)
        print_rows_of(names[l], &layouts[l]);
    for (int l = 0; l < 4; l++) {
        if (l % 2 == 0)
            printf("const limni_layout limni_%s_triangle[2] = {\n", l ? "tangents" : "positions");
        print_layout(names[l], &layouts[l]);
        if (l % 2) printf("};\n\n");
    }
}

// ---- Pieces

/// Of an isolated patch: the triangles at its corners, and the one in the middle.
enum { PIECES = 4, MIDDLE = 3, PIECE_DEPTH = LEVEL_MAX - 1, PIECE_ROWS = 48, COPY_MAX = 4 };

/// Where a row of a piece is in the patch.
static int row_in_patch(int piece, point p) {
    const point a = corners[piece % CORNERS], b = corners[(piece + 1) % CORNERS],
                c = corners[(piece + 2) % CORNERS];
    point from = a, along = {b.i - a.i, b.j - a.j}, across = {c.i - a.i, c.j - a.j};
    if (piece == MIDDLE) {
        from = (point){(a.i + b.i) / 2, (a.j + b.j) / 2}; // its corners: the middles of edges
        along = (point){c.i - a.i, c.j - a.j};
        across = (point){c.i - b.i, c.j - b.j};
    }
    return row_at(from.i + (p.i * along.i + p.j * across.i) / (2 * GRID),
                  from.j + (p.i * along.j + p.j * across.j) / (2 * GRID));
}

/// See limni_piece_layout; the fields are the same.
typedef struct piece_layout {
    int row_stride, rows[PIECE_ROWS], counts[LEVEL_COUNT];
} piece_layout;

/// Appends a row of the piece; `level` and finer ones of the patch read it.
static void add_place(piece_layout *l, int row, int level) {
    l->rows[l->row_stride++] = row;
    for (; level < LEVEL_COUNT; level++)
        l->counts[level] = pad(l->row_stride);
}

static void fill_block(piece_layout *l) {
    while (l->row_stride % ROW_BLOCK)
        l->rows[l->row_stride++] = NO_ROW;
}

/// Rows of a piece in the order of those of the patch, where most are consecutive; of a corner's,
/// in the second one, which leaves the fewest gaps in all three.
///
/// take  whether a piece has a row
static void add_by_patch(piece_layout *l, int piece, bool (*take)(int piece, int row)) {
    for (int at = 0; at < ROW_MAX; at++) {
        for (int row = 0; row < row_counts[PIECE_DEPTH]; row++) {
            if (row_in_patch(piece, rows[row]) == at && take(piece, row))
                add_place(l, row, row_levels[at]);
        }
    }
    fill_block(l);
}

enum { CORNER_PIECE = 1 }; ///< the one that stands for all three

/// Each row of a patch has one piece: of those between two, the middle one.
static bool has_position(int piece, int row) {
    return piece == MIDDLE || !(edges_of(rows[row]) & 2);
}

static bool has_tangents_inside(int piece, int row) {
    return has_position(piece, row) && !edges_of(rows[row_in_patch(piece, rows[row])]);
}

static piece_layout piece_positions(int piece) {
    piece_layout l = {0};
    add_by_patch(&l, piece, has_position);
    return l;
}

/// At a corner first a block each for the halves of the two edges, which are summed relative to a
/// point of the edge: the one that starts there, with its middle, and the other.
static piece_layout piece_tangents(int piece) {
    static const int halves[2][ROW_BLOCK] = {{16, 8, 4, 12, 2, 6, 10, 14},
                                             {8, 4, 12, 2, 6, 10, 14, -1}};
    static const int levels[2][ROW_BLOCK] = {{1, 2, 3, 3, 4, 4, 4, 4}, {2, 3, 3, 4, 4, 4, 4, -1}};
    piece_layout l = {0};
    for (int half = 0; half < 2 && piece != MIDDLE; half++) {
        for (int r = 0; r < ROW_BLOCK && halves[half][r] > 0; r++) {
            const point p = half ? (point){0, halves[1][r]} : (point){halves[0][r], 0};
            add_place(&l, row_at(p.i, p.j), levels[half][r]);
        }
        fill_block(&l);
    }
    add_by_patch(&l, piece, has_tangents_inside);
    return l;
}

/// Where the rows of a patch wait: those of one piece behind those of another.
static int staged_row(const piece_layout layouts[2], int row) {
    for (int piece = 0, first = 0; piece < PIECES; piece++) {
        const piece_layout *const l = &layouts[piece == MIDDLE];
        for (int place = 0; place < l->row_stride; place++) {
            if (l->rows[place] != NO_ROW && row_in_patch(piece, rows[l->rows[place]]) == row)
                return first + place;
        }
        first += l->row_stride;
    }
    return -1;
}

/// Four rows at a time, as far as they are consecutive on both sides. By ascending rows, so what a
/// copy writes too much is overwritten by the next.
static void print_copies(const char *name, const piece_layout layouts[2], int counts[LEVEL_COUNT]) {
    int count = 0, row = 0;
    printf("static const limni_piece_copy %s_copies[] = {", name);
    for (int level = 0; level < LEVEL_COUNT; level++) {
        while (row < row_counts[level]) {
            const int from = staged_row(layouts, row), first = row;
            if (from < 0) { // tangents of corners
                row++;
                continue;
            }
            while (++row < row_counts[level] && row - first < COPY_MAX &&
                   staged_row(layouts, row) == from + row - first) {
            }
            printf("%s{%d, %d}", count == 0 ? "" : count % 8 == 0 ? ",\n    " : ", ", from, first);
            count++;
        }
        counts[level] = count;
    }
    printf("};\n\n");
}

static void print_piece_layout(const char *name, const piece_layout *l) {
    printf("        {.row_stride = %d, .rows = %s_rows,\n    ", l->row_stride, name);
    print_list("counts", l->counts);
    printf("        },\n");
}

static void print_pieces(void) {
    const piece_layout positions[2] = {piece_positions(CORNER_PIECE), piece_positions(MIDDLE)};
    const piece_layout of_tangents[2] = {piece_tangents(CORNER_PIECE), piece_tangents(MIDDLE)};
    const piece_layout *const all[4] = {&positions[0], &positions[1], &of_tangents[0],
                                        &of_tangents[1]};
    static const char *const names[4] = {"corner_position", "middle_position", "corner_tangent",
                                         "middle_tangent"};
    int position_counts[LEVEL_COUNT], normal_counts[LEVEL_COUNT];
    for (int l = 0; l < 4; l++) {
        printf("static const uint16_t %s_rows[] = {", names[l]);
        for (int r = 0; r < all[l]->row_stride; r++)
            printf("%s%d", r == 0 ? "" : r % 16 == 0 ? ",\n    " : ", ", all[l]->rows[r]);
        printf("};\n\n");
    }
    print_copies("position", positions, position_counts);
    print_copies("normal", of_tangents, normal_counts);
    printf("const limni_pieces limni_pieces_triangle = {\n");
    for (int l = 0; l < 4; l++) {
        if (l % 2 == 0) printf("    .%s = {\n", l ? "tangents" : "positions");
        print_piece_layout(names[l], all[l]);
        if (l % 2) printf("    },\n");
    }
    printf("    .position_copies = position_copies,\n");
    print_list("position_copy_counts", position_counts);
    printf("    .normal_copies = normal_copies,\n");
    print_list("normal_copy_counts", normal_counts);
    printf("};\n\n");
}

int main(void) {
    int index_counts[LEVEL_COUNT];
    number_rows();
    printf("/* SPDX-License-Identifier: MIT */\n"
           "/* Written by generate_domain.c; do not edit. */\n"
           "#include \"domain.h\"\n\n// clang-format off\n");
    print_rows();
    print_edges();
    for (int level = 0; level < LEVEL_COUNT; level++)
        index_counts[level] = print_indices(level);
    print_layouts();
    print_pieces();
    printf("const limn_domain limni_domain_triangle = {\n"
           "    .kind = LIMN_DOMAIN_TRIANGLE,\n    .corner_count = %d,\n",
           CORNERS);
    print_list("row_counts", row_counts);
    print_list("index_counts", index_counts);
    printf("    .indices = {indices_0, indices_1, indices_2, indices_3, indices_4},\n"
           "    .rows = rows,\n    .edge_rows = edge_rows,\n};\n");
    return 0;
}
