/* SPDX-License-Identifier: MIT */
/* Animations become clips, and their channels tracks of joints and of morph targets. */
#include "gltf_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// An animation at work.
typedef struct recording {
    limni_gltf_reader *reader;
    const limni_gltf_animation *animation;
    limni_gltf_label label;
    limn_file_clip clip;
    limn_file_track *tracks; ///< [clip.track_count]
    uint32_t *channels;      ///< [clip.track_count] where they come from
} recording;

static limn_bake_status refuse(const recording *r, uint32_t channel, const char *text) {
    return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s, channel %u: %s",
                      r->reader->document->path, r->label, channel, text);
}

static void note(const recording *r, uint32_t channel, const char *text) {
    limni_note(r->reader->context, "%s: %s, channel %u: %s; it is passed over",
               r->reader->document->path, r->label, channel, text);
}

static bool find_index(const char *const *names, uint32_t count, const char *name, uint8_t *index) {
    for (uint32_t n = 0; n < count; n++) {
        if (strcmp(names[n], name) != 0) continue;
        *index = (uint8_t)n;
        return true;
    }
    return false;
}

/// What a channel moves, or that it is passed over.
static limn_bake_status find_target(const recording *r, uint32_t index, limn_file_track *track,
                                    bool *found) {
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const char *const interpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const limni_gltf_channel *const channel = &r->animation->channels[index];
    const limni_gltf *const document = r->reader->document;
    *found = false;
    if (channel->node < 0 || (uint32_t)channel->node >= document->node_count)
        return refuse(r, index, "there is no such node");
    const limni_gltf_place *const place = &r->reader->places[channel->node];
    if (!find_index(paths, 4, channel->path, &track->path)) {
        note(r, index, "it moves something unknown");
        return LIMN_BAKE_OK;
    }
    if (!find_index(interpolations, 3, channel->interpolation, &track->interpolation))
        return refuse(r, index, "its sampler does not exist, or interpolates in an unknown way");
    const bool weights = track->path == LIMN_FORMAT_TARGET_WEIGHTS;
    track->target = weights ? place->mesh : place->joint;
    track->width = track->path == LIMN_FORMAT_ROTATION ? 4 : 3;
    if (weights && place->mesh != LIMN_FORMAT_NONE)
        track->width =
            (uint16_t)r->reader->scene->sources[place->mesh - r->reader->scene->first_mesh]
                .rig.target_count;
    if (track->target == LIMN_FORMAT_NONE || track->width == 0)
        note(r, index, weights ? "its node has no morph targets" : "its node moves no mesh");
    else
        *found = true;
    return LIMN_BAKE_OK;
}

// ---- Order

/// Inserts a track where it belongs; false if there is one like it.
static bool insert(recording *r, const limn_file_track *track, uint32_t channel) {
    const uint64_t key = limn_file_track_key(track);
    uint32_t at = r->clip.track_count;
    while (at > 0 && limn_file_track_key(&r->tracks[at - 1]) >= key)
        at--;
    if (at < r->clip.track_count && limn_file_track_key(&r->tracks[at]) == key) return false;
    const size_t moved = r->clip.track_count - at;
    memmove(r->tracks + at + 1, r->tracks + at, moved * sizeof *r->tracks);
    memmove(r->channels + at + 1, r->channels + at, moved * sizeof *r->channels);
    r->tracks[at] = *track;
    r->channels[at] = channel;
    r->clip.track_count++;
    return true;
}

// ---- Keys

