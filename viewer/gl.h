/* SPDX-License-Identifier: MIT */
/*
 * The OpenGL functions that the viewer uses, loaded by name: the program links no OpenGL library,
 * because libGL before OSMesa on the linker's command line makes every call return zero.
 */
#ifndef VIEW_GL_H
#define VIEW_GL_H

#include "context.h"
#include <GL/glcorearb.h>
#include <stdbool.h>

/// Type and name of each function: X(CLEAR, Clear) is PFNGLCLEARPROC Clear for glClear.
#define VIEW_GL_FUNCTIONS(X)                                                                       \
    X(ATTACHSHADER, AttachShader)                                                                  \
    X(BINDBUFFER, BindBuffer)                                                                      \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                            \
    X(BINDRENDERBUFFER, BindRenderbuffer)                                                          \
    X(BINDVERTEXARRAY, BindVertexArray)                                                            \
    X(BLENDFUNC, BlendFunc)                                                                        \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                                                            \
    X(BUFFERDATA, BufferData)                                                                      \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                              \
    X(CLEAR, Clear)                                                                                \
    X(COMPILESHADER, CompileShader)                                                                \
    X(CREATEPROGRAM, CreateProgram)                                                                \
    X(CREATESHADER, CreateShader)                                                                  \
    X(DELETEBUFFERS, DeleteBuffers)                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                      \
    X(DELETEPROGRAM, DeleteProgram)                                                                \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                    \
    X(DELETESHADER, DeleteShader)                                                                  \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                      \
    X(DEPTHFUNC, DepthFunc)                                                                        \
    X(DEPTHMASK, DepthMask)                                                                        \
    X(DISABLE, Disable)                                                                            \
    X(DRAWARRAYS, DrawArrays)                                                                      \
    X(DRAWELEMENTS, DrawElements)                                                                  \
    X(ENABLE, Enable)                                                                              \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                            \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                            \
    X(GENBUFFERS, GenBuffers)                                                                      \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                            \
    X(GENRENDERBUFFERS, GenRenderbuffers)                                                          \
    X(GENVERTEXARRAYS, GenVertexArrays)                                                            \
    X(GETERROR, GetError)                                                                          \
    X(GETINTEGERV, GetIntegerv)                                                                    \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                  \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                          \
    X(GETSHADERIV, GetShaderiv)                                                                    \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                      \
    X(LINKPROGRAM, LinkProgram)                                                                    \
    X(MULTIDRAWELEMENTSBASEVERTEX, MultiDrawElementsBaseVertex)                                    \
    X(PIXELSTOREI, PixelStorei)                                                                    \
    X(READPIXELS, ReadPixels)                                                                      \
    X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample)                              \
    X(SHADERSOURCE, ShaderSource)                                                                  \
    X(UNIFORM1F, Uniform1f)                                                                        \
    X(UNIFORM2F, Uniform2f)                                                                        \
    X(UNIFORM4F, Uniform4f)                                                                        \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                          \
    X(USEPROGRAM, UseProgram)                                                                      \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                    \
    X(VIEWPORT, Viewport)

typedef struct view_gl {
#define VIEW_GL_MEMBER(type, name) PFNGL##type##PROC name;
    VIEW_GL_FUNCTIONS(VIEW_GL_MEMBER)
#undef VIEW_GL_MEMBER
} view_gl;

/// Loads all functions of the current context; reports the first one that is missing.
bool view_gl_load(view_gl *gl, const view_context *context);

/// Reports the oldest OpenGL error since the last call, with what was being done; true if none.
bool view_gl_check(const view_gl *gl, const char *action);

#endif
