/* SPDX-License-Identifier: MIT */
/*
 * Index templates: one triangulation of a patch for each of its own level and those of its edges.
 * All follow from the domain: a row on an edge that is coarser than the patch moves to the nearest
 * row that the edge keeps, and triangles that collapse are left out.
 */
#include "domain.h"
#include "require.h"

#include <string.h>

enum { TRIANGLE_MAX = 512, NONE = 0xffff };

/// The triangles of one template.
typedef struct triangulation {
    uint16_t corners[TRIANGLE_MAX][3];
    uint32_t count;
} triangulation;

/// Where each row of the domain goes.
static void move_rows(const limn_domain *domain, const uint8_t edge_levels[LIMN_CORNER_MAX],
                      uint16_t *moved) {
    for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++)
        moved[row] = (uint16_t)row;
    for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
        const uint16_t *const rows = domain->edge_rows[edge];
        for (uint32_t t = 1; t < LIMN_GRID_SIZE; t++)
            moved[rows[t]] = rows[limni_kept_place(t, edge_levels[edge])];
    }
}

static void triangulate(const limn_domain *domain, uint32_t level,
                        const uint8_t edge_levels[LIMN_CORNER_MAX], triangulation *t) {
    uint16_t moved[LIMNI_ROWS_MAX];
    move_rows(domain, edge_levels, moved);
    t->count = 0;
    for (uint32_t i = 0; i < domain->index_counts[level]; i += 3) {
        const uint16_t *const indices = domain->indices[level] + i;
        const uint16_t a = moved[indices[0]], b = moved[indices[1]], c = moved[indices[2]];
        if (a == b || b == c || c == a) continue;
        uint16_t *const corners = t->corners[t->count++];
        corners[0] = a, corners[1] = b, corners[2] = c;
    }
}

// ---- Strips

/// The triangle on the left of each directed edge between rows: edges are ordered by the row that
/// they leave.
typedef struct edge_index {
    uint16_t first[LIMNI_ROWS_MAX + 1]; ///< edge of each row
    struct {
        uint16_t end, triangle;
    } edges[3 * TRIANGLE_MAX];
} edge_index;

static void index_edges(const triangulation *t, edge_index *left) {
    uint16_t next[LIMNI_ROWS_MAX + 1] = {0};
    for (uint32_t i = 0; i < t->count; i++) {
        for (uint32_t k = 0; k < 3; k++)
            next[t->corners[i][k] + 1]++;
    }
    for (uint32_t row = 0; row < LIMNI_ROWS_MAX; row++)
        next[row + 1] = (uint16_t)(next[row + 1] + next[row]);
    memcpy(left->first, next, sizeof next);
    for (uint32_t i = 0; i < t->count; i++) {
        const uint16_t *const c = t->corners[i];
        for (uint32_t k = 0; k < 3; k++) {
            const uint16_t place = next[c[k]]++;
            left->edges[place].end = c[(k + 1) % 3];
            left->edges[place].triangle = (uint16_t)i;
        }
    }
}

/// NONE: there is none.
static uint32_t triangle_left_of(const edge_index *left, uint16_t a, uint16_t b) {
    for (uint32_t e = left->first[a]; e < left->first[a + 1]; e++) {
        if (left->edges[e].end == b) return left->edges[e].triangle;
    }
    return NONE;
}

static uint16_t corner_behind(const uint16_t c[3], uint16_t a, uint16_t b) {
    return c[0] != a && c[0] != b ? c[0] : c[1] != a && c[1] != b ? c[1] : c[2];
}

/// A strip that begins with edge `first` of a triangle and goes on as far as there are triangles
/// that are not used yet. Returns its length in indices.
static uint32_t follow_strip(const triangulation *t, const edge_index *left, uint32_t triangle,
                             uint32_t first, bool used[TRIANGLE_MAX], uint16_t *strip) {
    const uint16_t *const c = t->corners[triangle];
    strip[0] = c[first], strip[1] = c[(first + 1) % 3];
    uint32_t length = 2;
    for (uint32_t next = triangle; next != NONE && !used[next];) {
        const uint16_t a = strip[length - 2], b = strip[length - 1];
        used[next] = true;
        const uint16_t corner = corner_behind(t->corners[next], a, b);
        strip[length++] = corner;
        // Triangle k of a strip is k, k + 1, k + 2 for even k, and k + 1, k, k + 2 for odd.
        next = length % 2 ? triangle_left_of(left, corner, b) : triangle_left_of(left, b, corner);
    }
    return length;
}

/// Strips with restarts between them. Triangles are taken up in order, each from the edge that
/// gives the longest strip. Returns the number of indices.
static uint32_t make_strips(const triangulation *t, uint16_t *indices) {
    edge_index left;
    bool used[TRIANGLE_MAX] = {false};
    uint32_t count = 0;
    index_edges(t, &left);
    for (uint32_t i = 0; i < t->count; i++) {
        if (used[i]) continue;
        uint16_t strip[TRIANGLE_MAX + 2];
        uint32_t best = 0, longest = 0;
        for (uint32_t first = 0; first < 3; first++) {
            bool tried[TRIANGLE_MAX];
            memcpy(tried, used, sizeof tried);
            const uint32_t length = follow_strip(t, &left, i, first, tried, strip);
            if (length > longest) best = first, longest = length;
        }
        if (count) indices[count++] = LIMN_RESTART;
        follow_strip(t, &left, i, best, used, strip);
        memcpy(indices + count, strip, longest * sizeof *strip);
        count += longest;
    }
    return count;
}

