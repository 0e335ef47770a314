/* SPDX-License-Identifier: MIT */
#include "read_lomont.h"

#include "hash.h"
#include "mesh.h"
#include "read_tag.h"

#include <string.h>

/// One entry hd: the pair as the file has it, from 1, or 0 on a boundary.
typedef struct half_edge {
    uint32_t pair;
    float sharpness;
    uint32_t line;
} half_edge;

/// Counts stated by si.
typedef struct sizes {
    uint32_t vertices, faces, edges, normals;
    uint32_t line; ///< 0: not stated
} sizes;

typedef struct lomont_reader {
    limni_scanner scanner;
    limni_source_builder builder;
    sizes stated;
    half_edge *half_edges;
    uint32_t half_edge_count;
    size_t half_edge_room;
    uint32_t vertex_sharpness_count, normal_count; ///< entries vs and fn
    uint32_t finite_count, finite_line; ///< boundary half-edges that are not sharp for ever
    limni_word_list noted_keywords, noted_tags;
} lomont_reader;

static const char byte_order_mark[] = "\xef\xbb\xbf";

static const char *skip_mark(const char *text) {
    return strncmp(text, byte_order_mark, 3) == 0 ? text + 3 : text;
}

bool limni_is_lomont(const char *text) {
    static const char magic[] = LIMNI_LOMONT_MAGIC;
    const char *const start = skip_mark(text);
    return strncmp(start, magic, sizeof magic - 1) == 0 &&
           strchr(" \t\r\n", start[sizeof magic - 1]);
}

/// The version is in a comment, which the scanner does not see.
static limn_bake_status check_version(const limni_scanner *scanner, const char *text) {
    const char *version = skip_mark(text) + sizeof LIMNI_LOMONT_MAGIC - 1;
    version += strspn(version, " \t");
    const limni_token token = {version, strcspn(version, " \t\r\n")};
    if (limni_token_is(token, LIMNI_LOMONT_VERSION)) return LIMN_BAKE_OK;
    return limni_scanner_fail(scanner, 1,
                              "version '%.*s' of Lomont's format is unknown; " LIMNI_LOMONT_VERSION
                              " is expected",
                              limni_token_shown(token), token.text);
}

// ---- Entries

static limn_bake_status end_line(lomont_reader *reader, const char *what) {
    const limni_token extra = limni_scanner_next_token(&reader->scanner);
    if (extra.size == 0) return LIMN_BAKE_OK;
    return limni_scanner_fail(&reader->scanner, reader->scanner.line, "'%.*s' after %s",
                              limni_token_shown(extra), extra.text, what);
}

static limn_bake_status next_value(lomont_reader *reader, const char *noun, limni_token *token) {
    *token = limni_scanner_next_token(&reader->scanner);
    if (token->size > 0) return LIMN_BAKE_OK;
    return limni_scanner_fail(&reader->scanner, reader->scanner.line, "the %s is missing", noun);
}

static limn_bake_status next_whole(lomont_reader *reader, const char *noun, uint32_t *value) {
    limni_token token;
    LIMNI_TRY(next_value(reader, noun, &token));
    return limni_scanner_whole(&reader->scanner, token, noun, value);
}

/// si v f e n
static limn_bake_status read_sizes(lomont_reader *reader) {
    sizes *const stated = &reader->stated;
    stated->line = reader->scanner.line;
    LIMNI_TRY(next_whole(reader, "vertex count", &stated->vertices));
    LIMNI_TRY(next_whole(reader, "face count", &stated->faces));
    LIMNI_TRY(next_whole(reader, "edge count", &stated->edges));
    LIMNI_TRY(next_whole(reader, "normal count", &stated->normals));
    return end_line(reader, "the counts");
}

/// v x y z
static limn_bake_status read_position(lomont_reader *reader) {
    float position[3];
    const uint32_t line = reader->scanner.line;
    LIMNI_TRY(limni_scanner_numbers(&reader->scanner, "vertex", 3, 3, position));
    return limni_builder_add_position(&reader->builder, position, line);
}

