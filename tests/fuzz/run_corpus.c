/* SPDX-License-Identifier: MIT */
/* Runs a fuzz target once over each file of a folder, which must have some. usage: TEST FOLDER */
#include "corpus_files.h"
#include "fuzz.h"

#include <stdio.h>

static void run(const char *name, const uint8_t *bytes, size_t size) {
    (void)name;
    LLVMFuzzerTestOneInput(bytes, size);
}

int main(int argc, char **argv) {
    const int count = argc == 2 ? corpus_files_visit(argv[1], run) : -1;
    printf("%d files\n", count);
    return count <= 0;
}
