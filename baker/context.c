/* SPDX-License-Identifier: MIT */
#include "context.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

/// In front of every allocation: as large as the alignment, so that what follows is aligned too.
/// Not aligned_alloc(), which takes several times as long for the many small ones.
struct limni_block {
    limni_block *next;
    limni_block **link; ///< what points here
    void *memory;       ///< that it lies in
    size_t size;
    unsigned char padding[ALIGNMENT - 4 * sizeof(void *)];
};

_Static_assert(sizeof(limni_block) == ALIGNMENT, "block header");

static limni_block *block_of(void *memory) {
    return (limni_block *)memory - 1;
}

static void link_block(limni_context *context, limni_block *block) {
    block->next = context->blocks;
    block->link = &context->blocks;
    if (block->next) block->next->link = &block->next;
    context->blocks = block;
}

static void unlink_block(limni_block *block) {
    *block->link = block->next;
    if (block->next) block->next->link = block->link;
}

void *limni_allocate(limni_context *context, size_t count, size_t size) {
    const size_t limit = SIZE_MAX / 2;
    void *memory = NULL;
    if (size == 0 || count <= limit / size)
        memory = malloc(ALIGNMENT - 1 + sizeof(limni_block) + count * size);
    if (!memory) {
        limni_fail(context, LIMN_BAKE_MEMORY, "out of memory: no room for %zu items of %zu bytes",
                   count, size);
        return NULL;
    }
    limni_block *const block =
        (void *)(((uintptr_t)memory + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT);
    block->memory = memory;
    block->size = count * size;
    link_block(context, block);
    return block + 1;
}

void *limni_allocate_zeroed(limni_context *context, size_t count, size_t size) {
    void *const memory = limni_allocate(context, count, size);
    if (memory) memset(memory, 0, count * size);
    return memory;
}

void *limni_resize(limni_context *context, void *memory, size_t count, size_t size) {
    void *const moved = limni_allocate(context, count, size);
    if (!moved || !memory) return moved;
    const size_t old_size = block_of(memory)->size, new_size = count * size;
    memcpy(moved, memory, old_size < new_size ? old_size : new_size);
    limni_release(context, memory);
    return moved;
}

void limni_release(limni_context *context, void *memory) {
    (void)context;
    if (!memory) return;
    limni_block *const block = block_of(memory);
    unlink_block(block);
    free(block->memory);
}

void limni_release_all(limni_context *context) {
    while (context->blocks)
        limni_release(context, context->blocks + 1);
}

/// Words may be a file's own: none shall move the cursor of a terminal.
static void make_printable(char *text) {
    for (; *text; text++) {
        if ((unsigned char)*text < ' ' || *text == 0x7f) *text = ' ';
    }
}

limn_bake_status limni_fail(limni_context *context, limn_bake_status status, const char *format,
                            ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(context->error, sizeof context->error, format, arguments);
    va_end(arguments);
    make_printable(context->error);
    return status;
}

void limni_note(limni_context *context, const char *format, ...) {
    if (!context->desc.note) return;
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    make_printable(text);
    context->desc.note(context->desc.user, text);
}

void limni_progress(limni_context *context, const char *step, uint32_t done, uint32_t total) {
    if (context->desc.progress) context->desc.progress(context->desc.user, step, done, total);
}
