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

static size_t table_size(const limni_class *class) {
    return (size_t) class->control_count * LIMNI_TABLE_STRIDE * sizeof *class->table;
}

static uint64_t table_hash(const limni_class *class) {
    uint64_t hash = class->control_count;
    for (size_t f = 0; f < table_size(class) / sizeof(float); f++) {
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
            memcmp(other->table, class->table, table_size(class)) == 0)
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

/// Numbers the columns that are not zero everywhere, in the order of the slots. Returns how many.
static uint32_t number_columns(const limni_fixed *rows, uint32_t slot_count, uint16_t *slots) {
    const uint32_t row_count = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->row_counts[LIMN_LEVEL_MAX];
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < slot_count; slot++) {
        bool used = false;
        for (uint32_t row = 0; row < row_count && !used; row++)
            used = rows[(size_t)row * slot_count + slot] != 0;
        slots[slot] = used ? (uint16_t)count++ : (uint16_t)LIMNI_SLOT_UNUSED;
    }
    return count;
}

/// Rounds the coefficients to floats, and remembers each column along each edge.
static void fill_table(const limni_fixed *rows, uint32_t slot_count, const uint16_t *slots,
                       limni_class *class) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    for (uint32_t slot = 0; slot < slot_count; slot++) {
        if (slots[slot] == LIMNI_SLOT_UNUSED) continue;
        float *const column = class->table + (size_t)slots[slot] * LIMNI_TABLE_STRIDE;
        for (uint32_t row = 0; row < domain->row_counts[LIMN_LEVEL_MAX]; row++)
            column[row] = limni_fixed_to_float(rows[(size_t)row * slot_count + slot]);
        limni_edge_prints *const prints = &class->prints[slots[slot]];
        for (uint32_t edge = 0; edge < domain->corner_count; edge++) {
            prints->along[edge] = print_edge(column, domain, edge, true);
            prints->against[edge] = print_edge(column, domain, edge, false);
        }
    }
}

/// Computes the table of a local base, and which slot has which column.
static limn_bake_status make_class(limni_context *context, const limni_rules *rules,
                                   const limni_neighbourhood *neighbourhood, uint16_t *slots,
                                   limni_class *class) {
    const uint32_t slot_count = neighbourhood->control_count;
    limni_fixed *const rows =
        limni_allocate(context, (size_t)LIMNI_TABLE_STRIDE * slot_count, sizeof *rows);
    if (!rows) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_subdivide(context, rules, neighbourhood, LIMN_LEVEL_MAX, LIMNI_PROJECT_TO_LIMIT,
                              rows));
    *class = (limni_class){.control_count = number_columns(rows, slot_count, slots)};
    class->table = limni_allocate_zeroed(
        context, (size_t) class->control_count * LIMNI_TABLE_STRIDE, sizeof *class->table);
    class->prints = limni_allocate(context, class->control_count, sizeof *class->prints);
    if (!class->table || !class->prints) return LIMN_BAKE_MEMORY;
    for (uint32_t corner = 0; corner < 3; corner++) {
        class->valences[corner] = neighbourhood->corners[corner].count;
        class->boundary_corners |= (uint32_t)!neighbourhood->corners[corner].closed << corner;
    }
    fill_table(rows, slot_count, slots, class);
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
