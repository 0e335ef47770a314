/* SPDX-License-Identifier: MIT */
#include "session.h"

#include "motion.h"
#include <math.h>
#include <string.h>

// -------------------------------------------------------------------------------------------------
// Start

static void measure_bounds(view_session *session) {
    const limni_bounds *const bounds = &session->scene->bounds;
    float diagonal[3];
    for (int axis = 0; axis < 3; axis++) {
        session->middle[axis] = bounds->min[axis] / 2 + bounds->max[axis] / 2;
        diagonal[axis] = bounds->max[axis] / 2 - bounds->min[axis] / 2;
    }
    session->radius = hypotf(hypotf(diagonal[0], diagonal[1]), diagonal[2]);
}

static void choose_clip(view_session *session, uint32_t index) {
    const limn_pack *const pack = &session->scene->pack;
    session->clip_index = index < limn_pack_clip_count(pack) ? index : LIMN_NONE;
    if (session->clip_index != LIMN_NONE) session->clip = limn_pack_clip(pack, index);
    session->time = 0;
}

static void choose_named_clip(view_session *session, const limni_frame_options *options) {
    choose_clip(session, 0);
    if (!options->clip) return;
    for (uint32_t c = 0; strcmp(session->clip.name, options->clip) != 0; c++) // the scene has it
        choose_clip(session, c);
    session->time = options->time;
}

bool view_session_restart(view_session *session, const view_scene *scene, double aspect) {
    static const float room = 1.4f; // for what a clip moves out of its first picture
    limni_camera camera;
    if (!view_scene_frame(scene, aspect, false, &camera)) return false;
    session->scene = scene;
    measure_bounds(session);
    choose_clip(session, 0);
    if (session->playing && session->clip_index != LIMN_NONE) view_motion_zoom(&camera, room);
    session->home = session->camera = camera;
    return true;
}

bool view_session_start(view_session *session, const view_scene *scene,
                        const view_picture *picture) {
    *session = (view_session){
        .frame = {.colours = picture->colours,
                  .flat_shading = picture->flat_shading,
                  .wireframe = picture->wireframe,
                  .control_mesh = picture->control_mesh},
        .lod = scene->frame.desc,
        .culling = true,
        .light = picture->light,
        .playing = !limni_frame_given(&picture->frame, LIMNI_FRAME_TIME),
        .text = true,
    };
    if (!view_session_restart(session, scene, (double)picture->width / picture->height))
        return false;
    if (scene->frame.has_camera) session->home = session->camera = scene->frame.camera;
    choose_named_clip(session, &picture->frame);
    return true;
}

// -------------------------------------------------------------------------------------------------
// Keys

static void fly(view_session *session, view_key key, float seconds) {
    static const float directions[][3] = {
        [VIEW_KEY_FORWARD] = {0, 0, -1}, [VIEW_KEY_BACKWARD] = {0, 0, 1},
        [VIEW_KEY_LEFT] = {-1, 0, 0},    [VIEW_KEY_RIGHT] = {1, 0, 0},
        [VIEW_KEY_DOWN] = {0, -1, 0},    [VIEW_KEY_UP] = {0, 1, 0},
    };
    // In a second, through what is seen at the target once and a half.
    const float half_height =
        tanf(session->camera.fov / 2) * view_motion_distance(&session->camera);
    const float speed = 3 * half_height;
    float along[3];
    for (int axis = 0; axis < 3; axis++)
        along[axis] = directions[key][axis] * speed * seconds;
    view_motion_fly(&session->camera, along);
}

static void scrub(view_session *session, float seconds) {
    session->playing = false;
    session->time = fmaxf(session->time + seconds, 0);
}

static void next_lod(limn_lod_desc *lod) {
    static const limn_lod next[] = {[LIMN_LOD_LENGTH] = LIMN_LOD_ERROR,
                                    [LIMN_LOD_ERROR] = LIMN_LOD_UNIFORM,
                                    [LIMN_LOD_UNIFORM] = LIMN_LOD_LENGTH};
    lod->lod = next[lod->lod];
    lod->pixels = 0; // the default
}

/// steps: of finer levels
static void refine(limn_lod_desc *lod, float steps) {
    static const float uniform_step = 0.25f, ratio = 0.7071068f;
    if (lod->lod == LIMN_LOD_UNIFORM) {
        lod->level = fminf(fmaxf(lod->level + steps * uniform_step, 0), LIMN_LEVEL_MAX);
        return;
    }
    if (lod->pixels == 0) lod->pixels = lod->lod == LIMN_LOD_ERROR ? 1 : 8;
    lod->pixels = fminf(fmaxf(lod->pixels * powf(ratio, steps), 0.05f), 1000);
}

static void next_light(view_light *light) {
    light->mode = light->mode == VIEW_LIGHT_NONE           ? VIEW_LIGHT_INTERPOLATED
                  : light->mode == VIEW_LIGHT_INTERPOLATED ? VIEW_LIGHT_EXACT
                                                           : VIEW_LIGHT_NONE;
}

