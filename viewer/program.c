/* SPDX-License-Identifier: MIT */
#include "program.h"

#include "report.h"
#include <stddef.h>

enum { LOG_SIZE = 2048 };

static bool attach_stage(const view_gl *gl, GLuint program, GLenum stage, const char *source,
                         const view_program_sources *sources) {
    const char *const definitions = sources->definitions ? sources->definitions : "";
    const char *const parts[] = {"#version 330 core\n", definitions, source};
    const GLuint shader = gl->CreateShader(stage);
    gl->ShaderSource(shader, 3, parts, NULL);
    gl->CompileShader(shader);

    GLint compiled = GL_FALSE;
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) {
        gl->AttachShader(program, shader);
    } else {
        char log[LOG_SIZE] = "";
        gl->GetShaderInfoLog(shader, LOG_SIZE, NULL, log);
        view_fail("cannot compile the %s shader: %s", sources->name, log);
    }
    gl->DeleteShader(shader); // when the program goes
    return compiled;
}

static bool link_program(const view_gl *gl, GLuint program, const char *name) {
    gl->LinkProgram(program);
    GLint linked = GL_FALSE;
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) return true;
    char log[LOG_SIZE] = "";
    gl->GetProgramInfoLog(program, LOG_SIZE, NULL, log);
    return view_fail("cannot link the %s shaders: %s", name, log);
}

GLuint view_program_create(const view_gl *gl, const view_program_sources *sources) {
    const GLuint program = gl->CreateProgram();
    if (attach_stage(gl, program, GL_VERTEX_SHADER, sources->vertex, sources) &&
        (!sources->geometry ||
         attach_stage(gl, program, GL_GEOMETRY_SHADER, sources->geometry, sources)) &&
        attach_stage(gl, program, GL_FRAGMENT_SHADER, sources->fragment, sources) &&
        link_program(gl, program, sources->name)) {
        return program;
    }
    gl->DeleteProgram(program);
    return 0;
}
