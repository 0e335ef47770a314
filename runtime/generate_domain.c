/* SPDX-License-Identifier: MIT */
/*
 * Writes domain_triangle.c or domain_quad.c to standard output; the argument says which. The results
 * are committed, so that cross builds need no host program; the test `domain_generated` compares
 * them.
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEVEL_COUNT = 5, LEVEL_MAX = 4, GRID = 16, ROW_BLOCK = 8, CORNER_MAX = 4, ROW_MAX = 289 };
enum { PAIRED = 3 }; ///< the first level with pairs of rows
enum { EDGE_ROWS = 16, NO_ROW = 0xffff };

typedef struct point {
    int i, j;
} point;

/// What makes a domain; all else follows.
typedef struct shape {
    const char *name, *kind;
    int corner_count;
    point corners[CORNER_MAX];
    int diagonal; ///< cells are cut from (i, j) to (i + 1, j + 1): 1; or between the others: -1
    void (*add_interior)(int level);
    bool paired;       ///< classes that are their own mirror images have tables of their own
    int inside_level;  ///< the first whose tangents inside are not among those of the edges
    bool middle_piece; ///< of the four pieces, the last is not at a corner
    /// Of a piece's tangents, the block of the half edge that leads to its corner.
    point second_half[ROW_BLOCK];
} shape;

static const shape *of;

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
    const point a = of->corners[edge], b = of->corners[(edge + 1) % of->corner_count];
    return (point){a.i + (b.i - a.i) / GRID * t, a.j + (b.j - a.j) / GRID * t};
}

/// From the grid as seen from a corner: i along the edge that starts there, j back along the one
/// that ends there.
static point seen_from(int corner, int i, int j) {
    const int n = of->corner_count;
    const point a = of->corners[corner], b = of->corners[(corner + 1) % n],
                c = of->corners[(corner + n - 1) % n];
    return (point){a.i + (i * (b.i - a.i) + j * (c.i - a.i)) / GRID,
                   a.j + (i * (b.j - a.j) + j * (c.j - a.j)) / GRID};
}

static int edges_of(point p) {
    int edges = 0;
    for (int edge = 0; edge < of->corner_count; edge++) {
        for (int t = 0; t <= GRID; t++) {
            const point at = edge_point(edge, t);
            if (at.i == p.i && at.j == p.j) edges |= 1 << edge;
        }
    }
    return edges;
}

static void add_row(point p, int level) {
    if (has_row(p.i, p.j)) return;
    row_levels[row_count] = level;
    rows[row_count++] = p;
}

// ---- Rows inside a triangle

enum { IN_CORNER, IN_NEXT_CORNER, IN_MIDDLE }; ///< pieces on the side i > j of the mirror line

static int place_of(point p) {
    if (p.i + p.j < GRID / 2) return IN_CORNER;
    return p.i > GRID / 2 ? IN_NEXT_CORNER : IN_MIDDLE;
}

/// Rows on one side of the mirror line that a level adds to one piece, by ascending j, then i, as
/// seen from `corner`; or their images.
///
/// side  0: rows on the line i = j, 1: those with i > j, -1: their images in the same view
static void add_side(int level, int piece, int side, bool image, int corner) {
    const int step = GRID >> level;
    for (int j = step; j < GRID; j += step) {
        for (int i = side ? j + step : j; i + j < GRID; i += side ? step : GRID) {
            const point p = side < 0 ? seen_from(corner, j, i) : seen_from(corner, i, j);
            if (place_of(p) == piece) add_row(image ? (point){p.j, p.i} : p, level);
        }
    }
}

/// Rows inside the triangle that a level adds on the side i > j, or their images: those of the
/// piece at corner 0; those at corner 1, in the order in which corner 0 has its own, which is that
/// of its mirror line, of one side of it, and of the other; those in the middle.
static void add_interior_side(int level, bool image) {
    add_side(level, IN_CORNER, 1, image, 0);
    for (int own = 0; own < 3; own++)
        add_side(level, IN_NEXT_CORNER, own == 2 ? -1 : own, image, 1);
    add_side(level, IN_MIDDLE, 1, image, 0);
}

/// The rows on the mirror line, those on one side of it, and their images, so that a patch that is
/// its own mirror image can be evaluated by halves; on one side piece by piece, so that the rows of
/// a piece are consecutive.
static void add_inside_triangle(int level) {
    const int step = GRID >> level;
    for (int i = step; 2 * i < GRID; i += step)
        add_row((point){i, i}, level);
    pair_rows[level] = row_count;
    add_interior_side(level, false);
    mirror_rows[level] = row_count;
    add_interior_side(level, true);
}

// ---- Rows inside a quad

/// The middle; then piece by piece, so that the rows of a piece are consecutive, each in the order
/// in which the corner sees its own. Of the lines between two pieces, each has the one that leads to
/// the middle from the edge that starts at its corner.
static void add_inside_quad(int level) {
    const int step = GRID >> level, half = GRID / 2;
    if (level > 0) add_row((point){half, half}, level);
    for (int corner = 0; corner < 4; corner++) {
        for (int j = step; j < half; j += step) {
            for (int i = step; i <= half; i += step)
                add_row(seen_from(corner, i, j), level);
        }
    }
}

static const shape shapes[] = {
    {.name = "triangle",
     .kind = "LIMN_DOMAIN_TRIANGLE",
     .corner_count = 3,
     .corners = {{0, 0}, {GRID, 0}, {0, GRID}},
     .diagonal = -1,
     .add_interior = add_inside_triangle,
     .paired = true,
     .inside_level = 3,
     .middle_piece = true,
     .second_half = {{0, 8}, {0, 4}, {0, 12}, {0, 2}, {0, 6}, {0, 10}, {0, 14}}},
    {.name = "quad",
     .kind = "LIMN_DOMAIN_QUAD",
     .corner_count = 4,
     .corners = {{0, 0}, {GRID, 0}, {GRID, GRID}, {0, GRID}},
     .diagonal = 1,
     .add_interior = add_inside_quad,
     .inside_level = 1,
     .second_half = {{16, 16}, {0, 8}, {0, 12}, {0, 4}, {0, 14}, {0, 10}, {0, 6}, {0, 2}}},
};

// ---- The domain

/// Nested order: what level n adds comes after all of level n - 1; edges first, each along its
/// direction, then the interior.
static void number_rows(void) {
    for (int level = 0; level < LEVEL_COUNT; level++) {
        const int step = GRID >> level;
        for (int corner = 0; corner < of->corner_count; corner++)
            add_row(of->corners[corner], level);
        for (int edge = 0; edge < of->corner_count; edge++) {
            for (int t = step; t < GRID; t += step)
                add_row(edge_point(edge, t), level);
        }
        of->add_interior(level);
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
            const int dj = p.j / step % 2 * step;
            const int di = p.i / step % 2 * step * (dj ? of->diagonal : 1);
            a = row_at(p.i - di, p.j - dj);
            b = row_at(p.i + di, p.j + dj);
        }
        const int elder = edges_of(p) ? find_elder(a, b) : -1;
        printf("    {%d, %d, %d, %d, {%d, %d}, {%d, %d}, %d},\n", p.i, p.j, row_levels[row],
               edges_of(p), a, b, elder < 0 ? a : elder, elder < 0 ? b : elder, row_at(p.j, p.i));
    }
    printf("};\n\n");
}

static int pad(int count) {
    return (count + ROW_BLOCK - 1) / ROW_BLOCK * ROW_BLOCK;
}

static void print_coordinate(const char *name, bool second) {
    printf("static const float grid_%s[%d] = {", name, pad(row_count));
    for (int row = 0; row < row_count; row++) {
        const int t = second ? rows[row].j : rows[row].i;
        printf("%s%.4ff", row == 0 ? "" : row % 12 == 0 ? ",\n    " : ", ", t / (double)GRID);
    }
    printf("};\n\n");
}

static void print_grid(void) {
    print_coordinate("u", false);
    print_coordinate("v", true);
    printf("const limni_grid limni_grid_%s = {grid_u, grid_v};\n\n", of->name);
}

static void print_edges(void) {
    printf("static const limn_edge_rows edge_rows[%d] = {\n", of->corner_count);
    for (int edge = 0; edge < of->corner_count; edge++) {
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

/// The cells of a triangle end at its third edge, where only the first half of the last is inside.
static int print_indices(int level) {
    const int step = GRID >> level, last = of->diagonal < 0 ? GRID : 2 * GRID;
    index_total = 0;
    printf("static const uint16_t indices_%d[] = {\n", level);
    for (int j = 0; j < GRID; j += step) {
        for (int i = 0; i < GRID && i + j < last; i += step) {
            const point a = {i, j}, b = {i + step, j}, c = {i, j + step}, d = {i + step, j + step};
            print_triangle(a, b, of->diagonal < 0 ? c : d);
            if (d.i + d.j > last) continue;
            print_triangle(of->diagonal < 0 ? b : a, d, c);
        }
    }
    printf("};\n\n");
    return index_total;
}

static void print_list(const char *name, const int values[LEVEL_COUNT]) {
    printf("    .%s = {", name);
    for (int level = 0; level < LEVEL_COUNT; level++)
        printf("%d%s", values[level], level < LEVEL_MAX ? ", " : "},\n");
}

// ---- Layouts

enum { SEGMENT_MAX = 4 };

typedef struct segment {
    int table_row, row, count;
} segment;

/// See limni_layout; the fields are the same.
typedef struct layout {
    int row_stride, rows[ROW_MAX + 2 * CORNER_MAX * EDGE_ROWS];
    segment segments[LEVEL_COUNT][SEGMENT_MAX];
    int pair_counts[LEVEL_COUNT], pair_table_row;
    int edge_counts[LEVEL_COUNT], inside_level;
} layout;

/// Appends places for rows [row, row + count), padded. `level` and finer ones read them as a
/// segment.
static void add_segment(layout *l, int level, int row, int count) {
    const segment added = {l->row_stride, row, pad(count)};
    for (int r = 0; r < added.count; r++)
        l->rows[l->row_stride++] = r < count ? row + r : NO_ROW;
    for (; level < LEVEL_COUNT; level++) {
        segment *free = l->segments[level];
        while (free->count)
            free++;
        *free = added;
    }
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
    add_segment(&l, LEVEL_MAX, 0, row_count);
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
    return row_counts[level - 1] + of->corner_count * (1 << (level - 1));
}

/// Appends two blocks for every edge: its rows up to level 3, with one of the rows inside that
/// level 2 adds, where all of these find room there; and its rows of level 4.
static void add_edges(layout *l) {
    static const int along[EDGE_ROWS] = {8, 4, 12, -1, 2, 6, 10, 14, 1, 3, 5, 7, 9, 11, 13, 15};
    static const int counts[LEVEL_COUNT] = {0, 1, 4, 8, 16};
    for (int edge = 0; edge < of->corner_count; edge++) {
        for (int r = 0; r < EDGE_ROWS; r++) {
            const point p = edge_point(edge, along[r]);
            const int inside = of->inside_level > 2 ? first_inside(2) + edge : NO_ROW;
            l->rows[l->row_stride++] = along[r] > 0 ? row_at(p.i, p.j) : inside;
        }
    }
    for (int level = 0; level < LEVEL_COUNT; level++)
        l->edge_counts[level] = counts[level];
}

/// Tangents, which corners do not need: edges; then what is inside, level by level.
static layout tangents(bool mirrored) {
    layout l = {0};
    add_edges(&l);
    l.inside_level = of->inside_level;
    for (int level = of->inside_level; level < LEVEL_COUNT; level++) {
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
        printf("        {");
        for (int i = 0; i < SEGMENT_MAX; i++) {
            const segment s = l->segments[level][i];
            if (i < 2 || s.count)
                printf("%s{%d, %d, %d}", i ? ", " : "", s.table_row, s.row, s.count);
        }
        printf("},\n");
    }
    printf("    },\n");
    if (l->pair_counts[LEVEL_MAX]) {
        print_list("pair_counts", l->pair_counts);
        printf("    .pair_table_row = %d,\n", l->pair_table_row);
        print_blocks("pair_rows", pair_rows);
        print_blocks("mirror_rows", mirror_rows);
    }
    print_list("edge_counts", l->edge_counts);
    if (l->inside_level) printf("    .inside_level = %d,\n", l->inside_level);
    printf("    },\n");
}

/// Positions, then tangents; of each without pairs, and with.
static void print_layouts(void) {
    const int kinds = of->paired ? 2 : 1;
    static const char *const names[4] = {"plain_position", "mirrored_position", "plain_tangent",
                                         "mirrored_tangent"};
    layout layouts[4] = {plain_positions(), {0}, tangents(false), {0}};
    if (of->paired) {
        layouts[1] = mirrored_positions();
        layouts[3] = tangents(true);
    }
    for (int l = 0; l < 4; l++) {
        if (l % 2 < kinds) print_rows_of(names[l], &layouts[l]);
    }
    for (int table = 0; table < 2; table++) {
        printf("const limni_layout limni_%s_%s[%d] = {\n", table ? "tangents" : "positions",
               of->name, kinds);
        for (int l = 2 * table; l < 2 * table + kinds; l++)
            print_layout(names[l], &layouts[l]);
        printf("};\n\n");
    }
}

// ---- Pieces

/// Of an isolated patch: the faces at its corners; of a triangle, the last is in the middle.
enum { PIECES = 4, PIECE_DEPTH = LEVEL_MAX - 1, PIECE_ROWS = 80, COPY_MAX = 4 };

static bool is_middle(int piece) {
    return of->middle_piece && piece == PIECES - 1;
}

/// Where a row of a piece is in the patch. The corners of a middle piece are the middles of edges.
static int row_in_patch(int piece, point p) {
    const int i = p.i / 2, j = p.j / 2;
    const point at = is_middle(piece) ? (point){GRID / 2 - j, i + j} : seen_from(piece, i, j);
    return row_at(at.i, at.j);
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

static bool has_place(const piece_layout *l, int row) {
    for (int place = 0; place < l->row_stride; place++) {
        if (l->rows[place] == row) return true;
    }
    return false;
}

/// Further rows of a piece in the order of those of the patch, where most are consecutive; of a
/// corner's, in the second one, which leaves the fewest gaps in all.
///
/// take  whether a piece has a row
static void add_by_patch(piece_layout *l, int piece, bool (*take)(int piece, int row)) {
    for (int at = 0; at < row_count; at++) {
        for (int row = 0; row < row_counts[PIECE_DEPTH]; row++) {
            if (row_in_patch(piece, rows[row]) == at && take(piece, row) && !has_place(l, row))
                add_place(l, row, row_levels[at]);
        }
    }
    fill_block(l);
}

enum { CORNER_PIECE = 1 }; ///< the one that stands for all at corners

/// Of the rows between two pieces of a triangle, the middle one has all. Of a quad each has those of
/// the line that starts at its first edge, and all have the middle of the patch.
static bool has_position(int piece, int row) {
    if (is_middle(piece)) return true;
    return of->middle_piece ? !(edges_of(rows[row]) & 2)
                            : rows[row].j < GRID || rows[row].i == GRID;
}

static bool has_tangents_inside(int piece, int row) {
    return has_position(piece, row) && !edges_of(rows[row_in_patch(piece, rows[row])]);
}

static piece_layout piece_positions(int piece) {
    piece_layout l = {0};
    add_by_patch(&l, piece, has_position);
    return l;
}

static void add_half(piece_layout *l, int piece, const point half[ROW_BLOCK]) {
    for (int r = 0; r < ROW_BLOCK && half[r].i + half[r].j > 0; r++)
        add_place(l, row_at(half[r].i, half[r].j), row_levels[row_in_patch(piece, half[r])]);
    fill_block(l);
}

/// At a corner first a block each for the halves of the two edges, which are summed relative to a
/// point of the edge: the one that starts there, with its middle, and the other.
static piece_layout piece_tangents(int piece) {
    static const point first_half[ROW_BLOCK] = {{16, 0}, {8, 0}, {4, 0},  {12, 0},
                                                {2, 0},  {6, 0}, {10, 0}, {14, 0}};
    piece_layout l = {0};
    if (!is_middle(piece)) {
        add_half(&l, piece, first_half);
        add_half(&l, piece, of->second_half);
    }
    add_by_patch(&l, piece, has_tangents_inside);
    while (l.row_stride < piece_positions(piece).row_stride)
        l.rows[l.row_stride++] = NO_ROW;
    return l;
}

/// Where the rows of a patch wait: those of one piece behind those of another.
static int staged_row(const piece_layout layouts[2], int row) {
    for (int piece = 0, first = 0; piece < PIECES; piece++) {
        const piece_layout *const l = &layouts[is_middle(piece)];
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

static void print_piece_rows(const char *name, const piece_layout *l) {
    printf("static const uint16_t %s_rows[] = {", name);
    for (int r = 0; r < l->row_stride; r++)
        printf("%s%d", r == 0 ? "" : r % 16 == 0 ? ",\n    " : ", ", l->rows[r]);
    printf("};\n\n");
}

/// Positions, then tangents; of each those at corners, and that in the middle.
static void print_pieces(void) {
    const int kinds = of->middle_piece ? 2 : 1;
    const piece_layout layouts[4] = {piece_positions(CORNER_PIECE), piece_positions(PIECES - 1), //
                                     piece_tangents(CORNER_PIECE), piece_tangents(PIECES - 1)};
    static const char *const names[4] = {"corner_position", "middle_position", "corner_tangent",
                                         "middle_tangent"};
    int position_counts[LEVEL_COUNT], normal_counts[LEVEL_COUNT];
    for (int l = 0; l < 4; l++) {
        if (l % 2 < kinds) print_piece_rows(names[l], &layouts[l]);
    }
    print_copies("position", layouts, position_counts);
    print_copies("normal", layouts + 2, normal_counts);
    printf("const limni_pieces limni_pieces_%s = {\n", of->name);
    for (int table = 0; table < 2; table++) {
        printf("    .%s = {\n", table ? "tangents" : "positions");
        for (int l = 2 * table; l < 2 * table + kinds; l++)
            print_piece_layout(names[l], &layouts[l]);
        printf("    },\n");
    }
    printf("    .position_copies = position_copies,\n");
    print_list("position_copy_counts", position_counts);
    printf("    .normal_copies = normal_copies,\n");
    print_list("normal_copy_counts", normal_counts);
    printf("};\n\n");
}

static bool choose_shape(const char *name) {
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        if (strcmp(shapes[s].name, name) == 0) of = &shapes[s];
    }
    return of;
}

int main(int argc, char **argv) {
    int index_counts[LEVEL_COUNT];
    if (argc != 2 || !choose_shape(argv[1])) {
        fprintf(stderr, "usage: generate_domain triangle|quad\n");
        return 1;
    }
    number_rows();
    printf("/* SPDX-License-Identifier: MIT */\n"
           "/* Written by generate_domain.c; do not edit. */\n"
           "#include \"domain.h\"\n\n// clang-format off\n");
    print_rows();
    print_grid();
    print_edges();
    for (int level = 0; level < LEVEL_COUNT; level++)
        index_counts[level] = print_indices(level);
    print_layouts();
    print_pieces();
    printf("const limn_domain limni_domain_%s = {\n"
           "    .kind = %s,\n    .corner_count = %d,\n",
           of->name, of->kind, of->corner_count);
    print_list("row_counts", row_counts);
    print_list("index_counts", index_counts);
    printf("    .indices = {indices_0, indices_1, indices_2, indices_3, indices_4},\n"
           "    .rows = rows,\n    .edge_rows = edge_rows,\n};\n");
    return 0;
}
