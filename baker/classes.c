/* SPDX-License-Identifier: MIT */
#include "classes.h"

#include "hash.h"
#include "limn/limn.h"
#include "mirror.h"
#include "subdivide.h"

#include <string.h>

// ---- Dictionaries

static uint64_t key_hash(const limni_class_key *key) {
    uint64_t hash = limni_hash_mix(3 * (uint64_t)key->size + key->kind, key->table_count);
    for (uint32_t w = 0; w < key->size; w++)
        hash = limni_hash_mix(hash, key->words[w]);
    return hash;
}

static uint64_t class_hash(const limni_class *class) {
    uint64_t hash = class->control_count;
    for (size_t w = 0; class->parts && w < limni_class_parts_size(class) / sizeof(uint16_t); w++)
        hash = limni_hash_mix(hash, class->parts[w]);
    for (size_t f = 0; f < limni_class_table_size(class) / sizeof(float); f++) {
        uint32_t bits;
        memcpy(&bits, &class->table[f], sizeof bits);
        hash = limni_hash_mix(hash, bits);
    }
    return hash;
}

/// Where an equal key is in the dictionary, or where this one would go.
static uint32_t *find_key(const limni_classes *classes, const limni_class_key *key) {
    const limni_index_table *const table = &classes->by_key;
    uint32_t at = (uint32_t)key_hash(key) & (table->size - 1);
    for (; table->indices[at] != LIMNI_NONE; at = (at + 1) & (table->size - 1)) {
        const limni_class_key *const other = &classes->keys[table->indices[at]];
        if (other->scheme == key->scheme && other->domain == key->domain &&
            other->kind == key->kind && other->table_count == key->table_count &&
            other->size == key->size &&
            memcmp(other->words, key->words, key->size * sizeof *key->words) == 0)
            break;
    }
    return &table->indices[at];
}

static bool are_equal(const limni_class *a, const limni_class *b) {
    if (a->domain != b->domain || a->kind != b->kind || a->control_count != b->control_count ||
        a->table_count != b->table_count || a->pair_count != b->pair_count ||
        !a->parts != !b->parts)
        return false;
    return a->parts ? memcmp(a->parts, b->parts, limni_class_parts_size(a)) == 0
                    : memcmp(a->table, b->table, limni_class_table_size(a)) == 0;
}

