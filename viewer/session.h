/* SPDX-License-Identifier: MIT */
/* What the user of the window has chosen, and how keys change it. Knows no window and no OpenGL. */
#ifndef VIEW_SESSION_H
#define VIEW_SESSION_H

#include "game_loop.h"
#include "keys.h"
#include "picture.h"
#include "scene.h"

typedef struct view_session {
    const view_scene *scene;
    limni_camera camera, home;
    float middle[3], radius; ///< of the bounds
    view_frame frame;        ///< all but the camera and the size
    limn_lod_desc lod;
    bool culling;
    view_light light;
    view_lamps lamps;
    bool light_moves;
    float light_angle;   ///< radians
    uint32_t clip_index; ///< or LIMN_NONE
    limn_clip clip;
    float time; ///< seconds
    bool playing;
    bool text;
    bool shooting; ///< the next frame is to be written
    bool closing;
} view_session;

/// What the command line says of a scene that was opened with it. Its clip stands still if a time
/// was given; without a name the first clip plays. Reports why and returns false on failure.
bool view_session_start(view_session *session, const view_scene *scene,
                        const view_picture *picture);

/// Another scene, with what was chosen for the one before, but a camera and a clip of its own.
bool view_session_restart(view_session *session, const view_scene *scene, double aspect);

/// A key: of those that are held, for `seconds`.
void view_session_press(view_session *session, view_key key, float seconds);

/// Lets time pass.
void view_session_advance(view_session *session, float seconds);

/// What is to be seen now in a framebuffer of that size. Points into the session.
view_moment view_session_moment(view_session *session, uint32_t width, uint32_t height);

#endif
