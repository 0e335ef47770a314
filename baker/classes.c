/* SPDX-License-Identifier: MIT */
#include "classes.h"

#include "hash.h"
#include "limn/limn.h"

#include <string.h>

// ---- Dictionaries

static uint64_t key_hash(const uint32_t *words, uint32_t size) {
    uint64_t hash = size;
    for (uint32_t w = 0; w < size; w++)
        hash = limni_hash_mix(hash, words[w]);
    return hash;
}

static uint64_t table_hash(const limni_class *class) {
    uint64_t hash = class->control_count;
    for (size_t f = 0; f < limni_class_table_size(class) / sizeof(float); f++) {
        uint32_t bits;
        memcpy(&bits, &class->table[f], sizeof bits);
        hash = limni_hash_mix(hash, bits);
    }
    return hash;
}

/// Where a key is in the dictionary, or where it would go.
static uint32_t *find_key(const limni_classes *classes, const uint32_t *words, uint32_t size) {
    const limni_index_table *const table = &classes->by_key;
    uint32_t at = (uint32_t)key_hash(words, size) & (table->size - 1);
    for (; table->indices[at] != LIMNI_NONE; at = (at + 1) & (table->size - 1)) {
        const limni_class_key *const key = &classes->keys[table->indices[at]];
        if (key->size == size && memcmp(key->words, words, size * sizeof *words) == 0) break;
    }
    return &table->indices[at];
}

/// Where an equal table is in the dictionary, or where this one would go.
static uint32_t *find_table(const limni_classes *classes, const limni_class *class) {
    const limni_index_table *const table = &classes->by_table;
    uint32_t at = (uint32_t)table_hash(class) & (table->size - 1);
    for (; table->indices[at] != LIMNI_NONE; at = (at + 1) & (table->size - 1)) {
        const limni_class *const other = &classes->items[table->indices[at]];
        if (other->control_count == class->control_count &&
            memcmp(other->table, class->table, limni_class_table_size(class)) == 0)
            break;
    }
    return &table->indices[at];
}

static limn_bake_status clear_table(limni_context *context, uint32_t capacity,
                                    limni_index_table *table) {
    limni_release(context, table->indices);
    table->size = limni_hash_size(capacity);
    table->indices = limni_allocate(context, table->size, sizeof *table->indices);
    if (!table->indices) return LIMN_BAKE_MEMORY;
    memset(table->indices, 0xff, table->size * sizeof *table->indices);
    return LIMN_BAKE_OK;
}

static limn_bake_status grow(limni_context *context, limni_classes *classes) {
    const uint32_t capacity = classes->capacity ? 2 * classes->capacity : 64;
    limni_class *const items = limni_resize(context, classes->items, capacity, sizeof *items);
    if (!items) return LIMN_BAKE_MEMORY;
    classes->items = items;
    limni_class_key *const keys = limni_resize(context, classes->keys, capacity, sizeof *keys);
    if (!keys) return LIMN_BAKE_MEMORY;
    classes->keys = keys;
    classes->capacity = capacity;
    LIMNI_TRY(clear_table(context, capacity, &classes->by_key));
    LIMNI_TRY(clear_table(context, capacity, &classes->by_table));
    for (uint32_t k = 0; k < classes->key_count; k++)
        *find_key(classes, keys[k].words, keys[k].size) = k;
    for (uint32_t c = 0; c < classes->count; c++)
        *find_table(classes, &items[c]) = c;
    return LIMN_BAKE_OK;
}

// ---- Tables

/// Adds one column along one edge to a hash. Read against the edge, `negated` turns the signs.
static uint64_t print_column(uint64_t hash, const float *column, const uint16_t *edge_rows,
                             bool along, bool negated, bool *any) {
    for (uint32_t t = 0; t <= LIMN_GRID_SIZE; t++) {
        const float value = column[edge_rows[along ? t : LIMN_GRID_SIZE - t]];
        const float seen = value != 0 && negated ? -value : value;
        uint32_t bits;
        memcpy(&bits, &seen, sizeof bits);
        *any |= bits != 0;
        hash = limni_hash_mix(hash, bits);
    }
    return hash;
}

/// The columns of a slot along one edge. The neighbour has the positions in the opposite order, and
/// the tangents with the opposite sign as well.
static uint64_t print_edge(const limni_class *class, uint32_t slot, uint32_t edge, bool along) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    uint64_t hash = 0;
    bool any = false;
    for (uint32_t table = 0; table < class->table_count; table++) {
        const size_t column = ((size_t)table * class->control_count + slot) * LIMNI_TABLE_STRIDE;
        hash = print_column(hash, class->table + column, domain->edge_rows[edge], along,
                            table > 0 && !along, &any);
    }
    return any ? hash : 0;
}

