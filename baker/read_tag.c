/* SPDX-License-Identifier: MIT */
#include "read_tag.h"

/// A tag whose values are being read.
typedef struct obj_tag {
    limni_scanner *scanner;
    limni_source_builder *builder;
    limni_token name;
    uint32_t line;
    uint32_t whole_count, number_count, word_count;
} obj_tag;

static limn_bake_status fail_counts(const obj_tag *tag, const char *expected) {
    return limni_scanner_fail(tag->scanner, tag->line, "tag '%.*s' has %u/%u/%u values; %s",
                              limni_token_shown(tag->name), tag->name.text, tag->whole_count,
                              tag->number_count, tag->word_count, expected);
}

static limn_bake_status next_value(const obj_tag *tag, limni_token *value) {
    *value = limni_scanner_next_token(tag->scanner);
    return value->size > 0 ? LIMN_BAKE_OK : fail_counts(tag, "the line ends before them");
}

static limn_bake_status next_whole(const obj_tag *tag, const char *noun, uint32_t *value) {
    limni_token token;
    LIMNI_TRY(next_value(tag, &token));
    return limni_scanner_whole(tag->scanner, token, noun, value);
}

static limn_bake_status next_sharpness(const obj_tag *tag, float *value) {
    limni_token token;
    LIMNI_TRY(next_value(tag, &token));
    return limni_scanner_sharpness(tag->scanner, token, value);
}

/// The counts, as in 2/1/0.
static limn_bake_status read_counts(obj_tag *tag) {
    const limni_token token = limni_scanner_next_token(tag->scanner);
    uint32_t *const counts[] = {&tag->whole_count, &tag->number_count, &tag->word_count};
    const char *c = token.text;
    bool valid = token.size > 0;
    for (int k = 0; k < 3 && valid; k++) {
        uint64_t count = 0;
        valid = limni_parse_digits(&c, &count) && count <= UINT32_MAX;
        *counts[k] = (uint32_t)count;
        if (k < 2) valid = valid && *c++ == '/';
    }
    if (valid && c == token.text + token.size) return LIMN_BAKE_OK;
    return limni_scanner_fail(tag->scanner, tag->line,
                              "'%.*s' does not count the values of a tag; INTS/FLOATS/STRINGS is "
                              "expected",
                              limni_token_shown(token), token.text);
}

// ---- One tag each

/// Pairs of vertices, and a sharpness for all or for each.
static limn_bake_status read_crease(const obj_tag *tag) {
    const uint32_t count = tag->whole_count / 2;
    if (count == 0 || tag->whole_count % 2 || tag->word_count ||
        (tag->number_count != 1 && tag->number_count != count))
        return fail_counts(tag, "pairs of vertices and one sharpness, or one for each, are "
                                "expected");
    limni_tags *const tags = &tag->builder->source->tags;
    const uint32_t first = tags->crease_count;
    for (uint32_t k = 0; k < count; k++) {
        limni_crease crease = {.line = tag->line};
        LIMNI_TRY(next_whole(tag, "vertex of a crease", &crease.a));
        LIMNI_TRY(next_whole(tag, "vertex of a crease", &crease.b));
        LIMNI_TRY(limni_builder_add_crease(tag->builder, crease));
    }
    float sharpness = 0;
    for (uint32_t k = 0; k < count; k++) {
        if (k < tag->number_count) LIMNI_TRY(next_sharpness(tag, &sharpness));
        tags->creases[first + k].sharpness = sharpness;
    }
    return LIMN_BAKE_OK;
}

