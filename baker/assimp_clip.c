/* SPDX-License-Identifier: MIT */
/* Animations: the tracks of nodes, and the weights of morph targets. All are linear. */
#include "assimp_reader.h"

#include "limn/format.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { KEYS_MAX = 1 << 24 };

/// An animation at work.
typedef struct reading {
    const limni_assimp_reader *reader;
    const struct aiAnimation *from;
    limni_label label;
    double seconds; ///< a tick
    limni_model_animation *to;
} reading;

static void note(const reading *r, const limni_model_channel *channel, uint32_t count,
                 const char *text) {
    if (count)
        limni_note(r->reader->context, "%s: %s: %u %s", r->reader->model->path, channel->label,
                   count, text);
}

/// Starts the next channel of the animation, with room for keys.
static limn_bake_status add_channel(const reading *r, int node, uint8_t path, const char *what,
                                    uint32_t key_count, uint32_t width,
                                    limni_model_channel **added) {
    limni_context *const context = r->reader->context;
    limni_model_channel *const channel = &r->to->channels[r->to->channel_count++];
    *channel = (limni_model_channel){
        .node = node, .path = path, .interpolation = LIMN_FORMAT_LINEAR, .width = width};
    snprintf(channel->label, sizeof channel->label, "%s, the %s of node '%.60s'", r->label, what,
             r->reader->model->nodes[node].name);
    if (key_count >= KEYS_MAX)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: %s: too many keys",
                          r->reader->model->path, channel->label);
    channel->times = limni_allocate(context, key_count, sizeof *channel->times);
    channel->values = limni_allocate(context, (size_t)key_count * width, sizeof *channel->values);
    if (!channel->times || !channel->values) return LIMN_BAKE_MEMORY;
    *added = channel;
    return LIMN_BAKE_OK;
}

static limn_bake_status refuse_key(const reading *r, const limni_model_channel *channel,
                                   uint32_t key) {
    return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: key %u is not finite",
                      r->reader->model->path, channel->label, key);
}

static limn_bake_status add_key(const reading *r, limni_model_channel *channel, double ticks,
                                const float *values) {
    float *const to = channel->values + (size_t)channel->width * channel->key_count;
    bool finite = isfinite(channel->times[channel->key_count] = (float)(ticks * r->seconds)) != 0;
    for (uint32_t i = 0; i < channel->width; i++)
        finite &= isfinite(to[i] = values[i]) != 0;
    if (!finite) return refuse_key(r, channel, channel->key_count);
    channel->key_count++;
    return LIMN_BAKE_OK;
}

/// Keeps, of several keys at one time, the last; and before the start, the last at the start.
static void finish_channel(const reading *r, limni_model_channel *channel) {
    uint32_t kept = 0, before = 0, repeated = 0;
    for (uint32_t k = 0; k < channel->key_count; k++) {
        const float time = fmaxf(channel->times[k], 0);
        const bool early = channel->times[k] < -1e-4f;
        const bool replaces = kept && channel->times[kept - 1] == time;
        before += early;
        repeated += replaces && !early;
        kept -= replaces;
        channel->times[kept] = time;
        memmove(channel->values + (size_t)channel->width * kept,
                channel->values + (size_t)channel->width * k, channel->width * sizeof(float));
        kept++;
    }
    note(r, channel, before, "keys lie before the start; the last of them is kept, at the start");
    note(r, channel, repeated, "keys have the time of another; the last of these is kept");
    channel->key_count = kept;
}

// ---- Nodes

static limn_bake_status read_vectors(const reading *r, int node, uint8_t path, const char *what,
                                     const struct aiVectorKey *keys, unsigned count) {
    limni_model_channel *channel;
    if (!keys || count == 0) return LIMN_BAKE_OK;
    LIMNI_TRY(add_channel(r, node, path, what, count, 3, &channel));
    for (unsigned k = 0; k < count; k++) {
        const struct aiVector3D v = keys[k].mValue;
        LIMNI_TRY(add_key(r, channel, keys[k].mTime, (const float[]){v.x, v.y, v.z}));
    }
    finish_channel(r, channel);
    return LIMN_BAKE_OK;
}

