/* SPDX-License-Identifier: MIT */
/* Every template of each domain, as triangles and as strips, and the expanded strip. */
#include "check.h"
#include "limn/limn.h"

enum { ROWS_MAX = 289, TEMPLATES_MAX = 979, INDICES_MAX = 1000000 };

static const limn_domain *domain;

/// Twice that of a patch, in grid steps.
static int patch_area(void) {
    return (domain->kind == LIMN_DOMAIN_QUAD ? 2 : 1) * LIMN_GRID_SIZE * LIMN_GRID_SIZE;
}

/// How often each directed edge between two rows is used.
static uint8_t used[ROWS_MAX][ROWS_MAX];

static int doubled_area(uint16_t a, uint16_t b, uint16_t c) {
    const limn_row p = domain->rows[a], q = domain->rows[b], r = domain->rows[c];
    return (q.i - p.i) * (r.j - p.j) - (q.j - p.j) * (r.i - p.i);
}

/// Adds a triangle; returns twice its area in grid steps.
static int add_triangle(uint16_t a, uint16_t b, uint16_t c) {
    const int area = doubled_area(a, b, c);
    CHECK(area > 0); // oriented, and not degenerate
    used[a][b]++, used[b][c]++, used[c][a]++;
    return area;
}

static bool is_kept(uint16_t row, uint32_t level, const uint8_t *edge_levels) {
    if (domain->rows[row].level > level) return false;
    for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
        if (domain->rows[row].edges >> edge & 1 && domain->rows[row].level > edge_levels[edge])
            return false;
    }
    return true;
}

/// Inner edges once in each direction, the kept steps of the patch's edges once, and nothing else.
static void check_edges(uint32_t level, const uint8_t *edge_levels) {
    bool good = true;
    uint32_t outer = 0;
    for (uint16_t a = 0; a < domain->row_counts[level]; a++) {
        for (uint16_t b = 0; b < domain->row_counts[level]; b++) {
            if (!used[a][b]) continue;
            good &=
                used[a][b] == 1 && is_kept(a, level, edge_levels) && is_kept(b, level, edge_levels);
            if (!(domain->rows[a].edges & domain->rows[b].edges)) {
                good &= used[b][a] == 1;
            } else {
                good &= used[b][a] == 0;
                outer++;
            }
        }
    }
    CHECK(good);
    uint32_t steps = 0;
    for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
        const uint32_t step = LIMN_GRID_SIZE >> edge_levels[edge];
        for (uint32_t t = 0; t < LIMN_GRID_SIZE; t += step, steps++)
            CHECK_EQUAL(used[domain->edge_rows[edge][t]][domain->edge_rows[edge][t + step]], 1);
    }
    CHECK_EQUAL(outer, steps);
}

/// Adds a list or strips with restarts; returns twice the area.
static int add_template(limn_topology topology, const uint16_t *indices, uint32_t count) {
    int area = 0;
    if (topology == LIMN_TOPOLOGY_TRIANGLES) {
        for (uint32_t i = 0; i < count; i += 3)
            area += add_triangle(indices[i], indices[i + 1], indices[i + 2]);
        return area;
    }
    for (uint32_t i = 0, start = 0; i + 2 < count; i++) {
        if (indices[i + 2] == LIMN_RESTART) {
            start = i + 3;
            i += 2;
            continue;
        }
        const bool odd = (i - start) % 2;
        area += add_triangle(indices[i + odd], indices[i + !odd], indices[i + 2]);
    }
    return area;
}

static void check_template(uint32_t level, const uint8_t *edge_levels, bool *seen) {
    uint16_t indices[LIMN_TEMPLATE_INDEX_MAX];
    const uint32_t found = limn_template_find(domain, level, edge_levels);
    CHECK(found < limn_template_count(domain) && !seen[found]);
    seen[found] = true;
    for (int topology = LIMN_TOPOLOGY_TRIANGLES; topology <= LIMN_TOPOLOGY_STRIPS; topology++) {
        const uint32_t count = limn_template_write(domain, found, (limn_topology)topology, indices);
        CHECK(count <= LIMN_TEMPLATE_INDEX_MAX);
        memset(used, 0, sizeof used);
        CHECK_EQUAL(add_template((limn_topology)topology, indices, count), patch_area());
        check_edges(level, edge_levels);
        bool whole = topology == LIMN_TOPOLOGY_TRIANGLES;
        for (uint32_t edge = 0; edge < domain->corner_count; edge++)
            whole &= level == edge_levels[edge];
        if (whole)
            CHECK(count == domain->index_counts[level] &&
                  memcmp(indices, domain->indices[level], count * sizeof *indices) == 0);
    }
}