static limn_bake_status read_times(const recording *r, uint32_t channel, const char *what,
                                   float **times, uint32_t *count) {
    const int index = r->animation->channels[channel].input;
    const limni_gltf_accessor *accessor;
    LIMNI_TRY(limni_gltf_find_accessor(r->reader, index, what, &accessor));
    if (accessor->count == 0 || accessor->count >= 1u << 24)
        return refuse(r, channel, "it has no keys, or too many");
    *count = (uint32_t)accessor->count;
    *times = limni_allocate(r->reader->context, *count, sizeof **times);
    if (!*times) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(limni_gltf_read_floats(r->reader, index, what, *count, 1, *times));
    for (uint32_t k = 0; k < *count; k++) {
        if ((*times)[k] < 0 || (k && (*times)[k] <= (*times)[k - 1]))
            return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: accessor %d (%s): time %u is negative, or not after the one "
                              "before",
                              r->reader->document->path, index, what, k);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_values(const recording *r, uint32_t channel, const char *what,
                                    const limn_file_track *track, float **values, size_t *count) {
    const bool weights = track->path == LIMN_FORMAT_TARGET_WEIGHTS;
    const uint64_t parts = track->interpolation == LIMN_FORMAT_CUBIC ? 3 : 1;
    const uint64_t elements = track->key_count * parts * (weights ? track->width : 1);
    *count = (size_t)(track->key_count * parts * track->width);
    *values = limni_allocate(r->reader->context, *count, sizeof **values);
    if (!*values) return LIMN_BAKE_MEMORY;
    return limni_gltf_read_floats(r->reader, r->animation->channels[channel].output, what, elements,
                                  weights ? 1 : track->width, *values);
}

static limn_bake_status record(recording *r, uint32_t t) {
    limni_context *const context = r->reader->context;
    limni_list *const keys = &r->reader->scene->character->keys;
    limn_file_track *const track = &r->tracks[t];
    const uint32_t channel = r->channels[t];
    float *times = NULL, *values = NULL;
    size_t value_count = 0;
    char what[160];
    snprintf(what, sizeof what, "%s, channel %u, times", r->label, channel);
    LIMNI_TRY(read_times(r, channel, what, &times, &track->key_count));
    snprintf(what, sizeof what, "%s, channel %u, values", r->label, channel);
    LIMNI_TRY(read_values(r, channel, what, track, &values, &value_count));
    track->first_key = keys->count;
    LIMNI_TRY(limni_list_add(context, keys, times, track->key_count, sizeof *times));
    LIMNI_TRY(limni_list_add(context, keys, values, value_count, sizeof *values));
    const float last = times[track->key_count - 1];
    if (last > r->clip.duration) r->clip.duration = last;
    limni_release(context, times);
    limni_release(context, values);
    return LIMN_BAKE_OK;
}

static bool has_clip(const limni_character *character, const char *name) {
    const limn_file_clip *const clips = character->clips.items;
    for (uint32_t c = 0; c < character->clips.count; c++) {
        if (strcmp((const char *)character->strings.items + clips[c].name, name) == 0) return true;
    }
    return false;
}

/// A clip is found by its name: of several with one name, which several files may have, later ones
/// get a number behind it, with a note.
static limn_bake_status name_clip(limni_gltf_reader *reader, const char *name, uint32_t *offset) {
    limni_character *const character = reader->scene->character;
    char numbered[256];
    snprintf(numbered, sizeof numbered, "%s", name);
    for (uint32_t number = 2; has_clip(character, numbered); number++)
        snprintf(numbered, sizeof numbered, "%.240s %u", name, number);
    if (strncmp(numbered, name, sizeof numbered - 1) != 0)
        limni_note(reader->context, "%s: there is a clip '%s' already: this one is '%s'",
                   reader->document->path, name, numbered);
    return limni_character_add_text(reader->context, character, numbered, offset);
}

static limn_bake_status read_clip(limni_gltf_reader *reader, uint32_t index) {
    limni_context *const context = reader->context;
    limni_character *const character = reader->scene->character;
    const limni_gltf_animation *const animation = &reader->document->animations[index];
    const uint32_t count = animation->channel_count;
    recording r = {.reader = reader, .animation = animation};
    limni_gltf_name(r.label, "animation", index, animation->name);
    r.tracks = limni_allocate(context, count, sizeof *r.tracks);
    r.channels = limni_allocate(context, count, sizeof *r.channels);
    if (!r.tracks || !r.channels) return LIMN_BAKE_MEMORY;
    for (uint32_t c = 0; c < count; c++) {
        limn_file_track track = {0};
        bool found;
        LIMNI_TRY(find_target(&r, c, &track, &found));
        if (found && !insert(&r, &track, c)) note(&r, c, "another moves the same");
    }
    for (uint32_t t = 0; t < r.clip.track_count; t++)
        LIMNI_TRY(record(&r, t));
    r.clip.first_track = character->tracks.count;
    LIMNI_TRY(name_clip(reader, animation->name[0] ? animation->name : r.label, &r.clip.name));
    LIMNI_TRY(limni_list_add(context, &character->clips, &r.clip, 1, sizeof r.clip));
    LIMNI_TRY(limni_list_add(context, &character->tracks, r.tracks, r.clip.track_count,
                             sizeof *r.tracks));
    limni_release(context, r.tracks);
    limni_release(context, r.channels);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_clips(limni_gltf_reader *reader) {
    for (uint32_t a = 0; a < reader->document->animation_count; a++)
        LIMNI_TRY(read_clip(reader, a));
    return LIMN_BAKE_OK;
}
