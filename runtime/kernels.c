/* SPDX-License-Identifier: MIT */
#include "kernels.h"

#include "cpu.h"
#include "require.h"

/// Worst first; of one instruction set, the reproducible ones first.
static const limn_kernels *const tables[] = {
    &limni_kernels_scalar,
#ifdef LIMNI_WITH_SSE2
    &limni_kernels_sse2,
#endif
#ifdef LIMNI_WITH_AVX2
    &limni_kernels_avx2,   &limni_kernels_avx2_fast,
#endif
#ifdef LIMNI_WITH_NEON
    &limni_kernels_neon,   &limni_kernels_neon_fast,
#endif
};

enum { TABLE_COUNT = sizeof tables / sizeof *tables };

static bool can_run(const limn_kernels *kernels, const limni_cpu *cpu) {
    if (kernels->family == LIMN_FAMILY_FAST && !cpu->fused) return false;
    return kernels->isa & cpu->isas;
}

uint32_t limn_isa_supported(void) {
    const limni_cpu cpu = limni_cpu_detect();
    uint32_t mask = 0;
    for (int t = 0; t < TABLE_COUNT; t++) {
        if (can_run(tables[t], &cpu)) mask |= tables[t]->isa;
    }
    return mask;
}

const limn_kernels *limn_kernels_select(uint32_t isa_mask, limn_family family) {
    const limni_cpu cpu = limni_cpu_detect();
    for (int t = TABLE_COUNT - 1; t > 0; t--) {
        if (family == LIMN_FAMILY_REPRODUCIBLE && tables[t]->family != family) continue;
        if (tables[t]->isa & isa_mask && can_run(tables[t], &cpu)) return tables[t];
    }
    return tables[0];
}

const char *limn_kernels_name(const limn_kernels *kernels) {
    LIMNI_REQUIRE(kernels, "");
    return kernels->name;
}

limn_family limn_kernels_family(const limn_kernels *kernels) {
    LIMNI_REQUIRE(kernels, LIMN_FAMILY_REPRODUCIBLE);
    return kernels->family;
}