/// Vertices, and a sharpness for all or for each.
static limn_bake_status read_corner(const obj_tag *tag) {
    const uint32_t count = tag->whole_count;
    if (count == 0 || tag->word_count || (tag->number_count != 1 && tag->number_count != count))
        return fail_counts(tag, "vertices and one sharpness, or one for each, are expected");
    limni_tags *const tags = &tag->builder->source->tags;
    const uint32_t first = tags->sharp_vertex_count;
    for (uint32_t k = 0; k < count; k++) {
        limni_sharp_vertex vertex = {.line = tag->line};
        LIMNI_TRY(next_whole(tag, "corner", &vertex.position));
        LIMNI_TRY(limni_builder_add_sharp_vertex(tag->builder, vertex));
    }
    float sharpness = 0;
    for (uint32_t k = 0; k < count; k++) {
        if (k < tag->number_count) LIMNI_TRY(next_sharpness(tag, &sharpness));
        tags->sharp_vertices[first + k].sharpness = sharpness;
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_hole(const obj_tag *tag) {
    if (tag->whole_count == 0 || tag->number_count || tag->word_count)
        return fail_counts(tag, "faces are expected");
    for (uint32_t k = 0; k < tag->whole_count; k++) {
        limni_hole hole = {.line = tag->line};
        LIMNI_TRY(next_whole(tag, "hole", &hole.face));
        LIMNI_TRY(limni_builder_add_hole(tag->builder, hole));
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_boundary(const obj_tag *tag) {
    static const limn_boundary boundaries[] = {LIMN_BOUNDARY_NONE, LIMN_BOUNDARY_EDGE_AND_CORNER,
                                               LIMN_BOUNDARY_EDGE_ONLY};
    uint32_t number = 0;
    if (tag->whole_count != 1 || tag->number_count || tag->word_count)
        return fail_counts(tag, "one whole number is expected");
    LIMNI_TRY(next_whole(tag, "boundary interpolation", &number));
    if (number > 2)
        return limni_scanner_fail(tag->scanner, tag->line,
                                  "boundary interpolation %u is unknown; 0, 1 or 2 is expected",
                                  number);
    tag->builder->source->tags.boundary = boundaries[number];
    return LIMN_BAKE_OK;
}

static limn_bake_status read_creasing(const obj_tag *tag) {
    limni_token word;
    if (tag->whole_count || tag->number_count || tag->word_count != 1)
        return fail_counts(tag, "one word is expected");
    LIMNI_TRY(next_value(tag, &word));
    const bool chaikin = limni_token_is(word, "chaikin");
    if (!chaikin && !limni_token_is(word, "normal"))
        return limni_scanner_fail(tag->scanner, tag->line,
                                  "crease method '%.*s' is unknown; normal or chaikin is expected",
                                  limni_token_shown(word), word.text);
    tag->builder->source->tags.creasing = chaikin ? LIMN_CREASING_CHAIKIN : LIMN_CREASING_UNIFORM;
    return LIMN_BAKE_OK;
}

/// Of texture coordinates, which are not read, and of Catmull and Clark's scheme: nothing here
/// depends on them.
static bool is_irrelevant(limni_token name) {
    static const char *const names[] = {"facevaryinginterpolateboundary",
                                        "facevaryingpropagatecorners", "smoothtriangles"};
    for (int n = 0; n < 3; n++) {
        if (limni_token_is(name, names[n])) return true;
    }
    return false;
}

static limn_bake_status skip_values(const obj_tag *tag, limni_word_list *noted) {
    limni_scanner_skip_line(tag->scanner);
    if (!is_irrelevant(tag->name) && limni_word_list_add(noted, tag->name))
        limni_note(tag->scanner->context, "%s:%u: unknown tag '%.*s' is ignored",
                   tag->scanner->path, tag->line, limni_token_shown(tag->name), tag->name.text);
    return LIMN_BAKE_OK;
}

// ---- Any tag

typedef limn_bake_status read_values_fn(const obj_tag *tag);

static read_values_fn *find_values(limni_token name) {
    static const struct {
        const char *name;
        read_values_fn *read;
    } known[] = {{"crease", read_crease},
                 {"corner", read_corner},
                 {"hole", read_hole},
                 {"interpolateboundary", read_boundary},
                 {"creasemethod", read_creasing}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        if (limni_token_is(name, known[k].name)) return known[k].read;
    }
    return NULL;
}

limn_bake_status limni_read_tag(limni_scanner *scanner, limni_source_builder *builder,
                                limni_word_list *noted) {
    obj_tag tag = {.scanner = scanner, .builder = builder, .line = scanner->line};
    tag.name = limni_scanner_next_token(scanner);
    if (tag.name.size == 0) return limni_scanner_fail(scanner, tag.line, "tag without a name");
    read_values_fn *const read = find_values(tag.name);
    if (!read) return skip_values(&tag, noted);
    LIMNI_TRY(read_counts(&tag));
    LIMNI_TRY(read(&tag));
    const limni_token extra = limni_scanner_next_token(scanner);
    if (extra.size == 0) return LIMN_BAKE_OK;
    return limni_scanner_fail(scanner, tag.line, "'%.*s' after the values of tag '%.*s'",
                              limni_token_shown(extra), extra.text, limni_token_shown(tag.name),
                              tag.name.text);
}
