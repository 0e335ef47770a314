/* SPDX-License-Identifier: MIT */
#include "window.h"

#include "motion.h"
#include "report.h"
#include "script.h"
#include "show.h"
#include "statistics.h"
#include "target.h"
#include "text.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { THREADS_MAX = 16 };

typedef struct window {
    GLFWwindow *glfw;
    view_gl gl;
    const view_picture *options;
    view_target target;
    view_text text;
    view_workers *workers;
    view_show *show;
    view_session session;
    view_statistics statistics;
    view_script script;
    bool scripted;
    double cursor[2];
    double last_time; ///< when the last frame began
    char *dropped;    ///< a path; NULL: none
} window;

// -------------------------------------------------------------------------------------------------
// Input

static const int key_codes[VIEW_KEY_COUNT] = {
#define CODE(key, code, name, help) [VIEW_KEY_##key] = GLFW_KEY_##code,
    VIEW_KEYS(CODE)
#undef CODE
};

static void on_key(GLFWwindow *glfw, int code, int scan_code, int action, int modifiers) {
    (void)scan_code;
    (void)modifiers;
    window *const self = glfwGetWindowUserPointer(glfw);
    if (action == GLFW_RELEASE) return;
    for (int key = VIEW_KEY_HELD_LAST + 1; key < VIEW_KEY_COUNT; key++) {
        if (key_codes[key] == code) view_session_press(&self->session, (view_key)key, 0);
    }
}

static void on_cursor(GLFWwindow *glfw, double x, double y) {
    static const float radians = 0.006f; // per pixel
    window *const self = glfwGetWindowUserPointer(glfw);
    limni_camera *const camera = &self->session.camera;
    const float right = (float)(x - self->cursor[0]), down = (float)(y - self->cursor[1]);
    self->cursor[0] = x;
    self->cursor[1] = y;
    if (glfwGetMouseButton(glfw, GLFW_MOUSE_BUTTON_LEFT)) {
        view_motion_orbit(camera, -radians * right, radians * down);
    } else if (glfwGetMouseButton(glfw, GLFW_MOUSE_BUTTON_RIGHT)) {
        view_motion_look(camera, radians * right / 2, -radians * down / 2);
    } else if (glfwGetMouseButton(glfw, GLFW_MOUSE_BUTTON_MIDDLE)) {
        int width, height;
        glfwGetWindowSize(glfw, &width, &height);
        const float pixel = 2 * tanf(camera->fov / 2) / (float)height;
        const float step = pixel * view_motion_distance(camera);
        view_motion_fly(camera, (const float[3]){-step * right, step * down, 0});
    }
}

static void on_scroll(GLFWwindow *glfw, double x, double y) {
    (void)x;
    window *const self = glfwGetWindowUserPointer(glfw);
    view_motion_zoom(&self->session.camera, (float)pow(0.9, y));
}

static void drop(window *self, const char *path) {
    free(self->dropped);
    self->dropped = strdup(path);
}

static void on_drop(GLFWwindow *glfw, int count, const char **paths) {
    window *const self = glfwGetWindowUserPointer(glfw);
    if (count > 0) drop(self, paths[0]);
}

static void name_file(view_statistics *statistics, const char *path) {
    const char *const slash = strrchr(path, '/');
    snprintf(statistics->name, sizeof statistics->name, "%s", slash ? slash + 1 : path);
}

/// Opens what was dropped; if that fails, what is shown stays.
static void take_dropped(window *self) {
    if (!self->dropped) return;
    view_picture options = *self->options;
    options.frame.clip = NULL;
    options.frame.time = 0;
    options.mesh_index = VIEW_ALL_MESHES;
    view_show *const show = view_show_open(&self->gl, self->workers, self->dropped, &options);
    const double aspect = (double)self->target.width / self->target.height;
    if (show && view_session_restart(&self->session, &show->scene, aspect)) {
        view_show_close(self->show);
        self->show = show;
        name_file(&self->statistics, self->dropped);
    } else {
        view_show_close(show);
    }
    free(self->dropped);
    self->dropped = NULL;
}

static void follow_script(window *self, float step) {
    const view_script_event event = view_script_next(&self->script);
    if (event.is_key) view_session_press(&self->session, event.key, step);
    if (*event.dropped) drop(self, event.dropped);
}

static void press_held(window *self, float step) {
    for (int key = 0; key <= VIEW_KEY_HELD_LAST; key++) {
        if (glfwGetKey(self->glfw, key_codes[key]) == GLFW_PRESS)
            view_session_press(&self->session, (view_key)key, step);
    }
}

/// Takes in what was pressed, and lets time pass. Returns the seconds since the last frame.
static double take_input(window *self) {
    static const double scripted_step = 1.0 / 60, longest_step = 0.1;
    const double now = glfwGetTime(), real_step = now - self->last_time;
    const float step = (float)(self->scripted ? scripted_step : fmin(real_step, longest_step));
    self->last_time = now;
    glfwPollEvents();
    if (self->scripted) {
        follow_script(self, step);
    } else {
        press_held(self, step);
    }
    take_dropped(self);
    view_session_advance(&self->session, step);
    return real_step;
}