static limn_bake_status read_rotations(const reading *r, int node, const struct aiQuatKey *keys,
                                       unsigned count) {
    limni_model_channel *channel;
    if (!keys || count == 0) return LIMN_BAKE_OK;
    LIMNI_TRY(add_channel(r, node, LIMN_FORMAT_ROTATION, "rotation", count, 4, &channel));
    for (unsigned k = 0; k < count; k++) {
        const struct aiQuaternion q = keys[k].mValue;
        LIMNI_TRY(add_key(r, channel, keys[k].mTime, (const float[]){q.x, q.y, q.z, q.w}));
    }
    finish_channel(r, channel);
    return LIMN_BAKE_OK;
}

static limn_bake_status read_node(const reading *r, const struct aiNodeAnim *from) {
    const int node = limni_assimp_find_node(r->reader, &from->mNodeName);
    if (node < 0) {
        limni_note(r->reader->context, "%s: %s: there is no node '%.60s'; its track is passed over",
                   r->reader->model->path, r->label, from->mNodeName.data);
        return LIMN_BAKE_OK;
    }
    LIMNI_TRY(read_vectors(r, node, LIMN_FORMAT_TRANSLATION, "translation", from->mPositionKeys,
                           from->mNumPositionKeys));
    LIMNI_TRY(read_rotations(r, node, from->mRotationKeys, from->mNumRotationKeys));
    return read_vectors(r, node, LIMN_FORMAT_SCALE, "scale", from->mScalingKeys,
                        from->mNumScalingKeys);
}

// ---- Morph targets

/// The node of a mesh by the name of a track: that of the node with "*0" behind it in FBX, or that
/// of the mesh.
static int find_morphed(const reading *r, const struct aiString *name) {
    const limni_model *const model = r->reader->model;
    struct aiString stem = *name;
    char *const star = strrchr(stem.data, '*');
    if (star) *star = '\0';
    const int node = limni_assimp_find_node(r->reader, &stem);
    if (node >= 0 && model->nodes[node].mesh >= 0) return node;
    for (uint32_t n = 0; n < model->node_count; n++) {
        const int mesh = model->nodes[n].mesh;
        if (mesh >= 0 && strncmp(model->meshes[mesh].name, stem.data, sizeof stem.data) == 0)
            return (int)n;
    }
    return -1;
}

/// Weights at a key; NAN: nothing is said.
static limn_bake_status take_weights(const reading *r, const struct aiMeshMorphKey *key,
                                     const limni_model_channel *channel, float *weights) {
    for (uint32_t t = 0; t < channel->width; t++)
        weights[t] = NAN;
    for (unsigned i = 0; key->mValues && key->mWeights && i < key->mNumValuesAndWeights; i++) {
        if (key->mValues[i] >= channel->width || !isfinite((float)key->mWeights[i]))
            return limni_fail(r->reader->context, LIMN_BAKE_BAD_INPUT,
                              "%s: %s: a key has target %u, of %u, with weight %g",
                              r->reader->model->path, channel->label, key->mValues[i],
                              channel->width, key->mWeights[i]);
        weights[key->mValues[i]] = (float)key->mWeights[i];
    }
    return LIMN_BAKE_OK;
}

/// Each target has keys of its own: between them its weights lie on lines, before and behind them
/// they stay, and without any it is at rest.
static void complete_weights(const limni_model_channel *channel, uint32_t target, float rest) {
    float *const values = channel->values + target;
    const float *const times = channel->times;
    const size_t width = channel->width;
    uint32_t last = UINT32_MAX;
    for (uint32_t k = 0; k < channel->key_count; k++) {
        if (isnan(values[k * width])) continue;
        const float to = values[k * width];
        const float from = last == UINT32_MAX ? to : values[last * width];
        for (uint32_t i = last + 1; i < k; i++)
            values[i * width] =
                last == UINT32_MAX
                    ? to
                    : from + (to - from) * ((times[i] - times[last]) / (times[k] - times[last]));
        last = k;
    }
    for (uint32_t i = last + 1; i < channel->key_count; i++)
        values[i * width] = last == UINT32_MAX ? rest : values[last * width];
}

