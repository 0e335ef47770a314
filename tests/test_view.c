/* SPDX-License-Identifier: MIT */
/* Views: six planes, each of which alone keeps out what is just beyond it, and sizes on the screen. */
#include "limn/limn.h"

#include "check.h"

#include <math.h>

/// A camera by hand: right, up and forward are unit vectors, at right angles to one another.
static const float eye[3] = {3, -2, 5};
static const float right[3] = {0, 0.6f, 0.8f}, up[3] = {0, 0.8f, -0.6f}, forward[3] = {-1, 0, 0};
static const float target[3] = {1, -2, 5};
static const float any_up[3] = {-0.7f, 1.6f, -1.2f}; // 2 up + 0.7 forward

/// How many planes a point is outside of.
static int count_outside(const limn_view *view, float x, float y, float z) {
    int count = 0;
    for (uint32_t p = 0; p < view->plane_count; p++) {
        const float *const plane = view->planes[p];
        float side = plane[3];
        for (int axis = 0; axis < 3; axis++) {
            const float point = eye[axis] + x * right[axis] + y * up[axis] + z * forward[axis];
            side += plane[axis] * point;
        }
        count += side < 0;
    }
    return count;
}

/// Just inside and just outside of all bounds. `x` and `y` are half the width and the height of what
/// is seen at distance z.
static void check_bounds(const limn_view *view, float x, float y, float z, float near_plane,
                         float far_plane) {
    const float in = 0.999f, out = 1.001f;
    CHECK_EQUAL(view->plane_count, 6);
    CHECK(memcmp(view->eye, eye, sizeof eye) == 0);
    for (int sign = -1; sign <= 1; sign += 2) {
        const float s = (float)sign;
        CHECK_EQUAL(count_outside(view, s * x * in, 0, z), 0);
        CHECK_EQUAL(count_outside(view, s * x * out, 0, z), 1);
        CHECK_EQUAL(count_outside(view, 0, s * y * in, z), 0);
        CHECK_EQUAL(count_outside(view, 0, s * y * out, z), 1);
        CHECK_EQUAL(count_outside(view, s * x * in, s * y * in, z), 0);
        CHECK_EQUAL(count_outside(view, s * x * out, s * y * out, z), 2);
    }
    CHECK_EQUAL(count_outside(view, 0, 0, near_plane + 0.001f), 0);
    CHECK_EQUAL(count_outside(view, 0, 0, near_plane - 0.001f), 1);
    CHECK_EQUAL(count_outside(view, 0, 0, far_plane - 0.01f), 0);
    CHECK_EQUAL(count_outside(view, 0, 0, far_plane + 0.01f), 1);
}

static void test_perspective(void) {
    const float fov = 0.9f, half = tanf(fov / 2);
    const limn_view view = limn_view_perspective(eye, target, any_up, fov, 640, 480, 0.5f, 20);
    CHECK(!view.orthographic);
    CHECK_NEAR(view.pixels, 480 / (2 * half), 1e-3f);
    CHECK(view.nearest == 0.5f);
    check_bounds(&view, 4 * half * 640 / 480, 4 * half, 4, 0.5f, 20);
    check_bounds(&view, 15 * half * 640 / 480, 15 * half, 15, 0.5f, 20);
}

/// What is behind the eye may be seen, too.
static void test_orthographic(void) {
    const limn_view view = limn_view_orthographic(eye, target, any_up, 6, 640, 480, -2, 20);
    CHECK(view.orthographic);
    CHECK_NEAR(view.pixels, 80, 1e-3f);
    check_bounds(&view, 4, 3, -1, -2, 20);
    check_bounds(&view, 4, 3, 15, -2, 20);
}

int main(void) {
    test_perspective();
    test_orthographic();
    return check_report();
}
