/* SPDX-License-Identifier: MIT */
#include "classes.h"

#include "../runtime/domain.h"
#include "hash.h"
#include "limn/limn.h"
#include "mirror.h"

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
            other->pair_count == class->pair_count &&
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

enum { ROW_COUNT = 153 };

/// What a class is made from.
typedef struct class_maker {
    limni_coefficients coefficients;
    limni_fixed *rows;      ///< the same
    bool *used;             ///< [slot_count] whether it has a column
    uint16_t *images;       ///< [slot_count] mirror images, if there are pairs
    uint32_t pair_count;    ///< of columns
    uint32_t control_count; ///< columns
} class_maker;

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

/// The columns of one slot, a row each, for all tables.
typedef float slot_columns[3][ROW_COUNT];

/// The columns of a slot along one edge. The neighbour has the positions in the opposite order, and
/// the tangents with the opposite sign as well.
static limni_edge_print print_edge(float (*columns)[ROW_COUNT], uint32_t table_count, uint32_t edge,
                                   bool along) {
    const uint16_t *const rows = limn_domain_get(LIMN_DOMAIN_TRIANGLE)->edge_rows[edge];
    bool any = false, any_tangent = false;
    limni_edge_print print = {.positions = print_column(0, columns[0], rows, along, false, &any)};
    for (uint32_t table = 1; table < table_count; table++)
        print.tangents =
            print_column(print.tangents, columns[table], rows, along, !along, &any_tangent);
    if (!any) print.positions = 0;
    if (!any_tangent) print.tangents = 0;
    return print;
}

/// Finds the columns that are not zero everywhere.
static void find_used(const limni_coefficients *c, bool *used) {
    for (uint32_t slot = 0; slot < c->slot_count; slot++) {
        used[slot] = false;
        for (uint32_t row = 0; row < c->table_count * c->row_count && !used[slot]; row++)
            used[slot] = c->rows[(size_t)row * c->slot_count + slot] != 0;
    }
}

/// Numbers the columns in the order of the slots; where there is a mirror line, after slot 0 first
/// the pairs.
static void number_columns(class_maker *maker, uint16_t *columns) {
    const uint32_t slot_count = maker->coefficients.slot_count;
    uint16_t count = 0;
    for (uint32_t slot = 0; slot < slot_count; slot++)
        columns[slot] = LIMNI_SLOT_UNUSED;
    columns[0] = count++;
    for (uint32_t slot = 0; slot < slot_count && maker->pair_count; slot++) {
        if (!maker->used[slot] || maker->images[slot] <= slot) continue;
        columns[slot] = count++;
        columns[maker->images[slot]] = count++;
    }
    for (uint32_t slot = 1; slot < slot_count; slot++) {
        if (maker->used[slot] && columns[slot] == LIMNI_SLOT_UNUSED) columns[slot] = count++;
    }
    maker->control_count = count;
}

/// What a column of a slot has for a pair of rows: half the sum of the coefficients of a pair of
/// slots goes to the first, half the difference to the second.
static float pair_value(const class_maker *maker, uint32_t table, uint32_t row, uint32_t slot) {
    const uint32_t image = maker->images[slot];
    const limni_fixed own = limni_coefficient(&maker->coefficients, table, row, slot);
    const limni_fixed other = limni_coefficient(&maker->coefficients, table, row, image);
    if (image > slot) return limni_fixed_to_float(own + other) / 2;
    if (image < slot) return limni_fixed_to_float(other - own) / 2;
    return limni_fixed_to_float(own);
}

/// What pads a column stays zero.
static void fill_column(const class_maker *maker, uint32_t table, uint32_t slot,
                        const float rows[ROW_COUNT], float *column) {
    const limni_layout *const layout =
        limni_layout_get(LIMN_DOMAIN_TRIANGLE, table > 0, maker->pair_count);
    for (uint32_t place = 0; place < layout->row_stride; place++) {
        const uint32_t row = layout->rows[place];
        if (row == LIMNI_NO_ROW) continue;
        const bool paired = place - layout->pair_table_row < layout->pair_counts[LIMN_LEVEL_MAX];
        column[place] = paired ? pair_value(maker, table, row, slot) : rows[row];
    }
}