/// Numbers the columns that are not zero everywhere, in the order of the slots. Returns how many.
static uint32_t number_columns(const limni_fixed *rows, size_t row_count, uint32_t slot_count,
                               uint16_t *slots) {
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < slot_count; slot++) {
        bool used = false;
        for (size_t row = 0; row < row_count && !used; row++)
            used = rows[row * slot_count + slot] != 0;
        slots[slot] = used ? (uint16_t)count++ : (uint16_t)LIMNI_SLOT_UNUSED;
    }
    return count;
}

/// Rounds the coefficients to floats, and remembers the columns along each edge.
static void fill_tables(const limni_fixed *rows, uint32_t slot_count, const uint16_t *slots,
                        limni_class *class) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    const size_t row_count = domain->row_counts[LIMN_LEVEL_MAX];
    for (uint32_t slot = 0; slot < slot_count; slot++) {
        const uint32_t own = slots[slot];
        if (own == LIMNI_SLOT_UNUSED) continue;
        for (size_t table = 0; table < class->table_count; table++) {
            float *const column =
                class->table + (table * class->control_count + own) * LIMNI_TABLE_STRIDE;
            for (size_t row = 0; row < row_count; row++)
                column[row] =
                    limni_fixed_to_float(rows[(table * row_count + row) * slot_count + slot]);
        }
        for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
            class->prints[own].along[edge] = print_edge(class, own, edge, true);
            class->prints[own].against[edge] = print_edge(class, own, edge, false);
        }
    }
}

/// Computes the tables of a local base, and which slot has which column.
static limn_bake_status make_class(limni_context *context, const limni_rules *rules,
                                   const limni_neighbourhood *neighbourhood, uint16_t *slots,
                                   limni_class *class) {
    const size_t row_count = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->row_counts[LIMN_LEVEL_MAX];
    const uint32_t slot_count = neighbourhood->control_count;
    const uint32_t table_count = rules->normals == LIMN_NORMALS_EXACT ? 3 : 1;
    limni_fixed *const rows =
        limni_allocate(context, table_count * row_count * slot_count, sizeof *rows);
    if (!rows) return LIMN_BAKE_MEMORY;
    limni_fixed *const tangents = table_count == 3 ? rows + row_count * slot_count : NULL;
    LIMNI_TRY(limni_subdivide(context, rules, neighbourhood, LIMN_LEVEL_MAX, LIMNI_PROJECT_TO_LIMIT,
                              rows, tangents));
    *class = (limni_class){.control_count =
                               number_columns(rows, table_count * row_count, slot_count, slots),
                           .table_count = table_count};
    class->table = limni_allocate_zeroed(context, limni_class_table_size(class), 1);
    class->prints = limni_allocate(context, class->control_count, sizeof *class->prints);
    if (!class->table || !class->prints) return LIMN_BAKE_MEMORY;
    for (uint32_t corner = 0; corner < 3; corner++) {
        class->valences[corner] = neighbourhood->corners[corner].count;
        class->boundary_corners |= (uint32_t)!neighbourhood->corners[corner].closed << corner;
    }
    fill_tables(rows, slot_count, slots, class);
    limni_release(context, rows);
    return LIMN_BAKE_OK;
}

// ---- Keys

static limn_bake_status add_key(limni_context *context, limni_classes *classes,
                                const limni_rules *rules, const limni_local_base *base) {
    limni_class_key *const key = &classes->keys[classes->key_count];
    *key = (limni_class_key){
        .words = limni_allocate(context, base->key_size, sizeof *key->words),
        .size = base->key_size,
        .slots = limni_allocate(context, base->neighbourhood.control_count, sizeof *key->slots),
    };
    if (!key->words || !key->slots) return LIMN_BAKE_MEMORY;
    memcpy(key->words, base->key, base->key_size * sizeof *key->words);

    limni_class *const made = &classes->items[classes->count];
    LIMNI_TRY(make_class(context, rules, &base->neighbourhood, key->slots, made));
    uint32_t *const place = find_table(classes, made);
    if (*place == LIMNI_NONE) {
        *place = classes->count++;
    } else {
        limni_release(context, made->table);
        limni_release(context, made->prints);
    }
    key->class_index = *place;
    classes->key_count++;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_classes_find(limni_context *context, limni_classes *classes,
                                    const limni_rules *rules, const limni_local_base *base,
                                    uint32_t *key_index) {
    if (classes->key_count == classes->capacity) LIMNI_TRY(grow(context, classes));
    uint32_t *const place = find_key(classes, base->key, base->key_size);
    if (*place == LIMNI_NONE) {
        LIMNI_TRY(add_key(context, classes, rules, base));
        *place = classes->key_count - 1;
    }
    *key_index = *place;
    return LIMN_BAKE_OK;
}