/// f v1 v2 v3. Whether the vertices are there is checked at the end.
static limn_bake_status read_face(lomont_reader *reader) {
    const uint32_t line = reader->scanner.line;
    for (int corner = 0; corner < 3; corner++) {
        uint32_t number = 0;
        LIMNI_TRY(next_whole(reader, "vertex of the face", &number));
        if (number == 0)
            return limni_scanner_fail(&reader->scanner, line,
                                      "face refers to vertex 0, but they count from 1");
        LIMNI_TRY(limni_builder_add_corner(&reader->builder, number - 1));
    }
    LIMNI_TRY(end_line(reader, "the third vertex of the face"));
    return limni_builder_end_face(&reader->builder, line);
}

/// hd j wt
static limn_bake_status read_half_edge(lomont_reader *reader) {
    limni_token pair, weight;
    half_edge entry = {.line = reader->scanner.line};
    LIMNI_TRY(next_value(reader, "pair of the half-edge", &pair));
    LIMNI_TRY(next_value(reader, "sharpness of the half-edge", &weight));
    if (!limni_token_is(pair, "-1")) {
        LIMNI_TRY(limni_scanner_whole(&reader->scanner, pair, "pair of a half-edge", &entry.pair));
        if (entry.pair == 0)
            return limni_scanner_fail(&reader->scanner, entry.line,
                                      "half-edges count from 1; -1 is a boundary");
    }
    LIMNI_TRY(limni_scanner_sharpness(&reader->scanner, weight, &entry.sharpness));
    half_edge *const entries =
        limni_make_room(reader->scanner.context, reader->half_edges, reader->half_edge_count,
                        &reader->half_edge_room, sizeof *entries);
    if (!entries) return LIMN_BAKE_MEMORY;
    reader->half_edges = entries;
    entries[reader->half_edge_count++] = entry;
    return end_line(reader, "the sharpness of the half-edge");
}

/// vs wt
static limn_bake_status read_vertex_sharpness(lomont_reader *reader) {
    limni_token weight;
    limni_sharp_vertex entry = {.position = reader->vertex_sharpness_count,
                                .line = reader->scanner.line};
    LIMNI_TRY(next_value(reader, "sharpness of the vertex", &weight));
    LIMNI_TRY(limni_scanner_sharpness(&reader->scanner, weight, &entry.sharpness));
    reader->vertex_sharpness_count++;
    if (entry.sharpness > 0) LIMNI_TRY(limni_builder_add_sharp_vertex(&reader->builder, entry));
    return end_line(reader, "the sharpness of the vertex");
}

static bool is_unused(limni_token keyword) {
    static const char *const words[] = {"fc", "vc", "ft", "fn", "fni"};
    for (int word = 0; word < 5; word++) {
        if (limni_token_is(keyword, words[word])) return true;
    }
    return false;
}

static void note_ignored(lomont_reader *reader, limni_token keyword) {
    if (!limni_word_list_add(&reader->noted_keywords, keyword)) return;
    limni_note(reader->scanner.context, "%s:%u: %s '%.*s' is ignored", reader->scanner.path,
               reader->scanner.line,
               is_unused(keyword) ? "entry (a colour, texture or normal)" : "unknown entry",
               limni_token_shown(keyword), keyword.text);
}

static limn_bake_status read_entry(lomont_reader *reader, limni_token keyword) {
    if (limni_token_is(keyword, "v")) return read_position(reader);
    if (limni_token_is(keyword, "f")) return read_face(reader);
    if (limni_token_is(keyword, "hd")) return read_half_edge(reader);
    if (limni_token_is(keyword, "vs")) return read_vertex_sharpness(reader);
    if (limni_token_is(keyword, "si")) return read_sizes(reader);
    if (limni_token_is(keyword, "t"))
        return limni_read_tag(&reader->scanner, &reader->builder, &reader->noted_tags);
    note_ignored(reader, keyword);
    reader->normal_count += limni_token_is(keyword, "fn");
    limni_scanner_skip_line(&reader->scanner);
    return LIMN_BAKE_OK;
}