static void test_each(void) {
    bool seen[TEMPLATES_MAX] = {false};
    CHECK_EQUAL(limn_template_count(domain), domain->kind == LIMN_DOMAIN_QUAD ? 979 : 225);
    for (uint8_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        const uint8_t last = domain->corner_count == 4 ? level : 0;
        uint8_t e[LIMN_CORNER_MAX] = {0};
        for (e[0] = 0; e[0] <= level; e[0]++) {
            for (e[1] = 0; e[1] <= level; e[1]++) {
                for (e[2] = 0; e[2] <= level; e[2]++) {
                    for (e[3] = 0; e[3] <= last; e[3]++)
                        check_template(level, e, seen);
                }
            }
        }
    }
}

/// All at once: what each is alone, in both widths; quads do not fit bytes.
static void test_all(limn_topology topology, uint32_t *total) {
    static uint16_t wide[INDICES_MAX];
    static uint8_t narrow[INDICES_MAX];
    const bool fits = domain->row_counts[LIMN_LEVEL_MAX] < 256;
    limn_template templates[TEMPLATES_MAX];
    *total = limn_templates_write(domain, topology, 2, NULL, NULL);
    if (!CHECK(*total <= INDICES_MAX)) return;
    CHECK_EQUAL(limn_templates_write(domain, topology, 2, wide, templates), *total);
    CHECK_EQUAL(limn_templates_write(domain, topology, 1, NULL, NULL), fits ? *total : 0);
    CHECK_EQUAL(limn_templates_write(domain, topology, 1, narrow, NULL), fits ? *total : 0);
    uint32_t next = 0;
    for (uint32_t index = 0; index < limn_template_count(domain); index++) {
        uint16_t own[LIMN_TEMPLATE_INDEX_MAX];
        const uint32_t count = limn_template_write(domain, index, topology, own);
        CHECK_EQUAL(templates[index].first_index, next);
        CHECK_EQUAL(templates[index].index_count, count);
        CHECK(memcmp(wide + next, own, count * sizeof *own) == 0);
        next += count;
    }
    bool same = true;
    for (uint32_t i = 0; i < *total && fits; i++)
        same &= narrow[i] == (wide[i] & 0xff);
    CHECK(same && next == *total);
}

static void test_expanded(void) {
    static const uint8_t edges[LIMN_LEVEL_COUNT][LIMN_CORNER_MAX] = {
        {0, 0, 0, 0}, {1, 1, 1, 1}, {2, 2, 2, 2}, {3, 3, 3, 3}, {4, 4, 4, 4}};
    for (uint32_t level = 0; level < LIMN_LEVEL_COUNT; level++) {
        uint16_t rows[LIMN_EXPANDED_STRIP_MAX];
        const uint32_t count = limn_expanded_strip(domain, level, rows);
        CHECK(count <= LIMN_EXPANDED_STRIP_MAX);
        int area = 0;
        memset(used, 0, sizeof used);
        for (uint32_t i = 0; i + 2 < count; i++) {
            const uint16_t a = rows[i + i % 2], b = rows[i + !(i % 2)], c = rows[i + 2];
            if (a != b && b != c && c != a) area += add_triangle(a, b, c);
        }
        CHECK_EQUAL(area, patch_area());
        check_edges(level, edges[level]);
    }
}

static void test_domain(limn_domain_kind kind) {
    domain = limn_domain_get(kind);
    uint32_t triangles, strips;
    test_each();
    test_all(LIMN_TOPOLOGY_TRIANGLES, &triangles);
    test_all(LIMN_TOPOLOGY_STRIPS, &strips);
    test_expanded();
    printf("%u templates: %u indices of triangles, %u of strips\n", limn_template_count(domain),
           triangles, strips);
    CHECK(strips < triangles / 2);
}

int main(void) {
    test_domain(LIMN_DOMAIN_TRIANGLE);
    test_domain(LIMN_DOMAIN_QUAD);
    return check_report();
}