// -------------------------------------------------------------------------------------------------
// Output

static bool has_size(window *self) {
    int width, height;
    glfwGetFramebufferSize(self->glfw, &width, &height);
    return width > 0 && height > 0 && !glfwGetWindowAttrib(self->glfw, GLFW_ICONIFIED);
}

/// Makes the target as large as the window. False if that failed.
static bool fit_target(window *self) {
    int width, height;
    glfwGetFramebufferSize(self->glfw, &width, &height);
    const uint32_t new_width = (uint32_t)width, new_height = (uint32_t)height;
    if (self->target.width == new_width && self->target.height == new_height) return true;
    view_target_destroy(&self->target);
    return view_target_create(&self->target, &self->gl, new_width, new_height, false);
}

/// Writes the picture to the first free name in the current folder.
static void shoot(window *self) {
    char path[32];
    int number = 1;
    do {
        snprintf(path, sizeof path, "limn-view-%03d.png", number++);
    } while (access(path, F_OK) == 0);
    view_image image = {0};
    if (view_target_read(&self->target, &image) && view_image_write_png(&image, path))
        printf("%s\n", path);
    view_image_free(&image);
    self->session.shooting = false;
}

static bool draw_text(window *self) {
    char lines[1024];
    const uint32_t width = self->target.width, height = self->target.height;
    view_statistics_write(&self->statistics, &self->session, &self->show->game, lines,
                          sizeof lines);
    return view_text_draw(&self->text, lines, width, height, width >= 960 ? 2 : 1);
}

static bool draw_frame(window *self, double seconds) {
    const uint32_t width = self->target.width, height = self->target.height;
    view_target_bind(&self->target);
    view_moment moment = view_session_moment(&self->session, width, height);
    moment.frame.pixel_scale = view_line_scale(width, height);
    if (!view_game_frame(&self->show->game, self->show->renderer, &moment)) return false;
    view_statistics_add(&self->statistics, &self->show->game, seconds);
    if (self->session.text && !draw_text(self)) return false;
    if (self->session.shooting) shoot(self);
    view_target_show(&self->target);
    glfwSwapBuffers(self->glfw);
    return true;
}

static bool loop(window *self) {
    self->last_time = glfwGetTime();
    for (;;) {
        const double seconds = take_input(self);
        if (self->session.closing || glfwWindowShouldClose(self->glfw)) return true;
        if (!has_size(self)) {
            glfwWaitEvents();
        } else if (!fit_target(self) || !draw_frame(self, seconds)) {
            return false;
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Opening and closing

static void on_error(int code, const char *text) {
    view_fail("window: %s (0x%x)", text, (unsigned)code);
}

static bool open_glfw(window *self) {
    glfwSetErrorCallback(on_error);
    if (!glfwInit()) return false;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    const view_picture *const options = self->options;
    self->glfw =
        glfwCreateWindow((int)options->width, (int)options->height, "limn-view", NULL, NULL);
    if (!self->glfw) return false;
    glfwMakeContextCurrent(self->glfw);
    glfwSwapInterval(self->scripted ? 0 : 1);
    glfwSetWindowUserPointer(self->glfw, self);
    glfwGetCursorPos(self->glfw, &self->cursor[0], &self->cursor[1]);
    glfwSetKeyCallback(self->glfw, on_key);
    glfwSetCursorPosCallback(self->glfw, on_cursor);
    glfwSetScrollCallback(self->glfw, on_scroll);
    glfwSetDropCallback(self->glfw, on_drop);
    return true;
}

static bool open_workers(window *self) {
    const long processor_count = sysconf(_SC_NPROCESSORS_ONLN);
    const long count = processor_count < THREADS_MAX ? processor_count : THREADS_MAX;
    self->statistics.thread_count = count > 0 ? (uint32_t)count : 1;
    self->workers = view_workers_create(self->statistics.thread_count);
    return self->workers || view_fail("no threads can be started");
}

static bool open_window(window *self) {
    if (!open_glfw(self) || !view_gl_load(&self->gl, glfwGetProcAddress)) return false;
    view_statistics *const statistics = &self->statistics;
    name_file(statistics, self->options->limn_path);
    statistics->persistent = self->gl.BufferStorage;
    statistics->indirect = self->gl.MultiDrawElementsIndirect;
    if (!open_workers(self) || !view_text_create(&self->text, &self->gl) || !fit_target(self))
        return false;
    self->show = view_show_open(&self->gl, self->workers, self->options->limn_path, self->options);
    return self->show && view_session_start(&self->session, &self->show->scene, self->options);
}

static void close_window(window *self) {
    view_show_close(self->show);
    view_text_destroy(&self->text);
    view_target_destroy(&self->target);
    view_workers_destroy(self->workers);
    free(self->dropped);
    glfwTerminate();
}

bool view_window_run(const view_picture *options, const char *keys) {
    window self = {.options = options, .scripted = keys, .script.rest = keys};
    const bool good = open_window(&self) && loop(&self);
    close_window(&self);
    return good;
}
