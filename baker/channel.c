/* SPDX-License-Identifier: MIT */
#include "channel.h"

#include "topology.h"

#include <string.h>

/// The faces around a vertex that are continuous in a channel.
typedef struct span {
    uint32_t control;     ///< of the channel
    uint32_t value;       ///< of the source
    uint32_t first, size; ///< half-edge, and faces
    bool closed;
    bool disjoint;             ///< others have the same value, or an edge inside stays sharp
    uint32_t semi_sharp_count; ///< edges inside
} span;

typedef struct builder {
    limni_context *context;
    const limni_source_channel *source;
    const limni_mesh *drawn;
    const limni_mesh_sharpness *drawn_sharpness;
    limn_face_varying mode;
    limni_channel *channel;
    limni_mesh_sharpness sharpness;
    unsigned char *seen; ///< [half_edge_count]
    span *spans;         ///< [highest valence] of one vertex
    uint32_t span_count;
} builder;

static limni_sharpness edge_sharpness(const builder *b, uint32_t h) {
    return b->drawn_sharpness->edges ? b->drawn_sharpness->edges[h] : 0;
}

// ---- Faces

static uint32_t value_at(const builder *b, uint32_t h) {
    return b->source->corner_values[b->drawn->source_corners[h]];
}

/// Whether two faces have the same values at both ends of their edge.
static bool is_continuous(const builder *b, uint32_t h, uint32_t pair) {
    return value_at(b, h) == value_at(b, limni_half_edge_next(b->drawn, pair)) &&
           value_at(b, pair) == value_at(b, limni_half_edge_next(b->drawn, h));
}

static limn_bake_status begin_mesh(const builder *b) {
    limni_context *const context = b->context;
    const uint32_t count = b->drawn->half_edge_count;
    limni_mesh *const mesh = &b->channel->mesh;
    *mesh = *b->drawn;
    mesh->control_numbers = mesh->control_lines = NULL;
    mesh->control_count = 0;
    mesh->origins = NULL;
    mesh->edge_sharpness = mesh->vertex_sharpness = NULL;
    mesh->corners = limni_allocate(context, count, sizeof *mesh->corners);
    mesh->pairs = limni_allocate(context, count, sizeof *mesh->pairs);
    mesh->first = limni_allocate(context, count, sizeof *mesh->first);
    mesh->valences = limni_allocate(context, count, sizeof *mesh->valences);
    mesh->controls = limni_allocate(context, count, sizeof *mesh->controls);
    if (!mesh->corners || !mesh->pairs || !mesh->first || !mesh->valences || !mesh->controls)
        return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < count; h++) {
        const uint32_t pair = b->drawn->pairs[h];
        mesh->pairs[h] = pair != LIMNI_NONE && is_continuous(b, h, pair) ? pair : LIMNI_NONE;
    }
    return LIMN_BAKE_OK;
}

/// Makes a control point of a fan.
static void add_fan(builder *b, const limni_fan *fan) {
    limni_mesh *const mesh = &b->channel->mesh;
    const uint32_t control = mesh->control_count++;
    span made = {.control = control,
                 .value = value_at(b, fan->first),
                 .first = fan->first,
                 .closed = fan->closed};
    uint32_t h = fan->first;
    do {
        const limni_sharpness sharpness = edge_sharpness(b, h);
        mesh->corners[h] = control;
        made.size++;
        if (mesh->pairs[h] != LIMNI_NONE) {
            made.disjoint |= sharpness == LIMNI_SHARPNESS_INFINITE;
            made.semi_sharp_count += limni_is_semi_sharp(sharpness);
        }
        h = limni_half_edge_turn(mesh, h);
    } while (h != LIMNI_NONE && h != fan->first);
    mesh->first[control] = fan->first;
    mesh->valences[control] = fan->valence;
    memcpy(mesh->controls[control], b->source->values[made.value], sizeof *mesh->controls);
    b->spans[b->span_count++] = made;
}

/// The fans around a vertex of the mesh that is drawn.
static void find_spans(builder *b, uint32_t vertex) {
    const uint32_t first = b->drawn->first[vertex];
    uint32_t h = first;
    b->span_count = 0;
    if (first == LIMNI_NONE) return;
    do {
        if (!b->seen[h]) {
            const limni_fan fan = limni_walk_fan(&b->channel->mesh, h, b->seen);
            add_fan(b, &fan);
        }
        h = limni_half_edge_turn(b->drawn, h);
    } while (h != LIMNI_NONE && h != first);
}

