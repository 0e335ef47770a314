/* SPDX-License-Identifier: MIT */
#include "model_vertices.h"

#include "hash.h"
#include "limn/limn.h"
#include "mesh.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

uint32_t limni_model_merge(limni_context *context, const void *records, size_t size, uint32_t count,
                           uint32_t *moved) {
    const unsigned char *const bytes = records;
    const uint32_t table_size = limni_hash_size(count);
    uint32_t *const table = limni_allocate(context, table_size, sizeof *table);
    uint32_t kept = 0;
    if (!table) return UINT32_MAX;
    memset(table, 0xff, table_size * sizeof *table);
    for (uint32_t r = 0; r < count; r++) {
        uint64_t hash = size;
        for (size_t w = 0; w < size; w += sizeof(uint32_t)) {
            uint32_t word;
            memcpy(&word, bytes + r * size + w, sizeof word);
            hash = limni_hash_mix(hash, word);
        }
        uint32_t at = (uint32_t)hash & (table_size - 1);
        while (table[at] != LIMNI_NONE &&
               memcmp(bytes + table[at] * size, bytes + r * size, size) != 0)
            at = (at + 1) & (table_size - 1);
        if (table[at] == LIMNI_NONE) {
            table[at] = r;
            moved[r] = kept++;
        } else {
            moved[r] = moved[table[at]];
        }
    }
    limni_release(context, table);
    return kept;
}

// ---- What there is

/// All by vertex, before equal ones are made one.
typedef struct data {
    limni_model_vertices *vertices;
    float (*positions)[3];
    uint16_t *joints; ///< [count][LIMN_INFLUENCE_MAX]; NULL: no skin
    float *weights;
    float (*deltas)[3]; ///< [count][target_count]
    uint32_t target_count;
} data;