// ---- Public functions

/// Templates of all levels below `level`: (n + 1) choices for each edge of a patch of level n.
static uint32_t templates_below(const limn_domain *domain, uint32_t level) {
    uint32_t count = 0;
    for (uint32_t n = 0; n < level; n++) {
        uint32_t choices = 1;
        for (uint32_t edge = 0; edge < domain->corner_count; edge++)
            choices *= n + 1;
        count += choices;
    }
    return count;
}

uint32_t limn_template_count(const limn_domain *domain) {
    LIMNI_REQUIRE(domain, 0);
    return templates_below(domain, LIMN_LEVEL_COUNT);
}

uint32_t limn_template_find(const limn_domain *domain, uint32_t level,
                            const uint8_t edge_levels[LIMN_CORNER_MAX]) {
    LIMNI_REQUIRE(domain && level <= LIMN_LEVEL_MAX && edge_levels, 0);
    uint32_t place = 0;
    for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
        LIMNI_REQUIRE(edge_levels[edge] <= level, 0);
        place = place * (level + 1) + edge_levels[edge];
    }
    return templates_below(domain, level) + place;
}

/// The levels that template `index` is for.
static uint32_t levels_of(const limn_domain *domain, uint32_t index,
                          uint8_t edge_levels[LIMN_CORNER_MAX]) {
    uint32_t level = 0;
    while (templates_below(domain, level + 1) <= index)
        level++;
    uint32_t place = index - templates_below(domain, level);
    for (uint32_t edge = domain->corner_count; edge-- > 0; place /= level + 1)
        edge_levels[edge] = (uint8_t)(place % (level + 1));
    return level;
}

uint32_t limn_template_write(const limn_domain *domain, uint32_t index, limn_topology topology,
                             uint16_t indices[LIMN_TEMPLATE_INDEX_MAX]) {
    LIMNI_REQUIRE(domain && indices && index < limn_template_count(domain), 0);
    uint8_t edge_levels[LIMN_CORNER_MAX];
    triangulation t;
    triangulate(domain, levels_of(domain, index, edge_levels), edge_levels, &t);
    if (topology == LIMN_TOPOLOGY_STRIPS) return make_strips(&t, indices);
    memcpy(indices, t.corners, t.count * sizeof *t.corners);
    return 3 * t.count;
}

uint32_t limn_templates_write(const limn_domain *domain, limn_topology topology,
                              uint32_t index_size, void *indices, limn_template *templates) {
    LIMNI_REQUIRE(domain && (index_size == 1 || index_size == 2), 0);
    if (index_size == 1 && domain->row_counts[LIMN_LEVEL_MAX] > (LIMN_RESTART & 0xff)) return 0;
    uint32_t total = 0;
    for (uint32_t index = 0; index < limn_template_count(domain); index++) {
        uint16_t own[LIMN_TEMPLATE_INDEX_MAX];
        const uint32_t count = limn_template_write(domain, index, topology, own);
        if (templates) templates[index] = (limn_template){total, count};
        for (uint32_t i = 0; i < count && indices; i++) {
            if (index_size == 1) {
                ((uint8_t *)indices)[total + i] = (uint8_t)own[i];
            } else {
                ((uint16_t *)indices)[total + i] = own[i];
            }
        }
        total += count;
    }
    return total;
}

/// One row of cells as a strip, from right to left, so that all triangles are counter-clockwise.
/// `triangles` points to its triangles and is moved on. Returns the number of rows.
static uint32_t cell_row_strip(const uint16_t **triangles, uint32_t cells, bool quads,
                               uint16_t *strip) {
    uint16_t bottom[LIMN_GRID_SIZE + 1], top[LIMN_GRID_SIZE + 1];
    if (quads) top[0] = (*triangles)[5];
    for (uint32_t i = 0; i < cells; i++) {
        // Of a quad's cell a, b below, d above b; then a, d, c. Of a triangle's a, b, c above a; and
        // then b, d, c if that is inside.
        const uint16_t *const triangle = *triangles;
        bottom[i] = triangle[0], bottom[i + 1] = triangle[1], top[i + 1] = triangle[2];
        *triangles += quads || i + 1 < cells ? 6 : 3;
    }
    uint32_t length = 0;
    for (uint32_t i = cells; i > 0; i--) {
        strip[length++] = bottom[i];
        strip[length++] = top[i];
    }
    strip[length++] = bottom[0];
    if (quads) strip[length++] = top[0];
    return length;
}

uint32_t limn_expanded_strip(const limn_domain *domain, uint32_t level, uint16_t *rows) {
    LIMNI_REQUIRE(domain && level <= LIMN_LEVEL_MAX && rows, 0);
    const bool quads = domain->kind == LIMN_DOMAIN_QUAD;
    const uint16_t *triangles = domain->indices[level];
    uint32_t count = 0;
    for (uint32_t row = 0; row < 1u << level; row++) {
        uint16_t strip[2 * LIMN_GRID_SIZE + 2];
        const uint32_t cells = quads ? 1u << level : (1u << level) - row;
        const uint32_t length = cell_row_strip(&triangles, cells, quads, strip);
        if (count) { // each must begin at an even place
            rows[count] = rows[count - 1];
            rows[count + 1] = strip[0];
            count += 2;
            if (length % 2) rows[count++] = strip[0];
        }
        memcpy(rows + count, strip, length * sizeof *strip);
        count += length;
    }
    return count;
}