// ---- What is sharp

/// Marks those that share a value as disjoint. Returns how many values there are.
static uint32_t count_values(builder *b) {
    uint32_t count = b->span_count;
    for (uint32_t s = 0; s < b->span_count; s++) {
        bool known = false;
        for (uint32_t other = 0; other < s; other++) {
            if (b->spans[other].value != b->spans[s].value) continue;
            b->spans[other].disjoint = b->spans[s].disjoint = known = true;
        }
        count -= known;
    }
    return count;
}

/// The ends of the edges of one sheet that others may share, 0 and 1: vertices before the mesh was
/// split, and values.
typedef struct sheet_end {
    uint32_t origin, value;
} sheet_end;

static sheet_end end_of_sheet(const builder *b, uint32_t sheet, int which) {
    const limni_mesh *const drawn = b->drawn;
    uint32_t last = drawn->first[sheet];
    for (uint32_t h = last; h != LIMNI_NONE && which == 1;) {
        last = h;
        h = limni_half_edge_turn(drawn, h);
        if (h == drawn->first[sheet]) break;
    }
    const uint32_t far =
        which == 0 ? limni_half_edge_next(drawn, last) : limni_half_edge_previous(drawn, last);
    return (sheet_end){limni_origin(drawn, drawn->corners[far]), value_at(b, far)};
}

/// Whether two sheets of a vertex have different values, there or at the end of an edge they share.
static bool do_sheets_differ(const builder *b, uint32_t sheet, uint32_t other) {
    bool differ = value_at(b, b->drawn->first[sheet]) != value_at(b, b->drawn->first[other]);
    for (int e = 0; e < 4; e++) {
        const sheet_end own = end_of_sheet(b, sheet, e & 1);
        const sheet_end its = end_of_sheet(b, other, e >> 1);
        differ |= own.origin == its.origin && own.value != its.value;
    }
    return differ;
}

/// Whether a vertex that was split is on a seam that follows where its sheets meet.
static bool is_between_sheets(const builder *b, uint32_t vertex) {
    const uint32_t *const origins = b->drawn->origins;
    uint32_t begin = vertex;
    bool differ = false;
    if (!limni_is_split(b->drawn, vertex)) return false;
    while (begin > 0 && origins[begin - 1] == origins[vertex])
        begin--;
    for (uint32_t other = begin + 1;
         other < b->drawn->control_count && origins[other] == origins[vertex]; other++) {
        for (uint32_t sheet = begin; sheet < other && !differ; sheet++)
            differ = do_sheets_differ(b, sheet, other);
    }
    return differ;
}

/// Whether all values of a vertex on a seam are corners.
static bool are_all_corners(const builder *b, uint32_t vertex, uint32_t value_count) {
    const bool plus_two = b->mode == LIMN_FACE_VARYING_CORNERS_PLUS2;
    if (b->mode == LIMN_FACE_VARYING_BOUNDARIES || limni_is_split(b->drawn, vertex)) return true;
    if (plus_two && value_count == 1 && !limni_is_boundary(b->drawn, vertex)) return true;
    if (b->mode != LIMN_FACE_VARYING_CORNERS_PLUS1 && !plus_two) return false;
    if (value_count != 2) return value_count > 2;
    bool all = false;
    for (uint32_t s = 0; s < b->span_count; s++)
        all |= b->spans[s].disjoint || (plus_two && b->spans[s].size == 1);
    return all;
}

/// For how many levels something stays sharp.
static uint32_t levels_of(limni_sharpness s) {
    return (s + LIMNI_SHARPNESS_LEVEL - 1) >> LIMNI_SHARPNESS_BITS;
}

/// The same for the semi-sharp edge at a vertex that does so longest, on seams, too.
static uint32_t longest_levels(const builder *b, uint32_t vertex) {
    const uint32_t first = b->drawn->first[vertex];
    uint32_t longest = 0, h = first;
    do {
        const limni_sharpness s = edge_sharpness(b, h);
        if (limni_is_semi_sharp(s) && levels_of(s) > longest) longest = levels_of(s);
        h = limni_half_edge_turn(b->drawn, h);
    } while (h != LIMNI_NONE && h != first);
    return longest;
}

