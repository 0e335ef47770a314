/* SPDX-License-Identifier: MIT */
#include "gl.h"

#include "report.h"
#include <string.h>

/// A function may be found by its name and yet not work: what counts is what the driver claims.
static bool has_newer(const view_gl *gl, int version, const char *extension) {
    GLint major = 0, minor = 0, count = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    if (10 * major + minor >= version) return true;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++) {
        const char *const name = (const char *)gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
        if (name && strcmp(name, extension) == 0) return true;
    }
    return false;
}

bool view_gl_load(view_gl *gl, view_gl_find_fn *find) {
#define LOAD(type, name)                                                                           \
    gl->name = (PFNGL##type##PROC)find("gl" #name);                                                \
    if (!gl->name) return view_fail("this OpenGL has no function gl" #name);
    VIEW_GL_FUNCTIONS(LOAD)
#undef LOAD
#define LOAD_NEWER(type, name, version, extension)                                                 \
    gl->name = has_newer(gl, version, extension) ? (PFNGL##type##PROC)find("gl" #name) : NULL;
    VIEW_GL_NEWER_FUNCTIONS(LOAD_NEWER)
#undef LOAD_NEWER
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
