/* SPDX-License-Identifier: MIT */
#include "write_mesh.h"

void limni_write_positions(const float (*positions)[3], uint32_t count, FILE *stream) {
    for (uint32_t p = 0; p < count; p++)
        fprintf(stream, "v %.9g %.9g %.9g\n", (double)positions[p][0], (double)positions[p][1],
                (double)positions[p][2]);
}

void limni_write_options_tags(limn_boundary boundary, limn_creasing creasing, FILE *stream) {
    static const int numbers[] = {[LIMN_BOUNDARY_NONE] = 0,
                                  [LIMN_BOUNDARY_EDGE_AND_CORNER] = 1,
                                  [LIMN_BOUNDARY_EDGE_ONLY] = 2};
    if (boundary != LIMN_BOUNDARY_DEFAULT)
        fprintf(stream, "t interpolateboundary 1/0/0 %d\n", numbers[boundary]);
    if (creasing != LIMN_CREASING_DEFAULT)
        fprintf(stream, "t creasemethod 0/0/1 %s\n",
                creasing == LIMN_CREASING_CHAIKIN ? "chaikin" : "normal");
}

void limni_write_crease_tag(uint32_t a, uint32_t b, float sharpness, FILE *stream) {
    fprintf(stream, "t crease 2/1/0 %u %u %.9g\n", a, b, (double)sharpness);
}

void limni_write_hole_tag(uint32_t face, FILE *stream) {
    fprintf(stream, "t hole 1/0/0 %u\n", face);
}

static void write_tags(const limni_tags *tags, FILE *stream) {
    limni_write_options_tags(tags->boundary, tags->creasing, stream);
    for (uint32_t c = 0; c < tags->crease_count; c++) {
        const limni_crease *const crease = &tags->creases[c];
        limni_write_crease_tag(crease->a, crease->b, crease->sharpness, stream);
    }
    for (uint32_t v = 0; v < tags->sharp_vertex_count; v++) {
        const limni_sharp_vertex *const vertex = &tags->sharp_vertices[v];
        fprintf(stream, "t corner 1/1/0 %u %.9g\n", vertex->position, (double)vertex->sharpness);
    }
    for (uint32_t h = 0; h < tags->hole_count; h++)
        limni_write_hole_tag(tags->holes[h].face, stream);
}

/// The channel that OBJ has room for.
static const limni_source_channel *find_uv(const limni_source *source) {
    for (uint32_t c = 0; c < source->channel_count; c++) {
        if (source->channels[c].kind == LIMN_CHANNEL_UV) return &source->channels[c];
    }
    return NULL;
}

void limni_write_obj(const limni_source *source, FILE *stream) {
    const limni_source_channel *const uv = find_uv(source);
    limni_write_positions((const float(*)[3])source->positions, source->position_count, stream);
    for (uint32_t v = 0; uv && v < uv->value_count; v++)
        fprintf(stream, "vt %.9g %.9g\n", (double)uv->values[v][0], (double)uv->values[v][1]);
    for (uint32_t face = 0; face < source->face_count; face++) {
        fputc('f', stream);
        for (uint32_t c = source->face_offsets[face]; c < source->face_offsets[face + 1]; c++) {
            fprintf(stream, " %u", source->face_corners[c] + 1);
            if (uv) fprintf(stream, "/%u", uv->corner_values[c] + 1);
        }
        fputc('\n', stream);
    }
    write_tags(&source->tags, stream);
}
