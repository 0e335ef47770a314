/* SPDX-License-Identifier: MIT */
/*
 * The OpenGL functions that the viewer uses, loaded by name: the program links no OpenGL library,
 * because libGL before OSMesa on the linker's command line makes every call return zero.
 */
#ifndef VIEW_GL_H
#define VIEW_GL_H

#include <GL/glcorearb.h>
#include <stdbool.h>

/// Type and name of each function: X(CLEAR, Clear) is PFNGLCLEARPROC Clear for glClear.
#define VIEW_GL_FUNCTIONS(X)                                                                       \
    X(ACTIVETEXTURE, ActiveTexture)                                                                \
    X(ATTACHSHADER, AttachShader)                                                                  \
    X(BINDBUFFER, BindBuffer)                                                                      \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                            \
    X(BINDRENDERBUFFER, BindRenderbuffer)                                                          \
    X(BINDTEXTURE, BindTexture)                                                                    \
    X(BINDVERTEXARRAY, BindVertexArray)                                                            \
    X(BLENDFUNC, BlendFunc)                                                                        \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                                                            \
    X(BUFFERDATA, BufferData)                                                                      \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                              \
    X(CLEAR, Clear)                                                                                \
    X(CLIENTWAITSYNC, ClientWaitSync)                                                              \
    X(COMPILESHADER, CompileShader)                                                                \
    X(CREATEPROGRAM, CreateProgram)                                                                \
    X(CREATESHADER, CreateShader)                                                                  \
    X(DELETEBUFFERS, DeleteBuffers)                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                      \
    X(DELETEPROGRAM, DeleteProgram)                                                                \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                    \
    X(DELETESHADER, DeleteShader)                                                                  \
    X(DELETETEXTURES, DeleteTextures)                                                              \
    X(DELETESYNC, DeleteSync)                                                                      \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                      \
    X(DEPTHFUNC, DepthFunc)                                                                        \
    X(DEPTHMASK, DepthMask)                                                                        \
    X(DISABLE, Disable)                                                                            \
    X(DRAWARRAYS, DrawArrays)                                                                      \
    X(DRAWELEMENTS, DrawElements)                                                                  \
    X(ENABLE, Enable)                                                                              \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                            \
    X(FENCESYNC, FenceSync)                                                                        \
    X(FINISH, Finish)                                                                              \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                            \
    X(GENBUFFERS, GenBuffers)                                                                      \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                            \
    X(GENERATEMIPMAP, GenerateMipmap)                                                              \
    X(GENRENDERBUFFERS, GenRenderbuffers)                                                          \
    X(GENTEXTURES, GenTextures)                                                                    \
    X(GENVERTEXARRAYS, GenVertexArrays)                                                            \
    X(GETERROR, GetError)                                                                          \
    X(GETINTEGERV, GetIntegerv)                                                                    \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                  \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                          \
    X(GETSHADERIV, GetShaderiv)                                                                    \
    X(GETSTRINGI, GetStringi)                                                                      \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                      \
    X(LINKPROGRAM, LinkProgram)                                                                    \
    X(MAPBUFFERRANGE, MapBufferRange)                                                              \
    X(MULTIDRAWELEMENTSBASEVERTEX, MultiDrawElementsBaseVertex)                                    \
    X(PIXELSTOREI, PixelStorei)                                                                    \
    X(READPIXELS, ReadPixels)                                                                      \
    X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample)                              \
    X(SHADERSOURCE, ShaderSource)                                                                  \
    X(TEXIMAGE3D, TexImage3D)                                                                      \
    X(TEXPARAMETERI, TexParameteri)                                                                \
    X(UNIFORM1F, Uniform1f)                                                                        \
    X(UNIFORM2F, Uniform2f)                                                                        \
    X(UNIFORM4F, Uniform4f)                                                                        \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                          \
    X(UNMAPBUFFER, UnmapBuffer)                                                                    \
    X(USEPROGRAM, UseProgram)                                                                      \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                    \
    X(VIEWPORT, Viewport)

/// Functions that OpenGL 3.3 does not have, each from a version (44 is 4.4) or by an extension.
#define VIEW_GL_NEWER_FUNCTIONS(X)                                                                 \
    X(BUFFERSTORAGE, BufferStorage, 44, "GL_ARB_buffer_storage")                                   \
    X(MULTIDRAWELEMENTSINDIRECT, MultiDrawElementsIndirect, 43, "GL_ARB_multi_draw_indirect")

typedef struct view_gl {
#define VIEW_GL_MEMBER(type, name) PFNGL##type##PROC name;
#define VIEW_GL_NEWER_MEMBER(type, name, version, extension) PFNGL##type##PROC name;
    VIEW_GL_FUNCTIONS(VIEW_GL_MEMBER)
    // NULL where the driver does not have them:
    VIEW_GL_NEWER_FUNCTIONS(VIEW_GL_NEWER_MEMBER)
#undef VIEW_GL_MEMBER
#undef VIEW_GL_NEWER_MEMBER
} view_gl;

/// Any OpenGL function; the caller casts it to its type.
typedef void (*view_gl_fn)(void);

/// The OpenGL function `name` ("glClear") of the current context, or NULL if there is none.
typedef view_gl_fn view_gl_find_fn(const char *name);

/// Loads all functions of the current context; reports the first one that is missing.
bool view_gl_load(view_gl *gl, view_gl_find_fn *find);

/// Reports the oldest OpenGL error since the last call, with what was being done; true if none.
bool view_gl_check(const view_gl *gl, const char *action);

#endif