static void move_light(view_session *session) {
    session->light_moves = !session->light_moves;
    if (session->light_moves && session->light.mode == VIEW_LIGHT_NONE)
        session->light.mode = VIEW_LIGHT_EXACT;
}

/// The switch of a key that is one; NULL: it is not.
static bool *find_switch(view_session *session, view_key key) {
    bool *const switches[VIEW_KEY_COUNT] = {
        [VIEW_KEY_PLAY] = &session->playing,
        [VIEW_KEY_MORPH] = &session->lod.no_morph,
        [VIEW_KEY_SEAMS] = &session->frame.unsewn,
        [VIEW_KEY_CULL] = &session->culling,
        [VIEW_KEY_WIRES] = &session->frame.wireframe,
        [VIEW_KEY_FLAT] = &session->frame.flat_shading,
        [VIEW_KEY_CONTROLS] = &session->frame.control_mesh,
        [VIEW_KEY_TEXT] = &session->text,
        [VIEW_KEY_SHOT] = &session->shooting,
        [VIEW_KEY_CLOSE] = &session->closing,
    };
    return switches[key];
}

static void act(view_session *session, view_key key, float seconds) {
    switch (key) {
    case VIEW_KEY_EARLIER:
        scrub(session, -seconds);
        break;
    case VIEW_KEY_LATER:
        scrub(session, seconds);
        break;
    case VIEW_KEY_COLOURS:
        session->frame.colours = (view_colours)((session->frame.colours + 1) % VIEW_COLOURS_COUNT);
        break;
    case VIEW_KEY_CLIP:
        choose_clip(session, session->clip_index + 1); // LIMN_NONE + 1 is 0
        break;
    case VIEW_KEY_LOD:
        next_lod(&session->lod);
        break;
    case VIEW_KEY_FINER:
        refine(&session->lod, 1);
        break;
    case VIEW_KEY_COARSER:
        refine(&session->lod, -1);
        break;
    case VIEW_KEY_LIGHT:
        next_light(&session->light);
        break;
    case VIEW_KEY_SPOT:
        move_light(session);
        break;
    case VIEW_KEY_HOME:
        session->camera = session->home;
        break;
    default:
        fly(session, key, seconds);
    }
}

void view_session_press(view_session *session, view_key key, float seconds) {
    bool *const its_switch = find_switch(session, key);
    if (its_switch) {
        *its_switch = !*its_switch;
    } else {
        act(session, key, seconds);
    }
}

void view_session_advance(view_session *session, float seconds) {
    static const float turn = 6.2831853f, light_speed = 0.8f; // radians per second
    if (session->playing) session->time += seconds;
    if (session->light_moves)
        session->light_angle = fmodf(session->light_angle + light_speed * seconds, turn);
}

// -------------------------------------------------------------------------------------------------
// Moments

/// The light goes around the middle, from where it was put.
static view_light place_light(const view_session *session) {
    view_light light = session->light;
    float from[3] = {0.5f * session->radius, 1.4f * session->radius, 1.6f * session->radius};
    if (light.has_spot) {
        for (int axis = 0; axis < 3; axis++)
            from[axis] = light.spot[axis] - session->middle[axis];
    } else if (light.cone == 0) {
        light.cone = 28;
    }
    const float c = cosf(session->light_angle), s = sinf(session->light_angle);
    light.spot[0] = session->middle[0] + c * from[0] + s * from[2];
    light.spot[1] = session->middle[1] + from[1];
    light.spot[2] = session->middle[2] - s * from[0] + c * from[2];
    light.has_spot = true;
    return light;
}

/// Planes that leave room for what a clip moves out of the bounds.
static void place_planes(view_session *session) {
    limni_camera *const camera = &session->camera;
    float way[3];
    for (int axis = 0; axis < 3; axis++)
        way[axis] = camera->eye[axis] - session->middle[axis];
    const float distance = hypotf(hypotf(way[0], way[1]), way[2]);
    camera->far_plane = distance + 3 * session->radius;
    camera->near_plane = fmaxf(distance - 3 * session->radius, camera->far_plane / 2000);
}

view_moment view_session_moment(view_session *session, uint32_t width, uint32_t height) {
    place_planes(session);
    const limni_camera *const camera = &session->camera;
    view_moment moment = {
        .clip = session->clip_index == LIMN_NONE ? NULL : &session->clip,
        .time = session->time,
        .view = limn_view_perspective(camera->eye, camera->target, camera->up, camera->fov,
                                      (float)width, (float)height, camera->near_plane,
                                      camera->far_plane),
        .lod = session->lod,
        .frame = session->frame,
    };
    if (!session->culling) moment.view.plane_count = 0;
    if (session->light.mode != VIEW_LIGHT_NONE) {
        const view_light light = place_light(session);
        if (view_lamps_make(&session->lamps, &light, &session->scene->bounds))
            moment.lighting = &session->lamps.lighting;
    }
    moment.frame.vertex_light = moment.lighting;
    moment.frame.camera = view_camera_matrices(camera, (double)width / height);
    moment.frame.width = width;
    moment.frame.height = height;
    return moment;
}
