/* SPDX-License-Identifier: MIT */
/*
 * What every step of the baker shares: memory that is freed as a whole, the error text, notes and
 * progress. A step that fails records why with limni_fail() and returns the status; callers hand it
 * up with LIMNI_TRY.
 */
#ifndef LIMNI_CONTEXT_H
#define LIMNI_CONTEXT_H

#include "../runtime/rounding.h"

#include "limn/bake.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LIMNI_TRY(call)                                                                            \
    do {                                                                                           \
        const limn_bake_status try_status = (call);                                                \
        if (try_status != LIMN_BAKE_OK) return try_status;                                         \
    } while (0)

#if defined(__GNUC__)
#define LIMNI_PRINTF(format_index, first_index)                                                    \
    __attribute__((format(printf, format_index, first_index)))
#else
#define LIMNI_PRINTF(format_index, first_index)
#endif

typedef struct limni_block limni_block;

typedef struct limni_context {
    limn_bake_desc desc;
    limni_block *blocks; ///< every live allocation
    char error[1024];
} limni_context;

/// Uninitialised room for `count` items of `size` bytes, aligned to 64 bytes; at least one byte.
/// NULL when out of memory (also when count * size overflows); the error text is then set.
void *limni_allocate(limni_context *context, size_t count, size_t size);

/// The same, zeroed.
void *limni_allocate_zeroed(limni_context *context, size_t count, size_t size);

/// Makes room for `count` items, keeping the contents; `memory` may be NULL. On failure NULL, and
/// `memory` stays valid.
void *limni_resize(limni_context *context, void *memory, size_t count, size_t size);

/// Frees one allocation early; NULL is fine. The rest is freed by limni_release_all().
void limni_release(limni_context *context, void *memory);
void limni_release_all(limni_context *context);

/// Records the error text and returns `status`.
limn_bake_status limni_fail(limni_context *context, limn_bake_status status, const char *format,
                            ...) LIMNI_PRINTF(3, 4);

/// Tells the user something that is not an error.
void limni_note(limni_context *context, const char *format, ...) LIMNI_PRINTF(2, 3);

void limni_progress(limni_context *context, const char *step, uint32_t done, uint32_t total);

#ifdef __cplusplus
}
#endif

#endif
