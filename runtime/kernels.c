/* SPDX-License-Identifier: MIT */
#include "kernels.h"
#include "require.h"

/// Worst first.
static const limn_kernels *const tables[] = {
    &limni_kernels_scalar,
#if defined(__SSE2__)
    &limni_kernels_sse2,
#endif
};

enum { TABLE_COUNT = sizeof tables / sizeof *tables };

uint32_t limn_isa_supported(void) {
    uint32_t mask = 0;
    for (int t = 0; t < TABLE_COUNT; t++)
        mask |= tables[t]->isa;
    return mask;
}

const limn_kernels *limn_kernels_select(uint32_t isa_mask) {
    const uint32_t usable = isa_mask & limn_isa_supported();
    for (int t = TABLE_COUNT - 1; t > 0; t--) {
        if (usable & tables[t]->isa) return tables[t];
    }
    return tables[0];
}

const char *limn_kernels_name(const limn_kernels *kernels) {
    LIMNI_REQUIRE(kernels, "");
    return kernels->name;
}
