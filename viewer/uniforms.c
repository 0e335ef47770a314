/* SPDX-License-Identifier: MIT */
#include "uniforms.h"

void view_uniforms_use(const view_gl *gl, GLuint program, const view_frame *frame) {
    gl->UseProgram(program);
    // A uniform that a program does not have is at -1, where setting it does nothing.
    view_uniforms_place(gl, program, frame, NULL);
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, "projection"), 1, GL_FALSE,
                         frame->camera.projection);
    gl->Uniform2f(gl->GetUniformLocation(program, "viewport"), (float)frame->width,
                  (float)frame->height);
    gl->Uniform1f(gl->GetUniformLocation(program, "pixel_scale"), frame->pixel_scale);
    gl->Uniform1f(gl->GetUniformLocation(program, "colours"), (float)frame->colours);
}

static void multiply(const float a[16], const float b[16], float out[16]) {
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            float sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
    }
}

void view_uniforms_place(const view_gl *gl, GLuint program, const view_frame *frame,
                         const float *place) {
    float placed[16];
    if (place) multiply(frame->camera.view, place, placed);
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, "view"), 1, GL_FALSE,
                         place ? placed : frame->camera.view);
}
