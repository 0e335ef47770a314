/* SPDX-License-Identifier: MIT */
#include "statistics.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static double blend(double mean, double value) {
    return mean > 0 ? 0.93 * mean + 0.07 * value : value;
}

void view_statistics_add(view_statistics *statistics, const view_game *game, double seconds) {
    static const double shortest = 1e-5; // what passes before the first frame is none
    if (seconds > shortest) statistics->frame_seconds = blend(statistics->frame_seconds, seconds);
    for (int stage = 0; stage < VIEW_STAGE_COUNT; stage++)
        statistics->stage_seconds[stage] =
            blend(statistics->stage_seconds[stage], game->seconds[stage]);
}

typedef struct writer {
    char *to;
    size_t left;
} writer;

#if defined(__GNUC__)
static void append(writer *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
#endif

static void append(writer *out, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(out->to, out->left, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= out->left) {
        out->left = 0;
        return;
    }
    out->to += length;
    out->left -= (size_t)length;
}

static void write_times(writer *out, const view_statistics *statistics) {
    static const char *const names[VIEW_STAGE_COUNT] = {"pose", "normals",  "plan",
                                                        "wait", "evaluate", "draw"};
    const double frame = statistics->frame_seconds;
    append(out, "%s   %.0f fps   %.1f ms\n", statistics->name, frame > 0 ? 1 / frame : 0,
           1e3 * frame);
    for (int stage = 0; stage < VIEW_STAGE_COUNT; stage++)
        append(out, "%s %.2f  ", names[stage], 1e3 * statistics->stage_seconds[stage]);
    append(out, "ms\n%u threads, %s mapping, %s draws\n", statistics->thread_count,
           statistics->persistent ? "persistent" : "unsynchronised",
           statistics->indirect ? "indirect" : "direct");
}

static void write_counts(writer *out, const view_game *game) {
    uint64_t triangle_count = 0, patch_count = 0;
    for (uint32_t a = 0; a < game->actor_count; a++) {
        triangle_count += game->actors[a].surface->plan.index_count / 3;
        patch_count += game->actors[a].surface->plan.patch_count;
    }
    append(out, "%llu vertices, %llu triangles, %llu patches, %.0f KB\n",
           (unsigned long long)game->vertex_count, (unsigned long long)triangle_count,
           (unsigned long long)patch_count,
           (double)(game->vertex_count * sizeof(view_vertex)) / 1024);
}

static void write_levels(writer *out, const view_session *session) {
    const limn_lod_desc *const lod = &session->lod;
    switch (lod->lod) {
    case LIMN_LOD_UNIFORM:
        append(out, "level %.2f", (double)lod->level);
        break;
    case LIMN_LOD_ERROR:
        append(out, "levels by error, %.2f px", lod->pixels > 0 ? (double)lod->pixels : 1);
        break;
    default:
        append(out, "levels by length, %.2f px", lod->pixels > 0 ? (double)lod->pixels : 8);
    }
    append(out, "%s%s%s\n", lod->no_morph ? ", no morphing" : "",
           session->frame.unsewn ? ", no seams" : "", session->culling ? "" : ", no culling");
}

static void write_moment(writer *out, const view_session *session) {
    static const char *const lights[] = {[VIEW_LIGHT_NONE] = "per pixel",
                                         [VIEW_LIGHT_BASE] = "",
                                         [VIEW_LIGHT_INTERPOLATED] = "interpolated",
                                         [VIEW_LIGHT_EXACT] = "exact"};
    append(out, "light %s%s", lights[session->light.mode], session->light_moves ? ", moving" : "");
    if (session->clip_index == LIMN_NONE) return;
    const float duration = session->clip.duration;
    append(out, "\n%s %.2f of %.2f s%s", session->clip.name,
           (double)(duration > 0 ? fmodf(session->time, duration) : 0), (double)duration,
           session->playing ? "" : ", paused");
}

void view_statistics_write(const view_statistics *statistics, const view_session *session,
                           const view_game *game, char *lines, size_t size) {
    writer out = {lines, size};
    write_times(&out, statistics);
    write_counts(&out, game);
    write_levels(&out, session);
    write_moment(&out, session);
}
