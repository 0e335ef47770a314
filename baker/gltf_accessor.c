/* SPDX-License-Identifier: MIT */
/* Everything that a document says about its bytes is checked here before they are read. */
#include "gltf_reader.h"

#include "mesh.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/// Elements of an accessor without bytes of its own, at most: they cost nothing in the file.
enum { ZEROS_MAX = 1 << 20 };

/// An accessor at work.
typedef struct reading {
    const limni_gltf_reader *reader;
    const limni_gltf_accessor *accessor;
    uint32_t index;
    const char *what;
} reading;

LIMNI_PRINTF(2, 3)
static limn_bake_status refuse(const reading *r, const char *format, ...) {
    char text[256];
    limni_label label;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return limni_fail(
        r->reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s (%s): %s", r->reader->document->path,
        limni_label_make(label, "accessor", r->index, r->accessor->name), r->what, text);
}

/// The bytes of a buffer view.
static limn_bake_status find_view(const reading *r, int index, const limni_gltf_view **view,
                                  const unsigned char **bytes) {
    const limni_gltf *const document = r->reader->document;
    if (index < 0 || (uint32_t)index >= document->view_count)
        return refuse(r, "there is no buffer view %d", index);
    *view = &document->views[index];
    if ((*view)->buffer < 0 || (uint32_t)(*view)->buffer >= document->buffer_count)
        return refuse(r, "buffer view %d: there is no buffer %d", index, (*view)->buffer);
    const limni_gltf_buffer *const buffer = &document->buffers[(*view)->buffer];
    if ((*view)->offset > buffer->size || (*view)->size > buffer->size - (*view)->offset)
        return refuse(r, "buffer view %d reaches beyond buffer %d, which has %" PRIu64 " bytes",
                      index, (*view)->buffer, buffer->size);
    *bytes = buffer->bytes + (*view)->offset;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_find_accessor(const limni_gltf_reader *reader, int index,
                                          const char *what, const limni_gltf_accessor **accessor) {
    const limni_gltf *const document = reader->document;
    if (index < 0 || (uint32_t)index >= document->accessor_count)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: %s: there is no accessor %d",
                          document->path, what, index);
    const limni_gltf_accessor *const found = *accessor = &document->accessors[index];
    const reading r = {reader, found, (uint32_t)index, what};
    const limni_gltf_view *view = NULL;
    const unsigned char *bytes;
    if (found->view >= 0) LIMNI_TRY(find_view(&r, found->view, &view, &bytes));
    if (found->count > (view ? view->size : ZEROS_MAX))
        return refuse(&r, "%" PRIu64 " elements are more than it has bytes", found->count);
    return LIMN_BAKE_OK;
}

