/* SPDX-License-Identifier: MIT */
/*
 * A moment of a clip. Everything is computed in double precision and rounded once, so a matrix does
 * not depend on how deep its joint is. Joints come in depth-first order, so of all joints before
 * one, only those on the way to its root are kept.
 */
#include "limn/character.h"

#include "chunks.h"
#include "require.h"
#include "rounding.h"
#include "transform.h"

#include <math.h>

enum { WIDTH_OF_JOINT_MAX = 4 };

// ---- Tracks

static double moment_of(const limn_clip *clip, float time, limn_wrap wrap) {
    const double duration = (double)clip->duration;
    if (wrap != LIMN_WRAP_REPEAT || !(duration > 0)) return (double)time;
    const double moment = fmod((double)time, duration);
    return moment < 0 ? moment + duration : moment;
}

/// The last key that is not after a moment; the first if all are.
static uint32_t find_key(const float *times, uint32_t count, double moment) {
    uint32_t low = 0, high = count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if ((double)times[middle] <= moment) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/// A moment between two keys of a track: from the value of the first, `t` of the way.
typedef struct sample {
    const float *from, *to; ///< values; of cubic ones with a tangent before, and one behind
    double t, seconds;
    uint32_t width;
} sample;

static sample find_sample(const limn_clip *clip, const limn_file_track *track, double moment) {
    const float *const times = clip->keys + track->first_key;
    const uint32_t key = find_key(times, track->key_count, moment);
    const bool cubic = track->interpolation == LIMN_FORMAT_CUBIC;
    const size_t step = (cubic ? 3u : 1u) * (size_t)track->width;
    const float *const values = times + track->key_count + (cubic ? track->width : 0);
    sample s = {.from = values + key * step, .width = track->width};
    s.to = s.from;
    if (track->interpolation == LIMN_FORMAT_STEP || key + 1 == track->key_count ||
        moment <= (double)times[key])
        return s;
    s.to = s.from + step;
    s.seconds = (double)times[key + 1] - (double)times[key];
    s.t = (moment - (double)times[key]) / s.seconds;
    return s;
}

/// Hermite's spline, as glTF has it: a tangent into each value and one out of it, per second.
static double cubic_at(const sample *s, uint32_t i) {
    const double t = s->t, t2 = t * t, t3 = t2 * t;
    const double out = (double)s->from[s->width + i], in = (double)*(s->to + i - s->width);
    return (2 * t3 - 3 * t2 + 1) * (double)s->from[i] + s->seconds * (t3 - 2 * t2 + t) * out +
           (3 * t2 - 2 * t3) * (double)s->to[i] + s->seconds * (t3 - t2) * in;
}

static double value_at(const limn_file_track *track, const sample *s, uint32_t i) {
    if (s->from == s->to) return (double)s->from[i];
    if (track->interpolation == LIMN_FORMAT_CUBIC) return cubic_at(s, i);
    return (double)s->from[i] + s->t * ((double)s->to[i] - (double)s->from[i]);
}

// ---- Rotations

/// On the sphere, the shorter way.
static void turn(const sample *s, double q[4]) {
    double from[4], to[4], cosine = 0;
    for (int i = 0; i < 4; i++) {
        from[i] = (double)s->from[i];
        to[i] = (double)s->to[i];
    }
    limni_quaternion_normalise(from);
    limni_quaternion_normalise(to);
    for (int i = 0; i < 4; i++)
        cosine += from[i] * to[i];
    const double sign = cosine < 0 ? -1 : 1, angle = acos(fmin(fabs(cosine), 1));
    const bool close = angle < 1e-6; // the sines would cancel
    const double first = close ? 1 - s->t : sin((1 - s->t) * angle) / sin(angle);
    const double second = sign * (close ? s->t : sin(s->t * angle) / sin(angle));
    for (int i = 0; i < 4; i++)
        q[i] = first * from[i] + second * to[i];
}

// ---- Joints

/// Where a joint is, relative to its parent.
typedef struct placement {
    double values[3][WIDTH_OF_JOINT_MAX]; ///< translation, rotation and scale
} placement;

static placement rest_of(const limn_file_joint *joint) {
    placement p;
    for (int i = 0; i < 4; i++) {
        p.values[LIMN_FORMAT_ROTATION][i] = (double)joint->rotation[i];
        p.values[LIMN_FORMAT_TRANSLATION][i] = i < 3 ? (double)joint->translation[i] : 0;
        p.values[LIMN_FORMAT_SCALE][i] = i < 3 ? (double)joint->scale[i] : 0;
    }
    return p;
}

static void move(const limn_clip *clip, const limn_file_track *track, double moment, placement *p) {
    const sample s = find_sample(clip, track, moment);
    double *const values = p->values[track->path];
    if (track->path == LIMN_FORMAT_ROTATION && track->interpolation == LIMN_FORMAT_LINEAR) {
        turn(&s, values);
        return;
    }
    for (uint32_t i = 0; i < track->width; i++)
        values[i] = value_at(track, &s, i);
}

static limni_transform transform_of(const placement *p) {
    return limni_transform_make(p->values[LIMN_FORMAT_TRANSLATION], p->values[LIMN_FORMAT_ROTATION],
                                p->values[LIMN_FORMAT_SCALE]);
}

/// Rounds where a joint is, times its inverse bind matrix.
static void store(const limni_transform *place, const limn_file_joint *joint, float *out) {
    limni_transform bind;
    for (int i = 0; i < 12; i++)
        bind.rows[i / 4][i % 4] = (double)joint->inverse_bind[i / 4][i % 4];
    const limni_transform m = limni_transform_multiply(place, &bind);
    for (int i = 0; i < 12; i++)
        out[i] = (float)m.rows[i / 4][i % 4];
}

/// The joints from a root to the one at hand.
typedef struct way {
    limni_transform places[LIMN_FORMAT_DEPTH_OF_JOINTS];
    uint32_t joints[LIMN_FORMAT_DEPTH_OF_JOINTS];
    uint32_t depth;
} way;

static void step(way *w, uint32_t joint, uint32_t parent, const limni_transform *local) {
    while (w->depth > 0 && w->joints[w->depth - 1] != parent)
        w->depth--;
    w->places[w->depth] =
        w->depth ? limni_transform_multiply(&w->places[w->depth - 1], local) : *local;
    w->joints[w->depth++] = joint;
}

void limn_clip_pose(const limn_skeleton *skeleton, const limn_clip *clip, float time,
                    limn_wrap wrap, float *matrices) {
    LIMNI_REQUIRE(skeleton && (matrices || skeleton->joint_count == 0), );
    const double moment = clip ? moment_of(clip, time, wrap) : 0;
    const limn_file_track *track = clip ? clip->tracks : NULL;
    const limn_file_track *const end = clip && track ? track + clip->track_count : NULL;
    way w;
    w.depth = 0;
    for (uint32_t j = 0; j < skeleton->joint_count; j++) {
        const limn_file_joint *const joint = &skeleton->joints[j];
        placement p = rest_of(joint);
        for (; track < end && track->path != LIMN_FORMAT_TARGET_WEIGHTS && track->target == j;
             track++)
            move(clip, track, moment, &p);
        const limni_transform local = transform_of(&p);
        step(&w, j, joint->parent, &local);
        store(&w.places[w.depth - 1], joint, matrices + 12 * (size_t)j);
    }
}

// ---- Morph targets

static const limn_file_track *find_weights(const limn_clip *clip, uint32_t mesh_index) {
    for (uint32_t t = 0; clip && t < clip->track_count; t++) {
        if (clip->tracks[t].path == LIMN_FORMAT_TARGET_WEIGHTS &&
            clip->tracks[t].target == mesh_index)
            return &clip->tracks[t];
    }
    return NULL;
}

void limn_clip_morph_weights(const limn_pack *pack, uint32_t mesh_index, const limn_clip *clip,
                             float time, limn_wrap wrap, float *weights) {
    LIMNI_REQUIRE(pack && mesh_index < pack->mesh_count, );
    const uint32_t count = limn_mesh_morph_targets(pack, mesh_index).target_count;
    LIMNI_REQUIRE(weights || count == 0, );
    const limn_file_target *const targets = optional_data(pack, mesh_index, LIMN_CHUNK_TARGETS);
    const limn_file_track *const track = find_weights(clip, mesh_index);
    if (!track) {
        for (uint32_t t = 0; t < count; t++)
            weights[t] = targets[t].weight;
        return;
    }
    const sample s = find_sample(clip, track, moment_of(clip, time, wrap));
    for (uint32_t t = 0; t < count; t++)
        weights[t] = (float)value_at(track, &s, t);
}
