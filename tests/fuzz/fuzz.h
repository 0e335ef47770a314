/* SPDX-License-Identifier: MIT */
/*
 * Fuzz targets in libFuzzer's form: bytes in, no crash, no sanitizer's complaint, no broken
 * promise. run_corpus.c runs a target over files without a fuzzer; the preset `fuzz` links
 * libFuzzer.
 */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/// Aborts when a promise is broken, in every build.
#define FUZZ_REQUIRE(condition) ((condition) ? (void)0 : abort())

#endif
