/* SPDX-License-Identifier: MIT */
/* The keys of the window. */
#ifndef VIEW_KEYS_H
#define VIEW_KEYS_H

/// X(what it does, its name for GLFW, its name in --keys and --help, help)
#define VIEW_KEYS(X)                                                                               \
    X(FORWARD, W, "w", "fly forward")                                                              \
    X(BACKWARD, S, "s", "fly backward")                                                            \
    X(LEFT, A, "a", "fly to the left")                                                             \
    X(RIGHT, D, "d", "fly to the right")                                                           \
    X(DOWN, Q, "q", "fly down")                                                                    \
    X(UP, E, "e", "fly up")                                                                        \
    X(EARLIER, LEFT, "left", "scrub the clip back")                                                \
    X(LATER, RIGHT, "right", "scrub the clip forward")                                             \
    X(PLAY, SPACE, "space", "play the clip, or pause")                                             \
    X(CLIP, TAB, "tab", "the next clip, and after the last none")                                  \
    X(LOD, L, "l", "levels by length, by error, or uniform")                                       \
    X(FINER, EQUAL, "=", "finer: a smaller tolerance, or a higher level")                          \
    X(COARSER, MINUS, "-", "coarser")                                                              \
    X(MORPH, M, "m", "morphing on and off")                                                        \
    X(SEAMS, J, "j", "seams on and off: off, patches do not fit coarser ones")                     \
    X(CULL, K, "k", "culling on and off")                                                          \
    X(WIRES, T, "t", "triangles, and the borders of patches")                                      \
    X(COLOURS, C, "c", "colours: materials, levels, classes, normals, uv, clay")                   \
    X(FLAT, F, "f", "flat or smooth shading")                                                      \
    X(CONTROLS, P, "p", "the control mesh")                                                        \
    X(LIGHT, I, "i", "light per pixel, or the runtime's: interpolated, exact")                     \
    X(SPOT, O, "o", "move the light, or let it stand")                                             \
    X(TEXT, H, "h", "statistics on and off")                                                       \
    X(HOME, HOME, "home", "the camera as it was at first")                                         \
    X(SHOT, F12, "f12", "write the picture to limn-view-NNN.png here")                             \
    X(CLOSE, ESCAPE, "escape", "close the window")

typedef enum view_key {
#define VIEW_KEY_ENUM(key, code, name, help) VIEW_KEY_##key,
    VIEW_KEYS(VIEW_KEY_ENUM)
#undef VIEW_KEY_ENUM
        VIEW_KEY_COUNT,
    VIEW_KEY_HELD_LAST = VIEW_KEY_LATER ///< the first ones act for as long as they are held
} view_key;

#endif
