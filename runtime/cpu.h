/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_CPU_H
#define LIMNI_CPU_H

#include <stdbool.h>
#include <stdint.h>

/// What this CPU and its operating system can run.
typedef struct limni_cpu {
    uint32_t isas; ///< LIMN_ISA_… bits
    bool fused;    ///< fused multiply-add beside AVX2
} limni_cpu;

limni_cpu limni_cpu_detect(void);

#endif