static uint32_t component_size(int type) {
    switch (type) {
    case LIMNI_GLTF_BYTE:
    case LIMNI_GLTF_UBYTE:
        return 1;
    case LIMNI_GLTF_SHORT:
    case LIMNI_GLTF_USHORT:
        return 2;
    case LIMNI_GLTF_UINT:
    case LIMNI_GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

/// Bytes of `count` elements in a buffer view, `stride` from each to the next.
typedef struct span {
    const unsigned char *bytes;
    uint32_t stride;
} span;

static limn_bake_status find_span(const reading *r, int view_index, uint64_t offset, uint64_t count,
                                  uint32_t element_size, span *found) {
    const limni_gltf_view *view = NULL;
    LIMNI_TRY(find_view(r, view_index, &view, &found->bytes));
    found->stride = view->stride ? view->stride : element_size;
    if (found->stride < element_size)
        return refuse(r, "buffer view %d has a stride of %u bytes, but an element has %u",
                      view_index, found->stride, element_size);
    if (count == 0) return LIMN_BAKE_OK;
    if (offset > view->size || element_size > view->size - offset ||
        count - 1 > (view->size - offset - element_size) / found->stride)
        return refuse(r,
                      "%" PRIu64 " elements from byte %" PRIu64
                      " on reach beyond buffer view %d, which has %" PRIu64 " bytes",
                      count, offset, view_index, view->size);
    found->bytes += offset;
    return LIMN_BAKE_OK;
}

static uint32_t unsigned_at(const unsigned char *bytes, int type) {
    uint16_t narrow;
    uint32_t wide;
    switch (type) {
    case LIMNI_GLTF_UBYTE:
        return *bytes;
    case LIMNI_GLTF_USHORT:
        memcpy(&narrow, bytes, sizeof narrow);
        return narrow;
    default:
        memcpy(&wide, bytes, sizeof wide);
        return wide;
    }
}

static float float_at(const unsigned char *bytes, int type, bool normalised) {
    float value;
    int8_t byte;
    int16_t word;
    switch (type) {
    case LIMNI_GLTF_BYTE:
        memcpy(&byte, bytes, sizeof byte);
        return normalised ? fmaxf((float)byte / 127, -1) : (float)byte;
    case LIMNI_GLTF_SHORT:
        memcpy(&word, bytes, sizeof word);
        return normalised ? fmaxf((float)word / 32767, -1) : (float)word;
    case LIMNI_GLTF_UBYTE:
        return (float)*bytes / (normalised ? 255 : 1);
    case LIMNI_GLTF_USHORT:
        return (float)unsigned_at(bytes, type) / (normalised ? 65535 : 1);
    default:
        memcpy(&value, bytes, sizeof value);
        return value;
    }
}

/// One element to another place, as floats or as unsigned integers, four bytes each.
typedef void convert_fn(const reading *r, const unsigned char *bytes, void *out);

static void convert_floats(const reading *r, const unsigned char *bytes, void *out) {
    const limni_gltf_accessor *const a = r->accessor;
    for (uint32_t c = 0; c < a->component_count; c++)
        ((float *)out)[c] = float_at(bytes + c * component_size(a->component_type),
                                     a->component_type, a->normalised);
}

static void convert_integers(const reading *r, const unsigned char *bytes, void *out) {
    const limni_gltf_accessor *const a = r->accessor;
    for (uint32_t c = 0; c < a->component_count; c++)
        ((uint32_t *)out)[c] =
            unsigned_at(bytes + c * component_size(a->component_type), a->component_type);
}

/// Replaces some of the elements.
static limn_bake_status read_sparse(const reading *r, convert_fn *convert, void *out) {
    const limni_gltf_accessor *const a = r->accessor;
    const uint32_t element_size = a->component_count * component_size(a->component_type);
    const int type = a->sparse_index_type;
    if (type != LIMNI_GLTF_UBYTE && type != LIMNI_GLTF_USHORT && type != LIMNI_GLTF_UINT)
        return refuse(r, "its sparse indices have component type %d", type);
    if (a->sparse_count > a->count)
        return refuse(r, "%" PRIu64 " sparse elements of %" PRIu64, a->sparse_count, a->count);
    span indices, values;
    LIMNI_TRY(find_span(r, a->sparse_index_view, a->sparse_index_offset, a->sparse_count,
                        component_size(type), &indices));
    LIMNI_TRY(find_span(r, a->sparse_value_view, a->sparse_value_offset, a->sparse_count,
                        element_size, &values));
    uint64_t next = 0;
    for (uint64_t s = 0; s < a->sparse_count; s++) {
        const uint32_t at = unsigned_at(indices.bytes + s * indices.stride, type);
        if (at < next || at >= a->count)
            return refuse(r, "sparse index %" PRIu64 " is %u, of %" PRIu64 " elements", s, at,
                          a->count);
        next = at + UINT64_C(1);
        convert(r, values.bytes + s * values.stride,
                (unsigned char *)out + (size_t)at * a->component_count * 4);
    }
    return LIMN_BAKE_OK;
}

static limn_bake_status read_elements(const reading *r, uint64_t count, uint32_t component_count,
                                      convert_fn *convert, void *out) {
    const limni_gltf_accessor *const a = r->accessor;
    const uint32_t element_size = component_count * component_size(a->component_type);
    if (a->component_count != component_count)
        return refuse(r, "it has %u components, but %u are needed", a->component_count,
                      component_count);
    if (a->count != count)
        return refuse(r, "it has %" PRIu64 " elements, but %" PRIu64 " are needed", a->count,
                      count);
    if (a->view < 0) {
        memset(out, 0, (size_t)count * component_count * 4);
    } else {
        span elements;
        LIMNI_TRY(find_span(r, a->view, a->offset, count, element_size, &elements));
        for (uint64_t e = 0; e < count; e++)
            convert(r, elements.bytes + e * elements.stride,
                    (unsigned char *)out + (size_t)e * component_count * 4);
    }
    return a->sparse_count ? read_sparse(r, convert, out) : LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_floats(const limni_gltf_reader *reader, int index,
                                        const char *what, uint64_t count, uint32_t component_count,
                                        float *out) {
    reading r = {.reader = reader, .index = (uint32_t)index, .what = what};
    LIMNI_TRY(limni_gltf_find_accessor(reader, index, what, &r.accessor));
    const int type = r.accessor->component_type;
    if (component_size(type) == 0 || type == LIMNI_GLTF_UINT)
        return refuse(&r, "component type %d is not that of floats or of small integers", type);
    LIMNI_TRY(read_elements(&r, count, component_count, convert_floats, out));
    for (uint64_t i = 0; i < count * component_count; i++) {
        if (!isfinite(out[i]))
            return refuse(&r, "element %" PRIu64 " is not finite", i / component_count);
    }
    return LIMN_BAKE_OK;
}

limn_bake_status limni_gltf_read_integers(const limni_gltf_reader *reader, int index,
                                          const char *what, uint64_t count,
                                          uint32_t component_count, uint32_t *out) {
    reading r = {.reader = reader, .index = (uint32_t)index, .what = what};
    LIMNI_TRY(limni_gltf_find_accessor(reader, index, what, &r.accessor));
    const int type = r.accessor->component_type;
    if (type != LIMNI_GLTF_UBYTE && type != LIMNI_GLTF_USHORT && type != LIMNI_GLTF_UINT)
        return refuse(&r, "component type %d is not that of unsigned integers", type);
    return read_elements(&r, count, component_count, convert_integers, out);
}
