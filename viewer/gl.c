/* SPDX-License-Identifier: MIT */
#include "gl.h"

#include "report.h"

bool view_gl_load(view_gl *gl, const view_context *context) {
#define LOAD(type, name)                                                                           \
    gl->name = (PFNGL##type##PROC)view_context_function(context, "gl" #name);                      \
    if (!gl->name) return view_fail("this OpenGL has no function gl" #name);
    VIEW_GL_FUNCTIONS(LOAD)
#undef LOAD
    return true;
}

static const char *error_text(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM:
        return "invalid enumerant";
    case GL_INVALID_VALUE:
        return "invalid value";
    case GL_INVALID_OPERATION:
        return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
        return "out of memory";
    default:
        return "unknown error";
    }
}

bool view_gl_check(const view_gl *gl, const char *action) {
    const GLenum error = gl->GetError();
    if (error == GL_NO_ERROR) return true;
    return view_fail("OpenGL: %s (0x%04x) while %s", error_text(error), error, action);
}
