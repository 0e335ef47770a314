/* SPDX-License-Identifier: MIT */
/*
 * The microbenchmarks, written once. A peak_<isa>.c defines first
 *
 *     wide           the vector type, or float
 *     PEAK_FUSED     a * b + c in one instruction; only for the fast family
 *     PEAK_CHAINS    independent sums: enough to hide the latency of a sum
 *
 * and includes this. After a change look at the assembly: the loop of compute() must not touch
 * memory.
 */
#include "peak.h"

#ifdef __aarch64__
#define PEAK_REGISTER "w"
#else
#define PEAK_REGISTER "x"
#endif

enum { PEAK_WIDTH = sizeof(wide) / sizeof(float) };

/// Numbers that the compiler cannot know.
static wide opaque(float value) {
    volatile float hidden = value;
    return (wide){0} + hidden;
}

static float total(const wide *sums) {
    float result = 0;
    for (int c = 0; c < PEAK_CHAINS; c++) {
        float parts[PEAK_WIDTH];
        __builtin_memcpy(parts, &sums[c], sizeof parts);
        result += parts[0];
    }
    return result;
}

/// One multiply-add. Without PEAK_FUSED the factor seems to be another one each time, so that no
/// product can be shared between sums.
static inline wide multiply_add(wide *factor, wide one, wide sum) {
#ifdef PEAK_FUSED
    return PEAK_FUSED(*factor, one, sum);
#else
    __asm__ volatile("" : "+" PEAK_REGISTER(*factor));
    return *factor * one + sum;
#endif
}

static float compute(uint64_t steps) {
    wide factor = opaque(1e-9f), sums[PEAK_CHAINS];
    const wide one = opaque(1.0f);
    for (int c = 0; c < PEAK_CHAINS; c++)
        sums[c] = factor;
    for (uint64_t s = 0; s < steps; s++) {
        for (int c = 0; c < PEAK_CHAINS; c++)
            sums[c] = multiply_add(&factor, one, sums[c]);
    }
    return total(sums);
}

static void store(float *dst, size_t size, uint64_t passes) {
    enum { LINE = 64, VECTORS = LINE / sizeof(wide) };
    const wide value = opaque(1.0f);
    for (uint64_t p = 0; p < passes; p++) {
        wide *vectors = (wide *)(void *)dst;
        for (size_t offset = 0; offset < size; offset += LINE, vectors += VECTORS) {
            for (int v = 0; v < VECTORS; v++)
                vectors[v] = value;
        }
        __asm__ volatile("" ::: "memory");
    }
}