/// The sharpness of a vertex that decays as the edges inside of a span do: that of those which last
/// longest, on average.
static limni_sharpness sharpness_of_span(const builder *b, const span *of) {
    const limni_mesh *const mesh = &b->channel->mesh;
    uint32_t levels = 0, count = 0;
    limni_wide sum = 0;
    for (uint32_t h = of->first;;) {
        h = limni_half_edge_turn(mesh, h);
        if (h == LIMNI_NONE || h == of->first) break;
        const limni_sharpness s = edge_sharpness(b, h);
        if (levels_of(s) < levels || s == 0) continue;
        if (levels_of(s) > levels) sum = count = 0;
        levels = levels_of(s);
        sum += s;
        count++;
    }
    return count ? (limni_sharpness)limni_wide_divide(sum, count) : 0;
}

/// Where there are two values, and edges that are semi-sharp beside one of them, these keep the
/// other at its place, too: for whole levels, as OpenSubdiv has it, while another edge of the vertex
/// is semi-sharp.
static void sharpen_dependent(const builder *b, uint32_t vertex) {
    const span *const spans = b->spans;
    if (b->mode != LIMN_FACE_VARYING_CORNERS_PLUS1 && b->mode != LIMN_FACE_VARYING_CORNERS_PLUS2)
        return;
    if (b->span_count != 2) return;
    for (int s = 0; s < 2; s++) {
        limni_sharpness *const own = &b->sharpness.vertices[spans[s].control];
        if (*own != 0 || spans[s].semi_sharp_count != 0) continue;
        *own = sharpness_of_span(b, &spans[1 - s]);
        if (levels_of(*own) < longest_levels(b, vertex))
            *own = levels_of(*own) * LIMNI_SHARPNESS_LEVEL;
    }
}

/// On a boundary of the mesh that is no seam, only the corners of the boundary change.
static bool is_boundary_corner(const builder *b, uint32_t vertex, const span *only) {
    if (only->closed) return false;
    if (b->mode == LIMN_FACE_VARYING_BOUNDARIES) return true;
    return only->size == 1 && b->mode != LIMN_FACE_VARYING_NONE &&
           !limni_is_split(b->drawn, vertex);
}

static void sharpen_vertex(builder *b, uint32_t vertex) {
    const bool boundary = limni_is_boundary(b->drawn, vertex);
    const bool seam =
        b->span_count > 1 || b->spans[0].closed == boundary || is_between_sheets(b, vertex);
    const uint32_t value_count = count_values(b);
    const bool all = seam && are_all_corners(b, vertex, value_count);
    for (uint32_t s = 0; s < b->span_count; s++) {
        const span *const own = &b->spans[s];
        const bool corner =
            seam ? all || own->disjoint || (own->size == 1 && b->mode != LIMN_FACE_VARYING_NONE)
                 : is_boundary_corner(b, vertex, own);
        b->sharpness.vertices[own->control] =
            corner ? LIMNI_SHARPNESS_INFINITE : b->drawn_sharpness->vertices[vertex];
    }
    if (seam && !all) sharpen_dependent(b, vertex);
}

/// Edges keep the sharpness that they have in the mesh; seams are boundaries.
static limn_bake_status sharpen_edges(builder *b) {
    const limni_rules *const rules = &b->channel->rules;
    const limni_mesh *const mesh = &b->channel->mesh;
    if (!b->drawn_sharpness->edges && rules->creases != LIMN_CREASES_LOMONT) return LIMN_BAKE_OK;
    limni_sharpness *const edges = limni_allocate(b->context, mesh->half_edge_count, sizeof *edges);
    if (!edges) return LIMN_BAKE_MEMORY;
    for (uint32_t h = 0; h < mesh->half_edge_count; h++)
        edges[h] = mesh->pairs[h] == LIMNI_NONE ? LIMNI_SHARPNESS_INFINITE : edge_sharpness(b, h);
    b->sharpness.edges = edges;
    return limni_mesh_sharpness_see(b->context, mesh, rules, &b->sharpness);
}

static uint32_t highest_valence(const limni_mesh *mesh) {
    uint32_t highest = 1;
    for (uint32_t c = 0; c < mesh->control_count; c++)
        highest = mesh->valences[c] > highest ? mesh->valences[c] : highest;
    return highest;
}

/// The butterfly has no creases, and where there is no scheme all is sharp.
static bool may_be_sharp(const builder *b) {
    const limn_scheme scheme = b->channel->rules.scheme;
    return scheme != LIMN_SCHEME_BUTTERFLY && scheme != LIMN_SCHEME_NONE;
}

