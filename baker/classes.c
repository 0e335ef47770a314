/* SPDX-License-Identifier: MIT */
#include "classes.h"

#include "hash.h"
#include "limn/limn.h"

#include <string.h>

static uint64_t key_hash(const uint32_t *key, uint32_t size) {
    uint64_t hash = size;
    for (uint32_t k = 0; k < size; k++)
        hash = limni_hash_mix(hash, key[k]);
    return hash;
}

/// Where the key is in the hash table, or where it would go.
static uint32_t *find_place(const limni_classes *classes, const uint32_t *key, uint32_t size) {
    const uint32_t mask = classes->hash_size - 1;
    uint32_t at = (uint32_t)key_hash(key, size) & mask;
    for (; classes->hash_table[at] != LIMNI_NONE; at = (at + 1) & mask) {
        const limni_class *const class = &classes->items[classes->hash_table[at]];
        if (class->key_size == size && memcmp(class->key, key, size * sizeof *key) == 0) break;
    }
    return &classes->hash_table[at];
}

static limn_bake_status grow(limni_context *context, limni_classes *classes) {
    classes->capacity = classes->capacity ? 2 * classes->capacity : 64;
    classes->items =
        limni_resize(context, classes->items, classes->capacity, sizeof *classes->items);
    limni_release(context, classes->hash_table);
    classes->hash_size = limni_hash_size(classes->capacity);
    classes->hash_table = limni_allocate(context, classes->hash_size, sizeof *classes->hash_table);
    if (!classes->items || !classes->hash_table) return LIMN_BAKE_MEMORY;
    memset(classes->hash_table, 0xff, classes->hash_size * sizeof *classes->hash_table);
    for (uint32_t c = 0; c < classes->count; c++)
        *find_place(classes, classes->items[c].key, classes->items[c].key_size) = c;
    return LIMN_BAKE_OK;
}

static uint64_t print_edge(const float *column, const limn_domain *domain, uint32_t edge,
                           bool along) {
    uint64_t hash = 0, any = 0;
    for (uint32_t t = 0; t <= LIMN_GRID_SIZE; t++) {
        uint32_t bits;
        memcpy(&bits, &column[domain->edge_rows[edge][along ? t : LIMN_GRID_SIZE - t]],
               sizeof bits);
        any |= bits;
        hash = limni_hash_mix(hash, bits);
    }
    return any ? hash : 0;
}

/// Rounds the coefficients to floats, and remembers each column along each edge.
static void fill_table(limni_class *class, const limni_fixed *rows) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    for (uint32_t slot = 0; slot < class->control_count; slot++) {
        float *const column = class->table + (size_t)slot * LIMNI_TABLE_STRIDE;
        for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++)
            column[row] = limni_fixed_to_float(rows[(size_t)row * class->control_count + slot]);
        for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
            class->prints[slot].along[edge] = print_edge(column, domain, edge, true);
            class->prints[slot].against[edge] = print_edge(column, domain, edge, false);
        }
    }
}

static limn_bake_status make_class(limni_context *context, const limni_rules *rules,
                                   const limni_local_base *base, limni_class *class) {
    const limni_neighbourhood *const neighbourhood = &base->neighbourhood;
    const uint32_t control_count = neighbourhood->control_count;
    *class = (limni_class){
        .key = limni_allocate(context, base->key_size, sizeof *class->key),
        .key_size = base->key_size,
        .control_count = control_count,
        .table = limni_allocate_zeroed(context, (size_t)control_count * LIMNI_TABLE_STRIDE,
                                       sizeof *class->table),
        .prints = limni_allocate(context, control_count, sizeof *class->prints),
    };
    limni_fixed *const rows =
        limni_allocate(context, (size_t)LIMNI_TABLE_STRIDE * control_count, sizeof *rows);
    if (!class->key || !class->table || !class->prints || !rows) return LIMN_BAKE_MEMORY;
    memcpy(class->key, base->key, base->key_size * sizeof *class->key);
    for (uint32_t corner = 0; corner < 3; corner++) {
        class->valences[corner] = neighbourhood->corners[corner].count;
        class->boundary_corners |= (uint32_t)!neighbourhood->corners[corner].closed << corner;
    }
    LIMNI_TRY(limni_subdivide(context, rules, neighbourhood, LIMN_LEVEL_MAX, LIMNI_PROJECT_TO_LIMIT,
                              rows));
    fill_table(class, rows);
    limni_release(context, rows);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_classes_find(limni_context *context, limni_classes *classes,
                                    const limni_rules *rules, const limni_local_base *base,
                                    uint32_t *class_index) {
    if (classes->count == classes->capacity) LIMNI_TRY(grow(context, classes));
    uint32_t *const place = find_place(classes, base->key, base->key_size);
    if (*place == LIMNI_NONE) {
        LIMNI_TRY(make_class(context, rules, base, &classes->items[classes->count]));
        *place = classes->count++;
    }
    *class_index = *place;
    return LIMN_BAKE_OK;
}
