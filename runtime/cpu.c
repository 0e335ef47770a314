/* SPDX-License-Identifier: MIT */
#include "cpu.h"

#include "limn/limn.h"

#if defined(__x86_64__) || defined(__i386__)

#include <cpuid.h>

/// Which registers the operating system saves. The instruction exists where CPUID says so.
static uint32_t saved_registers(void) {
    uint32_t low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

limni_cpu limni_cpu_detect(void) {
    limni_cpu cpu = {.isas = LIMN_ISA_SCALAR};
    uint32_t a, b, c, d;
    if (!__get_cpuid(1, &a, &b, &c, &d)) return cpu;
    if (d & bit_SSE2) cpu.isas |= LIMN_ISA_SSE2;
    const uint32_t avx_state = 6; // XMM and YMM
    if (!(c & bit_OSXSAVE) || !(c & bit_AVX) || (saved_registers() & avx_state) != avx_state)
        return cpu;
    const bool fused = c & bit_FMA;
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d) || !(b & bit_AVX2)) return cpu;
    cpu.isas |= LIMN_ISA_AVX2;
    cpu.fused = fused;
    return cpu;
}

#else

limni_cpu limni_cpu_detect(void) {
#if defined(__aarch64__)
    return (limni_cpu){.isas = LIMN_ISA_SCALAR | LIMN_ISA_NEON, .fused = true};
#else
    return (limni_cpu){.isas = LIMN_ISA_SCALAR};
#endif
}

#endif