static limn_bake_status build(builder *b) {
    limni_context *const context = b->context;
    const limni_mesh *const drawn = b->drawn;
    b->seen = limni_allocate_zeroed(context, drawn->half_edge_count, 1);
    b->spans = limni_allocate(context, highest_valence(drawn), sizeof *b->spans);
    b->sharpness.vertices =
        limni_allocate_zeroed(context, drawn->half_edge_count, sizeof *b->sharpness.vertices);
    if (!b->seen || !b->spans || !b->sharpness.vertices) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(begin_mesh(b));
    for (uint32_t vertex = 0; vertex < drawn->control_count; vertex++) {
        find_spans(b, vertex);
        if (b->span_count > 0 && may_be_sharp(b)) sharpen_vertex(b, vertex);
    }
    limni_release(context, b->seen);
    limni_release(context, b->spans);
    return may_be_sharp(b) ? sharpen_edges(b) : LIMN_BAKE_OK;
}

// ---- Rules

/// What a channel does where nothing else was asked for: what the butterfly makes of texture
/// coordinates is stretched (Sharp), so that they are linear with it.
static limn_face_varying mode_of(const limni_rules *rules, limn_channel_kind kind) {
    if (rules->scheme == LIMN_SCHEME_NONE) return LIMN_FACE_VARYING_ALL;
    if (rules->face_varying != LIMN_FACE_VARYING_DEFAULT) return rules->face_varying;
    return rules->scheme == LIMN_SCHEME_BUTTERFLY && kind == LIMN_CHANNEL_UV
               ? LIMN_FACE_VARYING_ALL
               : LIMN_FACE_VARYING_CORNERS_ONLY;
}

static limni_rules rules_of(const limni_rules *drawn, limn_face_varying mode) {
    limni_rules rules = *drawn;
    rules.normals = LIMN_NORMALS_NONE;
    rules.face_varying = mode;
    if (mode != LIMN_FACE_VARYING_ALL) return rules;
    rules.scheme = LIMN_SCHEME_NONE;
    rules.isolate = LIMN_ISOLATE_NEVER; // there is but one table
    rules.creases = LIMN_CREASES_OPENSUBDIV;
    rules.creasing = LIMN_CREASING_UNIFORM;
    return rules;
}

/// Everything is sharp.
static limn_bake_status flatten(builder *b) {
    limni_mesh_sharpness_end(b->context, &b->sharpness);
    return limni_mesh_sharpness_begin(b->context, &b->channel->mesh, &b->channel->rules,
                                      &b->sharpness);
}

static limn_bake_status begin_channel(limni_context *context, const limni_source_channel *source,
                                      const limni_base *drawn, const limni_rules *rules,
                                      limni_channel *channel) {
    const limn_face_varying mode = mode_of(rules, source->kind);
    *channel = (limni_channel){.name = source->name,
                               .record = {.kind = source->kind,
                                          .component_count = source->component_count,
                                          .face_varying = mode},
                               .rules = rules_of(rules, mode)};
    builder b = {.context = context,
                 .source = source,
                 .drawn = drawn->source,
                 .drawn_sharpness = &drawn->source_sharpness,
                 .mode = mode,
                 .channel = channel};
    LIMNI_TRY(build(&b));
    if (channel->rules.scheme == LIMN_SCHEME_NONE) LIMNI_TRY(flatten(&b));
    return limni_base_follow(context, drawn, &channel->mesh, &b.sharpness, &channel->rules,
                             &channel->base);
}

limn_bake_status limni_channels_begin(limni_context *context, const limni_source *source,
                                      const limni_base *drawn, const limni_rules *rules,
                                      limni_channel **channels) {
    *channels = limni_allocate(context, source->channel_count, sizeof **channels);
    if (!*channels) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < source->channel_count; c++)
        LIMNI_TRY(begin_channel(context, &source->channels[c], drawn, rules, &(*channels)[c]));
    return LIMN_BAKE_OK;
}

void limni_channels_end(limni_context *context, limni_channel *channels, uint32_t count) {
    for (uint32_t c = 0; c < count; c++) {
        limni_base_end(context, &channels[c].base);
        limni_release(context, channels[c].mesh.corners);
        limni_release(context, channels[c].mesh.pairs);
        limni_release(context, channels[c].mesh.first);
        limni_release(context, channels[c].mesh.valences);
    }
    limni_release(context, channels);
}