static limn_bake_status read_morph(const reading *r, const struct aiMeshMorphAnim *from) {
    const limni_model *const model = r->reader->model;
    limni_context *const context = r->reader->context;
    const int node = find_morphed(r, &from->mName);
    const limni_model_mesh *const mesh = node < 0 ? NULL : &model->meshes[model->nodes[node].mesh];
    const uint32_t width = mesh && mesh->part_count ? mesh->parts[0].target_count : 0;
    limni_model_channel *channel;
    if (width == 0 || !from->mKeys || from->mNumKeys == 0) {
        limni_note(context,
                   "%s: %s: weights of '%.60s' move no morph targets; they are passed over",
                   model->path, r->label, from->mName.data);
        return LIMN_BAKE_OK;
    }
    LIMNI_TRY(add_channel(r, node, LIMN_FORMAT_TARGET_WEIGHTS, "weights", from->mNumKeys, width,
                          &channel));
    for (unsigned k = 0; k < from->mNumKeys; k++) {
        channel->times[k] = (float)(from->mKeys[k].mTime * r->seconds);
        if (!isfinite(channel->times[k])) return refuse_key(r, channel, k);
        LIMNI_TRY(take_weights(r, &from->mKeys[k], channel, channel->values + (size_t)width * k));
    }
    channel->key_count = from->mNumKeys;
    for (uint32_t t = 0; t < width; t++)
        complete_weights(channel, t, (float)mesh->weights[t]);
    finish_channel(r, channel);
    return LIMN_BAKE_OK;
}

// ---- Animations

static limn_bake_status read_animation(const limni_assimp_reader *reader, uint32_t index) {
    const struct aiAnimation *const from = reader->scene->mAnimations[index];
    limni_model_animation *const to = &reader->model->animations[index];
    reading r = {.reader = reader, .from = from, .to = to};
    double ticks = from->mTicksPerSecond;
    to->name = limni_assimp_text(reader->context, &from->mName);
    if (!to->name) return LIMN_BAKE_MEMORY;
    limni_label_make(r.label, "animation", index, to->name);
    if (!(ticks > 0 && isfinite(ticks))) {
        ticks = 25;
        limni_note(reader->context, "%s: %s: it does not say how long a tick is; taken as 1/25 s",
                   reader->model->path, r.label);
    }
    r.seconds = 1 / ticks;
    const unsigned nodes = from->mChannels ? from->mNumChannels : 0;
    const unsigned morphs = from->mMorphMeshChannels ? from->mNumMorphMeshChannels : 0;
    to->channels =
        limni_allocate(reader->context, (size_t)3 * nodes + morphs, sizeof *to->channels);
    if (!to->channels) return LIMN_BAKE_MEMORY;
    for (unsigned c = 0; c < nodes; c++)
        LIMNI_TRY(read_node(&r, from->mChannels[c]));
    for (unsigned c = 0; c < morphs; c++)
        LIMNI_TRY(read_morph(&r, from->mMorphMeshChannels[c]));
    return LIMN_BAKE_OK;
}

limn_bake_status limni_assimp_read_animations(const limni_assimp_reader *reader) {
    limni_model *const model = reader->model;
    const uint32_t count = reader->scene->mAnimations ? reader->scene->mNumAnimations : 0;
    model->animations = limni_allocate_zeroed(reader->context, count, sizeof *model->animations);
    if (!model->animations) return LIMN_BAKE_MEMORY;
    model->animation_count = count;
    for (uint32_t a = 0; a < count; a++)
        LIMNI_TRY(read_animation(reader, a));
    return LIMN_BAKE_OK;
}
