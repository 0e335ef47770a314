/* SPDX-License-Identifier: MIT */
#include "mirror.h"

#include "limn/format.h"
#include "limn/limn.h"

enum { NO_IMAGE = 0xffff };

/// The coefficient that the image of `slot` must have in the image of `row`: the second tangent,
/// from one side of the mirror line to the other, changes its sign.
static limni_fixed mirrored(const limni_coefficients *c, uint32_t table, uint32_t row,
                            uint32_t slot) {
    const limni_fixed value = limni_coefficient(c, table, row, slot);
    return table == 2 ? -value : value;
}

/// Whether exchanging two slots, or keeping one, goes with exchanging all rows that lie inside.
static bool are_images(const limni_coefficients *c, uint32_t a, uint32_t b) {
    const limn_domain *const domain = limn_domain_get(LIMN_DOMAIN_TRIANGLE);
    for (uint32_t table = 0; table < c->table_count; table++) {
        for (uint32_t row = domain->corner_count; row < c->row_count; row++) {
            const uint32_t image = domain->rows[row].mirror;
            if (domain->rows[row].edges) continue;
            if (limni_coefficient(c, table, image, b) != mirrored(c, table, row, a)) return false;
        }
    }
    return true;
}

static uint32_t image_of(const limni_coefficients *c, const bool *used, const uint16_t *images,
                         uint32_t slot) {
    if (are_images(c, slot, slot)) return slot;
    for (uint32_t other = slot + 1; other < c->slot_count; other++) {
        if (used[other] && images[other] == NO_IMAGE && are_images(c, slot, other)) return other;
    }
    return NO_IMAGE;
}

uint32_t limni_find_mirror(const limni_coefficients *coefficients, const bool *used,
                           uint16_t *images) {
    uint32_t pair_count = 0, used_count = 0;
    for (uint32_t slot = 0; slot < coefficients->slot_count; slot++) {
        images[slot] = NO_IMAGE;
        used_count += used[slot];
    }
    if (used_count > LIMN_FORMAT_PAIRED_MAX) return 0;
    for (uint32_t slot = 0; slot < coefficients->slot_count; slot++) {
        if (!used[slot] || images[slot] != NO_IMAGE) continue;
        const uint32_t image = image_of(coefficients, used, images, slot);
        if (image == NO_IMAGE) return 0;
        images[slot] = (uint16_t)image;
        images[image] = (uint16_t)slot;
        pair_count += image != slot;
    }
    return images[0] == 0 && images[1] == 2 ? pair_count : 0;
}