/// Where an equal class is in the dictionary, or where this one would go.
static uint32_t *find_class(const limni_classes *classes, const limni_class *class) {
    const limni_index_table *const table = &classes->by_table;
    uint32_t at = (uint32_t)class_hash(class) & (table->size - 1);
    for (; table->indices[at] != LIMNI_NONE; at = (at + 1) & (table->size - 1)) {
        if (are_equal(&classes->items[table->indices[at]], class)) break;
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
        *find_key(classes, &keys[k]) = k;
    for (uint32_t c = 0; c < classes->count; c++)
        *find_class(classes, &items[c]) = c;
    return LIMN_BAKE_OK;
}

// ---- Tables

/// What a class is made from.
typedef struct class_maker {
    const limn_domain *domain;
    limni_table_kind kind;
    int depth;
    limni_coefficients coefficients;
    limni_fixed *rows;      ///< the same
    bool *used;             ///< [slot_count] whether it has a column
    uint16_t *images;       ///< [slot_count] mirror images, if there are pairs
    uint32_t pair_count;    ///< of columns
    uint32_t control_count; ///< columns
} class_maker;

/// Adds one column along one edge to a hash. Read against the edge, `negated` turns the signs.
static uint64_t print_column(uint64_t hash, const float *column, const uint16_t *edge_rows,
                             uint32_t first, uint32_t step, bool along, bool negated, bool *any) {
    for (uint32_t t = first; t <= LIMN_GRID_SIZE - first; t += step) {
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
typedef float slot_columns[3][LIMNI_ROWS_MAX];

/// The columns of a slot along one edge, in grid steps of the depth. The neighbour has the
/// positions in the opposite order, and the tangents with the opposite sign as well; they are not
/// those of corners.
static limni_edge_print print_edge(const uint16_t *rows, float (*columns)[LIMNI_ROWS_MAX],
                                   uint32_t table_count, uint32_t step, bool along) {
    bool any = false, any_tangent = false;
    limni_edge_print print = {.positions =
                                  print_column(0, columns[0], rows, 0, step, along, false, &any)};
    for (uint32_t table = 1; table < table_count; table++)
        print.tangents = print_column(print.tangents, columns[table], rows, step, step, along,
                                      !along, &any_tangent);
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

/// The largest sum of what is below 0 in a row of positions.
static float find_negative(const limni_coefficients *c) {
    limni_fixed largest = 0;
    for (uint32_t row = 0; row < c->row_count; row++) {
        limni_fixed sum = 0;
        for (uint32_t slot = 0; slot < c->slot_count; slot++) {
            const limni_fixed coefficient = limni_coefficient(c, 0, row, slot);
            sum -= coefficient < 0 ? coefficient : 0;
        }
        largest = sum > largest ? sum : largest;
    }
    return limni_fixed_to_float(largest);
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

static const limni_piece_layout *piece_layout_of(const class_maker *maker, bool tangents) {
    const limni_pieces *const pieces = limni_pieces_get(maker->domain->kind);
    return &(tangents ? pieces->tangents : pieces->positions)[maker->kind - LIMNI_TABLE_CORNER];
}

/// What pads a column stays zero.
static void fill_piece_column(const class_maker *maker, uint32_t table,
                              const float rows[LIMNI_ROWS_MAX], float *column) {
    const limni_piece_layout *const layout = piece_layout_of(maker, table > 0);
    for (uint32_t place = 0; place < layout->row_stride; place++) {
        if (layout->rows[place] != LIMNI_NO_ROW) column[place] = rows[layout->rows[place]];
    }
}

static void fill_patch_column(const class_maker *maker, uint32_t table, uint32_t slot,
                              const float rows[LIMNI_ROWS_MAX], float *column) {
    const limni_layout *const layout =
        limni_layout_get(maker->domain->kind, table > 0, maker->pair_count);
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
        for (uint32_t row = 0; row < maker->coefficients.row_count; row++)
            rows[table][row] =
                limni_fixed_to_float(limni_coefficient(&maker->coefficients, table, row, slot));
        if (maker->kind == LIMNI_TABLE_PATCH) {
            fill_patch_column(maker, table, slot, rows[table], column);
        } else {
            fill_piece_column(maker, table, rows[table], column);
        }
    }
    const uint32_t step = LIMN_GRID_SIZE >> maker->depth;
    for (uint32_t edge = 0; edge < maker->domain->corner_count; edge++) {
        limni_edge_prints *const prints = &class->prints[column_index];
        const uint16_t *const along = maker->domain->edge_rows[edge];
        prints->along[edge] = print_edge(along, rows, class->table_count, step, true);
        prints->against[edge] = print_edge(along, rows, class->table_count, step, false);
    }
}

/// In a piece at a corner, the far end of the half edge that starts there is new, and so is the
/// middle of a quad.
static uint32_t new_corners_of(const class_maker *maker) {
    if (maker->kind != LIMNI_TABLE_CORNER) return 0;
    return maker->domain->kind == LIMN_DOMAIN_QUAD ? 1u << 1 | 1u << 2 : 1u << 1;
}

static limn_bake_status fill_rows(limni_context *context, const limni_rules *rules,
                                  const limni_local_base *base, const class_maker *maker) {
    const size_t table_size =
        (size_t)maker->coefficients.row_count * maker->coefficients.slot_count;
    const bool with_tangents = maker->coefficients.table_count == 3;
    const limni_rows rows = {.positions = maker->rows,
                             .tangents = with_tangents ? maker->rows + table_size : NULL,
                             .new_corners = new_corners_of(maker)};
    limni_neighbourhood neighbourhood;
    LIMNI_TRY(limni_local_neighbourhood(context, base, &neighbourhood));
    LIMNI_TRY(limni_subdivide(context, rules, &neighbourhood, maker->depth, LIMNI_PROJECT_TO_LIMIT,
                              &rows));
    limni_neighbourhood_end(context, &neighbourhood);
    return LIMN_BAKE_OK;
}

static uint32_t table_count_of(const limni_rules *rules) {
    return rules->normals == LIMN_NORMALS_EXACT ? 3 : 1;
}

static limn_bake_status begin_class(limni_context *context, const limni_rules *rules,
                                    const limni_local_base *base, limni_table_kind kind,
                                    class_maker *maker) {
    const limn_domain *const domain = limn_domain_get(base->mesh->domain);
    const uint32_t slot_count = base->control_count;
    const uint32_t table_count = table_count_of(rules);
    const int depth = kind == LIMNI_TABLE_PATCH ? LIMN_LEVEL_MAX : LIMN_LEVEL_MAX - 1;
    const uint32_t row_count = domain->row_counts[depth];
    const size_t table_size = (size_t)row_count * slot_count;
    limni_fixed *const rows = limni_allocate(context, table_count * table_size, sizeof *rows);
    *maker = (class_maker){.domain = domain,
                           .kind = kind,
                           .depth = depth,
                           .coefficients = {.rows = rows,
                                            .table_count = table_count,
                                            .row_count = row_count,
                                            .slot_count = slot_count},
                           .rows = rows,
                           .used = limni_allocate(context, slot_count, sizeof *maker->used),
                           .images = limni_allocate(context, slot_count, sizeof *maker->images)};
    if (!rows || !maker->used || !maker->images) return LIMN_BAKE_MEMORY;
    return fill_rows(context, rules, base, maker);
}

static void end_class(limni_context *context, class_maker *maker) {
    limni_release(context, maker->rows);
    limni_release(context, maker->used);
    limni_release(context, maker->images);
}

/// Computes the tables of a local base, and which slot has which column.
static limn_bake_status make_class(limni_context *context, const limni_rules *rules,
                                   const limni_local_base *base, limni_table_kind kind,
                                   uint16_t *columns, limni_class *class) {
    class_maker maker;
    LIMNI_TRY(begin_class(context, rules, base, kind, &maker));
    find_used(&maker.coefficients, maker.used);
    if (kind == LIMNI_TABLE_PATCH && maker.domain->kind == LIMN_DOMAIN_TRIANGLE)
        maker.pair_count = limni_find_mirror(&maker.coefficients, maker.used, maker.images);
    number_columns(&maker, columns);
    const uint32_t row_stride =
        kind == LIMNI_TABLE_PATCH
            ? limni_layout_get(maker.domain->kind, false, maker.pair_count)->row_stride
            : piece_layout_of(&maker, false)->row_stride;
    *class = (limni_class){.domain = maker.domain->kind,
                           .kind = kind,
                           .control_count = maker.control_count,
                           .pair_count = maker.pair_count,
                           .table_count = maker.coefficients.table_count,
                           .row_stride = row_stride,
                           .negative = find_negative(&maker.coefficients)};
    class->table = limni_allocate_zeroed(context, limni_class_table_size(class), 1);
    class->prints = limni_allocate(context, class->control_count, sizeof *class->prints);
    if (!class->table || !class->prints) return LIMN_BAKE_MEMORY;
    for (uint32_t corner = 0; corner < base->corner_count; corner++) {
        class->valences[corner] = base->corners[corner].count;
        class->boundary_corners |= (uint32_t)!base->corners[corner].closed << corner;
    }
    for (uint32_t slot = 0; slot < base->control_count; slot++) {
        if (columns[slot] != LIMNI_SLOT_UNUSED) fill_slot(&maker, slot, columns[slot], class);
    }
    end_class(context, &maker);
    return LIMN_BAKE_OK;
}

// ---- Keys

/// For one more of each.
static limn_bake_status make_room(limni_context *context, limni_classes *classes) {
    const bool full =
        classes->key_count == classes->capacity || classes->count == classes->capacity;
    return full ? grow(context, classes) : LIMN_BAKE_OK;
}

/// The key of a local base, with the words of that.
static limni_class_key key_of(const limni_rules *rules, const limni_local_base *base,
                              limni_table_kind kind) {
    return (limni_class_key){.scheme = rules->scheme,
                             .domain = base->mesh->domain,
                             .kind = kind,
                             .table_count = table_count_of(rules),
                             .words = base->key,
                             .size = base->key_size};
}

static limn_bake_status add_key(limni_context *context, limni_classes *classes,
                                const limni_rules *rules, const limni_local_base *base,
                                limni_table_kind kind) {
    limni_class_key *const key = &classes->keys[classes->key_count];
    *key = key_of(rules, base, kind);
    key->words = limni_allocate(context, base->key_size, sizeof *key->words);
    key->slots = limni_allocate(context, base->control_count, sizeof *key->slots);
    if (!key->words || !key->slots) return LIMN_BAKE_MEMORY;
    memcpy(key->words, base->key, base->key_size * sizeof *key->words);

    limni_class *const made = &classes->items[classes->count];
    LIMNI_TRY(make_class(context, rules, base, kind, key->slots, made));
    uint32_t *const place = find_class(classes, made);
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
                                    limni_table_kind kind, uint32_t *key_index) {
    const limni_class_key key = key_of(rules, base, kind);
    limni_class_key with_normals = key;
    with_normals.table_count = 3;
    LIMNI_TRY(make_room(context, classes));
    *key_index = *find_key(classes, &with_normals);
    if (*key_index != LIMNI_NONE) return LIMN_BAKE_OK;
    uint32_t *const place = find_key(classes, &key);
    if (*place == LIMNI_NONE) {
        LIMNI_TRY(add_key(context, classes, rules, base, kind));
        *place = classes->key_count - 1;
    }
    *key_index = *place;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_classes_find_parts(limni_context *context, limni_classes *classes,
                                          const limni_class *class, uint32_t *class_index) {
    LIMNI_TRY(make_room(context, classes));
    uint32_t *const place = find_class(classes, class);
    if (*place == LIMNI_NONE) {
        limni_class *const made = &classes->items[classes->count];
        const size_t size = limni_class_parts_size(class);
        *made = *class;
        made->parts = limni_allocate(context, size, 1);
        if (!made->parts) return LIMN_BAKE_MEMORY;
        memcpy(made->parts, class->parts, size);
        *place = classes->count++;
    }
    *class_index = *place;
    return LIMN_BAKE_OK;
}

limn_file_piece limni_piece_record(const limni_class *piece) {
    return (limn_file_piece){.control_count = piece->control_count,
                             .kind = (uint8_t)(piece->kind - LIMNI_TABLE_CORNER),
                             .domain = (uint8_t)piece->domain,
                             .table_count = (uint16_t)piece->table_count};
}

limn_file_class limni_class_record(const limni_class *class) {
    limn_file_class record = {
        .control_count = class->control_count,
        .domain = (uint16_t) class->domain,
        .depth = class->parts ? LIMN_FORMAT_PIECE_DEPTH : LIMN_FORMAT_DEPTH,
        .boundary_corners = class->boundary_corners,
        .table_count = (uint16_t) class->table_count,
        .pair_count = (uint16_t) class->pair_count,
        .negative = class->negative,
    };
    for (int corner = 0; corner < LIMN_CORNER_MAX; corner++)
        record.valences[corner] = (uint16_t) class->valences[corner];
    return record;
}