/// Rounds the coefficients of one slot to floats, and remembers the columns along each edge.
static void fill_slot(const class_maker *maker, uint32_t slot, uint32_t column_index,
                      limni_class *class) {
    slot_columns rows;
    for (uint32_t table = 0; table < class->table_count; table++) {
        float *const column = class->table + ((size_t)table * class->control_count + column_index) *
                                                 class->row_stride;
        for (uint32_t row = 0; row < ROW_COUNT; row++)
            rows[table][row] =
                limni_fixed_to_float(limni_coefficient(&maker->coefficients, table, row, slot));
        fill_column(maker, table, slot, rows[table], column);
    }
    for (uint32_t edge = 0; edge < 3; edge++) {
        limni_edge_prints *const prints = &class->prints[column_index];
        prints->along[edge] = print_edge(rows, class->table_count, edge, true);
        prints->against[edge] = print_edge(rows, class->table_count, edge, false);
    }
}

static limn_bake_status begin_class(limni_context *context, const limni_rules *rules,
                                    const limni_neighbourhood *neighbourhood, class_maker *maker) {
    const uint32_t slot_count = neighbourhood->control_count;
    const uint32_t table_count = rules->normals == LIMN_NORMALS_EXACT ? 3 : 1;
    limni_fixed *const rows =
        limni_allocate(context, (size_t)table_count * ROW_COUNT * slot_count, sizeof *rows);
    *maker = (class_maker){.coefficients = {.rows = rows,
                                            .table_count = table_count,
                                            .row_count = ROW_COUNT,
                                            .slot_count = slot_count},
                           .rows = rows,
                           .used = limni_allocate(context, slot_count, sizeof *maker->used),
                           .images = limni_allocate(context, slot_count, sizeof *maker->images)};
    if (!rows || !maker->used || !maker->images) return LIMN_BAKE_MEMORY;
    limni_fixed *const tangents = table_count == 3 ? rows + (size_t)ROW_COUNT * slot_count : NULL;
    return limni_subdivide(context, rules, neighbourhood, LIMN_LEVEL_MAX, LIMNI_PROJECT_TO_LIMIT,
                           rows, tangents);
}

static void end_class(limni_context *context, class_maker *maker) {
    limni_release(context, maker->rows);
    limni_release(context, maker->used);
    limni_release(context, maker->images);
}

/// Computes the tables of a local base, and which slot has which column.
static limn_bake_status make_class(limni_context *context, const limni_rules *rules,
                                   const limni_neighbourhood *neighbourhood, uint16_t *columns,
                                   limni_class *class) {
    class_maker maker;
    LIMNI_TRY(begin_class(context, rules, neighbourhood, &maker));
    find_used(&maker.coefficients, maker.used);
    maker.pair_count = limni_find_mirror(&maker.coefficients, maker.used, maker.images);
    number_columns(&maker, columns);
    const uint32_t row_stride =
        limni_layout_get(LIMN_DOMAIN_TRIANGLE, false, maker.pair_count)->row_stride;
    *class = (limni_class){.control_count = maker.control_count,
                           .pair_count = maker.pair_count,
                           .table_count = maker.coefficients.table_count,
                           .row_stride = row_stride};
    class->table = limni_allocate_zeroed(context, limni_class_table_size(class), 1);
    class->prints = limni_allocate(context, class->control_count, sizeof *class->prints);
    if (!class->table || !class->prints) return LIMN_BAKE_MEMORY;
    for (uint32_t corner = 0; corner < 3; corner++) {
        class->valences[corner] = neighbourhood->corners[corner].count;
        class->boundary_corners |= (uint32_t)!neighbourhood->corners[corner].closed << corner;
    }
    for (uint32_t slot = 0; slot < neighbourhood->control_count; slot++) {
        if (columns[slot] != LIMNI_SLOT_UNUSED) fill_slot(&maker, slot, columns[slot], class);
    }
    end_class(context, &maker);
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

limn_file_class limni_class_record(const limni_class *class) {
    limn_file_class record = {
        .control_count = class->control_count,
        .domain = LIMN_DOMAIN_TRIANGLE,
        .depth = LIMN_LEVEL_MAX,
        .boundary_corners = class->boundary_corners,
        .table_count = (uint16_t) class->table_count,
        .pair_count = (uint16_t) class->pair_count,
    };
    for (int corner = 0; corner < 3; corner++)
        record.valences[corner] = (uint16_t) class->valences[corner];
    return record;
}
