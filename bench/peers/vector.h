/* SPDX-License-Identifier: MIT */
/* A vertex as four floats, one vector, for peers that are written in plain C. */
#ifndef VECTOR_H
#define VECTOR_H

#if defined(__GNUC__)
typedef float vector __attribute__((vector_size(16)));
#else
#error "these peers need vector extensions"
#endif

#if defined(__SSE2__)
#define VECTOR_ISA "sse2"
#elif defined(__ARM_NEON)
#define VECTOR_ISA "neon"
#else
#define VECTOR_ISA "scalar"
#endif

#endif