static limn_bake_status read_positions(data *d) {
    const limni_model_vertices *const v = d->vertices;
    d->positions = limni_allocate(v->reader->context, v->count, sizeof *d->positions);
    if (!d->positions) return LIMN_BAKE_MEMORY;
    for (uint32_t p = 0; p < v->mesh->part_count; p++) {
        const limni_model_part *const part = &v->mesh->parts[p];
        for (uint32_t i = 0; i < part->vertex_count; i++) {
            for (int axis = 0; axis < 3; axis++) // -0 and 0 are one place
                d->positions[part->first + i][axis] = part->positions[i][axis] + 0.0f;
        }
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_skin(data *d) {
    const limni_model_vertices *const v = d->vertices;
    const size_t count = (size_t)LIMN_INFLUENCE_MAX * v->count;
    const uint32_t whole = v->reader->whole_joints[v->node_index];
    if (v->node->skin < 0 && whole == LIMN_FORMAT_NONE) return LIMN_BAKE_OK;
    d->joints = limni_allocate_zeroed(v->reader->context, count, sizeof *d->joints);
    d->weights = limni_allocate_zeroed(v->reader->context, count, sizeof *d->weights);
    if (!d->joints || !d->weights) return LIMN_BAKE_MEMORY;
    if (v->node->skin >= 0) return limni_model_read_influences(v, d->joints, d->weights);
    for (size_t i = 0; i < count; i++) {
        d->joints[i] = (uint16_t)whole;
        d->weights[i] = i % LIMN_INFLUENCE_MAX == 0;
    }
    return LIMN_BAKE_OK;
}

// ---- Morph targets

static void read_target(const data *d, const limni_model_part *part, uint32_t target) {
    for (uint32_t i = 0; part->targets[target] && i < part->vertex_count; i++) {
        for (int axis = 0; axis < 3; axis++)
            d->deltas[(size_t)(part->first + i) * d->target_count + target][axis] =
                part->targets[target][i][axis] + 0.0f;
    }
}

static limn_bake_status read_targets(data *d) {
    const limni_model_vertices *const v = d->vertices;
    const limni_model_part *const parts = v->mesh->parts;
    d->target_count = parts[0].target_count;
    for (uint32_t p = 1; p < v->mesh->part_count; p++) {
        if (parts[p].target_count != d->target_count)
            return limni_fail(v->reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s has %u morph targets, but %s has %u", v->reader->model->path,
                              parts[p].label, parts[p].target_count, parts[0].label,
                              d->target_count);
    }
    if (d->target_count == 0) return LIMN_BAKE_OK;
    if (d->target_count > UINT16_MAX)
        return limni_fail(v->reader->context, LIMN_BAKE_BAD_INPUT,
                          "%s: %s: more than %u morph targets", v->reader->model->path, v->label,
                          UINT16_MAX);
    d->deltas = limni_allocate_zeroed(v->reader->context, (size_t)v->count * d->target_count,
                                      sizeof *d->deltas);
    if (!d->deltas) return LIMN_BAKE_MEMORY;
    for (uint32_t p = 0; p < v->mesh->part_count; p++) {
        for (uint32_t t = 0; t < d->target_count; t++)
            read_target(d, &parts[p], t);
    }
    return LIMN_BAKE_OK;
}

/// Names, and the weights at rest: those of the node, or else of the mesh.
static limn_bake_status describe_targets(const data *d, limni_rig *rig) {
    const limni_model_vertices *const v = d->vertices;
    limni_context *const context = v->reader->context;
    const bool own = v->node->weight_count > 0;
    const double *const weights = own ? v->node->weights : v->mesh->weights;
    const uint32_t weight_count = own ? v->node->weight_count : v->mesh->weight_count;
    rig->target_count = d->target_count;
    rig->targets = limni_allocate(context, d->target_count, sizeof *rig->targets);
    if (!rig->targets) return LIMN_BAKE_MEMORY;
    if (weight_count != 0 && weight_count != d->target_count)
        limni_note(context, "%s: %s: %u weights at rest for %u morph targets",
                   v->reader->model->path, v->label, weight_count, d->target_count);
    if (v->mesh->target_name_count != 0 && v->mesh->target_name_count != d->target_count)
        limni_note(context, "%s: %s: %u names for %u morph targets", v->reader->model->path,
                   v->label, v->mesh->target_name_count, d->target_count);
    for (uint32_t t = 0; t < d->target_count; t++) {
        char numbered[32];
        snprintf(numbered, sizeof numbered, "target %u", t);
        const bool named = t < v->mesh->target_name_count && v->mesh->target_names[t][0];
        const double weight = t < weight_count ? weights[t] : 0;
        if (!(fabs(weight) <= (double)FLT_MAX))
            return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: the weight of morph target %u is not finite",
                              v->reader->model->path, v->label, t);
        rig->targets[t] = (limn_file_target){.weight = (float)weight};
        LIMNI_TRY(limni_character_add_text(context, v->reader->scene->character,
                                           named ? v->mesh->target_names[t] : numbered,
                                           &rig->targets[t].name));
    }
    return LIMN_BAKE_OK;
}

// ---- Positions

/// Lays what makes a position side by side.
static unsigned char *make_records(const data *d, size_t *size) {
    const limni_model_vertices *const v = d->vertices;
    const size_t joints_size = d->joints ? LIMN_INFLUENCE_MAX * sizeof *d->joints : 0;
    const size_t weights_size = d->joints ? LIMN_INFLUENCE_MAX * sizeof *d->weights : 0;
    const size_t deltas_size = d->target_count * sizeof *d->deltas;
    *size = sizeof *d->positions + joints_size + weights_size + deltas_size;
    unsigned char *const records = limni_allocate(v->reader->context, v->count, *size);
    if (!records) return NULL;
    for (uint32_t i = 0; i < v->count; i++) {
        unsigned char *at = records + i * *size;
        memcpy(at, d->positions[i], sizeof *d->positions);
        at += sizeof *d->positions;
        if (d->joints) {
            memcpy(at, d->joints + (size_t)LIMN_INFLUENCE_MAX * i, joints_size);
            memcpy(at + joints_size, d->weights + (size_t)LIMN_INFLUENCE_MAX * i, weights_size);
        }
        at += joints_size + weights_size;
        if (deltas_size) memcpy(at, d->deltas[(size_t)i * d->target_count], deltas_size);
    }
    return records;
}

static uint32_t count_influences(const data *d) {
    uint32_t count = 1;
    for (uint32_t i = 0; i < d->vertices->count; i++) {
        const float *const weights = d->weights + (size_t)LIMN_INFLUENCE_MAX * i;
        while (count < LIMN_INFLUENCE_MAX && weights[count] > 0)
            count++;
    }
    return count;
}

static limn_bake_status make_source(const data *d, limni_source *source) {
    limni_context *const context = d->vertices->reader->context;
    limni_rig *const rig = &source->rig;
    const uint32_t count = source->position_count;
    rig->influence_count = d->joints ? count_influences(d) : 0;
    const size_t influences = (size_t)count * rig->influence_count;
    source->positions = limni_allocate(context, count, sizeof *source->positions);
    source->position_numbers = limni_allocate(context, count, sizeof *source->position_numbers);
    rig->joints = limni_allocate(context, influences, sizeof *rig->joints);
    rig->weights = limni_allocate(context, influences, sizeof *rig->weights);
    rig->deltas = limni_allocate(context, (size_t)count * d->target_count, sizeof *rig->deltas);
    if (!source->positions || !source->position_numbers || !rig->joints || !rig->weights ||
        !rig->deltas)
        return LIMN_BAKE_MEMORY;
    for (uint32_t i = d->vertices->count; i-- > 0;) { // the first of several is the last to write
        const size_t p = d->vertices->moved[i];
        memcpy(source->positions[p], d->positions[i], sizeof *source->positions);
        source->position_numbers[p] = i;
        for (uint32_t k = 0; k < rig->influence_count; k++) {
            const size_t from = (size_t)LIMN_INFLUENCE_MAX * i + k;
            rig->joints[p * rig->influence_count + k] = d->joints[from];
            rig->weights[p * rig->influence_count + k] = d->weights[from];
        }
        for (uint32_t t = 0; t < d->target_count; t++)
            memcpy(rig->deltas[p * d->target_count + t], d->deltas[(size_t)i * d->target_count + t],
                   sizeof *rig->deltas);
    }
    return describe_targets(d, rig);
}

/// Says how many positions are apart only because they move differently.
static limn_bake_status note_apart(const data *d, const limni_source *source) {
    limni_context *const context = d->vertices->reader->context;
    uint32_t *const moved = limni_allocate(context, source->position_count, sizeof *moved);
    if (!moved) return LIMN_BAKE_MEMORY;
    const uint32_t places = limni_model_merge(context, source->positions, sizeof *source->positions,
                                              source->position_count, moved);
    if (places == UINT32_MAX) return LIMN_BAKE_MEMORY;
    if (places < source->position_count)
        limni_note(context,
                   "%s: %u positions have the place of another and are kept apart, as joints or "
                   "morph targets move them differently",
                   source->path, source->position_count - places);
    limni_release(context, moved);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_model_read_vertices(limni_model_vertices *vertices, limni_source *source) {
    limni_context *const context = vertices->reader->context;
    data d = {.vertices = vertices};
    size_t size;
    LIMNI_TRY(read_positions(&d));
    LIMNI_TRY(read_skin(&d));
    LIMNI_TRY(read_targets(&d));
    vertices->moved = limni_allocate(context, vertices->count, sizeof *vertices->moved);
    unsigned char *const records = make_records(&d, &size);
    if (!vertices->moved || !records) return LIMN_BAKE_MEMORY;
    source->position_count =
        limni_model_merge(context, records, size, vertices->count, vertices->moved);
    if (source->position_count == UINT32_MAX) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(make_source(&d, source));
    limni_release(context, records);
    limni_release(context, d.positions);
    limni_release(context, d.joints);
    limni_release(context, d.weights);
    limni_release(context, d.deltas);
    return note_apart(&d, source);
}
