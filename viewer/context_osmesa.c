/* SPDX-License-Identifier: MIT */
/* Software rendering without a window system. */
#include "context.h"

#include "report.h"
#include <GL/osmesa.h>
#include <stdint.h>
#include <stdlib.h>

struct view_context {
    OSMesaContext mesa;
    uint32_t pixel; ///< OSMesa wants a window to draw into: this is all of it
};

view_context *view_context_create(void) {
    static const int attributes[] = {
        OSMESA_FORMAT,
        OSMESA_RGBA,
        OSMESA_PROFILE,
        OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION,
        3,
        OSMESA_CONTEXT_MINOR_VERSION,
        3,
        0,
        0,
    };
    view_context *const context = calloc(1, sizeof *context);
    if (!context) {
        view_fail("out of memory");
        return NULL;
    }
    context->mesa = OSMesaCreateContextAttribs(attributes, NULL);
    if (!context->mesa) {
        view_fail("OSMesa has no OpenGL 3.3 core context");
        view_context_destroy(context);
        return NULL;
    }
    if (!OSMesaMakeCurrent(context->mesa, &context->pixel, GL_UNSIGNED_BYTE, 1, 1)) {
        view_fail("OSMesa cannot make its context current");
        view_context_destroy(context);
        return NULL;
    }
    return context;
}

view_gl_fn view_context_function(const char *name) {
    return (view_gl_fn)OSMesaGetProcAddress(name);
}

void view_context_destroy(view_context *context) {
    if (!context) return;
    OSMesaMakeCurrent(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
    if (context->mesa) OSMesaDestroyContext(context->mesa);
    free(context);
}
