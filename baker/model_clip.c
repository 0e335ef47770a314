/* SPDX-License-Identifier: MIT */
/* Animations become clips, and their channels tracks of joints and of morph targets. */
#include "model_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// An animation at work.
typedef struct recording {
    limni_model_reader *reader;
    const limni_model_animation *animation;
    limn_file_clip clip;
    limn_file_track *tracks; ///< [clip.track_count]
    uint32_t *channels;      ///< [clip.track_count] where they come from
} recording;

static limn_bake_status refuse(const recording *r, uint32_t channel, const char *text) {
    return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: %s", r->reader->model->path,
                      r->animation->channels[channel].label, text);
}

static void note(const recording *r, uint32_t channel, const char *text) {
    limni_note(r->reader->context, "%s: %s: %s; it is passed over", r->reader->model->path,
               r->animation->channels[channel].label, text);
}

/// What a channel moves, or that it is passed over.
static limn_bake_status find_target(const recording *r, uint32_t index, limn_file_track *track,
                                    bool *found) {
    const limni_model_channel *const channel = &r->animation->channels[index];
    *found = false;
    if (channel->node < 0 || (uint32_t)channel->node >= r->reader->model->node_count)
        return refuse(r, index, "there is no such node");
    const limni_model_place *const place = &r->reader->places[channel->node];
    const bool weights = channel->path == LIMN_FORMAT_TARGET_WEIGHTS;
    *track = (limn_file_track){.target = weights ? place->mesh : place->joint,
                               .path = channel->path,
                               .interpolation = channel->interpolation,
                               .width = (uint16_t)channel->width,
                               .key_count = channel->key_count};
    if (track->target == LIMN_FORMAT_NONE || channel->width == 0)
        note(r, index, weights ? "its node has no morph targets" : "its node moves no mesh");
    else if (weights &&
             channel->width != r->reader->scene->sources[place->mesh - r->reader->scene->first_mesh]
                                   .rig.target_count)
        return refuse(r, index, "it has another number of weights than its node");
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

static limn_bake_status check_times(const recording *r, uint32_t index) {
    const limni_model_channel *const channel = &r->animation->channels[index];
    if (channel->key_count == 0 || channel->key_count >= 1u << 24)
        return refuse(r, index, "it has no keys, or too many");
    for (uint32_t k = 0; k < channel->key_count; k++) {
        if (channel->times[k] >= 0 && isfinite(channel->times[k]) &&
            !(k && channel->times[k] <= channel->times[k - 1]))
            continue;
        char text[96];
        snprintf(text, sizeof text, "time %u is negative, not finite, or not after the one before",
                 k);
        return refuse(r, index, text);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status record(recording *r, uint32_t t) {
    limni_context *const context = r->reader->context;
    limni_list *const keys = &r->reader->scene->character->keys;
    limn_file_track *const track = &r->tracks[t];
    const limni_model_channel *const channel = &r->animation->channels[r->channels[t]];
    const size_t parts = track->interpolation == LIMN_FORMAT_CUBIC ? 3 : 1;
    LIMNI_TRY(check_times(r, r->channels[t]));
    track->first_key = keys->count;
    LIMNI_TRY(limni_list_add(context, keys, channel->times, track->key_count, sizeof(float)));
    LIMNI_TRY(limni_list_add(context, keys, channel->values,
                             parts * track->key_count * track->width, sizeof(float)));
    const float last = channel->times[track->key_count - 1];
    if (last > r->clip.duration) r->clip.duration = last;
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
static limn_bake_status name_clip(limni_model_reader *reader, const char *name, uint32_t *offset) {
    limni_character *const character = reader->scene->character;
    char numbered[256];
    snprintf(numbered, sizeof numbered, "%s", name);
    for (uint32_t number = 2; has_clip(character, numbered); number++)
        snprintf(numbered, sizeof numbered, "%.240s %u", name, number);
    if (strncmp(numbered, name, sizeof numbered - 1) != 0)
        limni_note(reader->context, "%s: there is a clip '%s' already: this one is '%s'",
                   reader->model->path, name, numbered);
    return limni_character_add_text(reader->context, character, numbered, offset);
}

static limn_bake_status read_clip(limni_model_reader *reader, uint32_t index) {
    limni_context *const context = reader->context;
    limni_character *const character = reader->scene->character;
    const limni_model_animation *const animation = &reader->model->animations[index];
    const uint32_t count = animation->channel_count;
    recording r = {.reader = reader, .animation = animation};
    limni_label label;
    limni_label_make(label, "animation", index, animation->name);
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
    LIMNI_TRY(name_clip(reader, animation->name[0] ? animation->name : label, &r.clip.name));
    LIMNI_TRY(limni_list_add(context, &character->clips, &r.clip, 1, sizeof r.clip));
    LIMNI_TRY(limni_list_add(context, &character->tracks, r.tracks, r.clip.track_count,
                             sizeof *r.tracks));
    limni_release(context, r.tracks);
    limni_release(context, r.channels);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_model_read_clips(limni_model_reader *reader) {
    for (uint32_t a = 0; a < reader->model->animation_count; a++)
        LIMNI_TRY(read_clip(reader, a));
    return LIMN_BAKE_OK;
}