// ---- Entries together

static limn_bake_status check_corners(const lomont_reader *reader) {
    const limni_source *const source = reader->builder.source;
    if (source->position_count == 0 || source->face_count == 0)
        return limni_fail(reader->scanner.context, LIMN_BAKE_BAD_INPUT, "%s: the file has no %s",
                          source->path, source->position_count == 0 ? "vertices" : "faces");
    for (uint32_t corner = 0; corner < source->face_offsets[source->face_count]; corner++) {
        if (source->face_corners[corner] < source->position_count) continue;
        return limni_scanner_fail(&reader->scanner, source->face_lines[corner / 3],
                                  "face refers to vertex %u, but the file has %u",
                                  source->face_corners[corner] + 1, source->position_count);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status check_count(const lomont_reader *reader, const char *noun, uint32_t count,
                                    uint32_t expected) {
    if (count == expected) return LIMN_BAKE_OK;
    return limni_fail(reader->scanner.context, LIMN_BAKE_BAD_INPUT,
                      "%s: the file has %u entries %s; %u are expected", reader->scanner.path,
                      count, noun, expected);
}

static limn_bake_status check_sizes(const lomont_reader *reader) {
    const limni_source *const source = reader->builder.source;
    LIMNI_TRY(check_count(reader, "hd", reader->half_edge_count, 3 * source->face_count));
    if (reader->vertex_sharpness_count > 0)
        LIMNI_TRY(
            check_count(reader, "vs", reader->vertex_sharpness_count, source->position_count));
    uint32_t boundary_count = 0;
    for (uint32_t h = 0; h < reader->half_edge_count; h++)
        boundary_count += reader->half_edges[h].pair == 0;
    const uint32_t edge_count =
        (uint32_t)(((uint64_t)reader->half_edge_count + boundary_count) / 2);
    const sizes *const stated = &reader->stated;
    if (!stated->line ||
        (stated->vertices == source->position_count && stated->faces == source->face_count &&
         stated->edges == edge_count && stated->normals == reader->normal_count))
        return LIMN_BAKE_OK;
    return limni_scanner_fail(&reader->scanner, stated->line,
                              "the file has %u vertices, %u faces, %u edges and %u normals, not "
                              "what is stated here",
                              source->position_count, source->face_count, edge_count,
                              reader->normal_count);
}

static uint64_t directed_edge(const limni_source *source, uint32_t h) {
    const uint32_t next = h % 3 == 2 ? h - 2 : h + 1;
    return (uint64_t)source->face_corners[h] << 32 | source->face_corners[next];
}

/// Half-edges by their ends.
typedef struct half_edge_table {
    uint32_t *half_edges; ///< LIMNI_NONE: free
    uint32_t size;        ///< a power of two
} half_edge_table;

static uint32_t *find_half_edge(const half_edge_table *table, const limni_source *source,
                                uint64_t ends) {
    uint32_t at = (uint32_t)limni_hash_mix(ends, 0) & (table->size - 1);
    while (table->half_edges[at] != LIMNI_NONE &&
           directed_edge(source, table->half_edges[at]) != ends)
        at = (at + 1) & (table->size - 1);
    return &table->half_edges[at];
}

static limn_bake_status make_half_edge_table(const lomont_reader *reader, half_edge_table *table) {
    const limni_source *const source = reader->builder.source;
    table->size = limni_hash_size(reader->half_edge_count);
    table->half_edges =
        limni_allocate(reader->scanner.context, table->size, sizeof *table->half_edges);
    if (!table->half_edges) return LIMN_BAKE_MEMORY;
    memset(table->half_edges, 0xff, table->size * sizeof *table->half_edges);
    for (uint32_t h = 0; h < reader->half_edge_count; h++)
        *find_half_edge(table, source, directed_edge(source, h)) = h;
    return LIMN_BAKE_OK;
}

/// A stated pair must be what the faces say.
static limn_bake_status check_pair(const lomont_reader *reader, const half_edge_table *table,
                                   uint32_t h) {
    const limni_source *const source = reader->builder.source;
    const half_edge *const entry = &reader->half_edges[h];
    const uint64_t ends = directed_edge(source, h), opposite = ends << 32 | ends >> 32;
    if (entry->pair == 0) {
        const uint32_t found = *find_half_edge(table, source, opposite);
        if (found == LIMNI_NONE) return LIMN_BAKE_OK;
        return limni_scanner_fail(&reader->scanner, entry->line,
                                  "half-edge %u is on a boundary, but half-edge %u runs the other "
                                  "way",
                                  h + 1, found + 1);
    }
    if (entry->pair > reader->half_edge_count)
        return limni_scanner_fail(&reader->scanner, entry->line,
                                  "half-edge %u is paired with half-edge %u, but the file has %u",
                                  h + 1, entry->pair, reader->half_edge_count);
    const half_edge *const other = &reader->half_edges[entry->pair - 1];
    if (other->pair != h + 1 || directed_edge(source, entry->pair - 1) != opposite)
        return limni_scanner_fail(&reader->scanner, entry->line, "half-edges %u and %u are no pair",
                                  h + 1, entry->pair);
    if (other->sharpness != entry->sharpness)
        return limni_scanner_fail(&reader->scanner, entry->line,
                                  "half-edges %u and %u are a pair, but differ in sharpness", h + 1,
                                  entry->pair);
    return LIMN_BAKE_OK;
}

/// The sharpness of a boundary says nothing: a boundary is sharp for ever.
static limn_bake_status add_crease(lomont_reader *reader, uint32_t h) {
    const half_edge *const entry = &reader->half_edges[h];
    const uint64_t ends = directed_edge(reader->builder.source, h);
    if (entry->pair == 0 && entry->sharpness < LIMNI_SHARP_FOR_EVER && reader->finite_count++ == 0)
        reader->finite_line = entry->line;
    if (entry->pair <= h + 1 || entry->sharpness == 0) return LIMN_BAKE_OK;
    const limni_crease crease = {(uint32_t)(ends >> 32), (uint32_t)ends, entry->sharpness,
                                 entry->line};
    return limni_builder_add_crease(&reader->builder, crease);
}

static limn_bake_status add_creases(lomont_reader *reader) {
    half_edge_table table;
    LIMNI_TRY(make_half_edge_table(reader, &table));
    for (uint32_t h = 0; h < reader->half_edge_count; h++) {
        LIMNI_TRY(check_pair(reader, &table, h));
        LIMNI_TRY(add_crease(reader, h));
    }
    limni_context *const context = reader->scanner.context;
    limni_release(context, table.half_edges);
    if (reader->finite_count)
        limni_note(context,
                   "%s:%u: %u boundary half-edges are not sharp for ever here; they are all the "
                   "same",
                   reader->scanner.path, reader->finite_line, reader->finite_count);
    return LIMN_BAKE_OK;
}

static limn_bake_status read_all(lomont_reader *reader, const char *text) {
    limni_token keyword;
    LIMNI_TRY(check_version(&reader->scanner, text));
    while (limni_scanner_next_line(&reader->scanner, &keyword))
        LIMNI_TRY(read_entry(reader, keyword));
    LIMNI_TRY(check_corners(reader));
    LIMNI_TRY(check_sizes(reader));
    return add_creases(reader);
}

limn_bake_status limni_read_lomont(limni_context *context, const char *text, size_t size,
                                   limni_source *source) {
    if (!limni_is_lomont(text))
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s:1: the first line must be '" LIMNI_LOMONT_MAGIC
                          " " LIMNI_LOMONT_VERSION "'",
                          source->path);
    lomont_reader reader = {.builder = limni_builder_begin(context, source)};
    source->index_base = 1;
    source->tags.is_lomont = true;
    LIMNI_TRY(limni_scanner_open(&reader.scanner, context, source->path, text, size));
    const limn_bake_status status = read_all(&reader, text);
    limni_scanner_close(&reader.scanner);
    limni_release(context, reader.half_edges);
    return status;
}
