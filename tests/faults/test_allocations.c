/* SPDX-License-Identifier: MIT */
/*
 * Every allocation of a few small bakes fails in turn, once, and with all that come after it: a
 * clear error, no output, and nothing lost, which the address sanitizer looks for. The linker leads
 * allocations here. Those of the C++ library and of stdio are not counted.
 *
 * usage: test_allocations CORPUS_FOLDER WORK_FOLDER STRIDE      every STRIDE-th allocation, and all the last
 */
#include "../check.h"

#include "limn/bake.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

// ---- Allocations that fail

static size_t allocation, first_failure, last_failure; ///< counted from 1; 0: none fails

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);

static bool fails(void) {
    allocation++;
    return allocation >= first_failure && allocation <= last_failure;
}

void *__wrap_malloc(size_t size) {
    return fails() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
    return fails() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size) {
    return fails() ? NULL : __real_realloc(memory, size);
}

// ---- Bakes

typedef struct bake {
    const char *mesh; ///< in the corpus
    limn_bake_desc desc;
} bake;

static const bake bakes[] = {
    {"obj/tetrahedron.obj", {.scheme = LIMN_SCHEME_LOOP}},
    {"obj/tags.obj", {.normals = LIMN_NORMALS_EXACT, .creasing = LIMN_CREASING_CHAIKIN}},
    {"obj/uv.obj", {.isolate = LIMN_ISOLATE_ALWAYS, .normals = LIMN_NORMALS_EXACT}},
    {"obj/uv.obj", {.scheme = LIMN_SCHEME_BUTTERFLY, .repair = LIMN_REPAIR_ALL}},
    {"obj/quads.obj", {.scheme = LIMN_SCHEME_CATMARK, .non_manifold = LIMN_NON_MANIFOLD_SPLIT}},
    {"obj/quads.obj", {.scheme = LIMN_SCHEME_NONE, .isolate = LIMN_ISOLATE_AUTO}},
    {"off/tetrahedron.off", {.scheme = LIMN_SCHEME_CATMARK, .isolate = LIMN_ISOLATE_ALWAYS}},
    {"ply/binary.ply", {.weights = LIMN_WEIGHTS_WARREN, .normals = LIMN_NORMALS_EXACT}},
    {"lomont/tags.obj", {.creases = LIMN_CREASES_LOMONT}},
};

enum { WRITING = 16 }; ///< allocations, at least, from the finished bake on

static const char old_bytes[] = "what was there before";
static char input[4096], target[4096], link_path[4096];

/// Puts the older file at the target, or none.
static void prepare(bool older) {
    remove(target);
    if (!older) return;
    FILE *const file = fopen(target, "wb");
    if (!file) abort();
    fputs(old_bytes, file);
    fclose(file);
}

static bool is_as_prepared(bool older) {
    char bytes[sizeof old_bytes + 1] = "";
    FILE *const file = fopen(target, "rb");
    if (!file) return !older;
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    return older && size == sizeof old_bytes - 1 && memcmp(bytes, old_bytes, size) == 0;
}

/// Through a link, which may lead nowhere yet, so that following it is tried, too.
static limn_bake_status run(const bake *b, size_t first, size_t last) {
    allocation = 0;
    first_failure = first;
    last_failure = last;
    limn_bake_status status = LIMN_BAKE_MEMORY;
    limn_baker *const baker = limn_baker_create(&b->desc);
    if (baker) status = limn_baker_add_file(baker, input);
    if (status == LIMN_BAKE_OK) status = limn_baker_write(baker, link_path);
    last_failure = 0;
    if (status != LIMN_BAKE_OK) CHECK(limn_baker_error(baker)[0] != '\0');
    if (status == LIMN_BAKE_MEMORY) CHECK_CONTAINS(limn_baker_error(baker), "out of memory");
    limn_baker_destroy(baker);
    return status;
}

static void check_failure(const bake *b, bool older, size_t first, size_t last) {
    const limn_bake_status status = run(b, first, last);
    struct stat link;
    if (!CHECK(status == LIMN_BAKE_MEMORY || status == LIMN_BAKE_IO) ||
        !CHECK(is_as_prepared(older)) ||
        !CHECK(lstat(link_path, &link) == 0 && S_ISLNK(link.st_mode)))
        fprintf(stderr, "    %s: status %d, allocations %zu to %zu fail\n", b->mesh, (int)status,
                first, last);
}

static size_t next_allocation(size_t a, size_t writing, size_t stride) {
    if (a >= writing) return a + 1;
    return a + stride < writing ? a + stride : writing;
}

static size_t test_bake(const char *corpus, const bake *b, bool older, size_t stride) {
    snprintf(input, sizeof input, "%s/%s", corpus, b->mesh);
    prepare(older);
    CHECK_EQUAL(run(b, 0, 0), LIMN_BAKE_OK);
    CHECK(!is_as_prepared(older));
    const size_t count = allocation;
    prepare(older);
    const size_t writing = count > WRITING ? count - WRITING : 1;
    size_t tried = 0;
    for (size_t a = 1; a <= count; a = next_allocation(a, writing, stride), tried += 2) {
        check_failure(b, older, a, a);
        check_failure(b, older, a, SIZE_MAX);
    }
    return tried;
}

int main(int argc, char **argv) {
    const size_t stride = argc == 4 ? strtoul(argv[3], NULL, 10) : 0;
    if (stride == 0) return 2;
    size_t count = 0;
    mkdir(argv[2], 0777);
    snprintf(target, sizeof target, "%s/target.limn", argv[2]);
    snprintf(link_path, sizeof link_path, "%s/link.limn", argv[2]);
    unlink(link_path);
    if (symlink("target.limn", link_path) != 0) abort();
    for (size_t b = 0; b < sizeof bakes / sizeof *bakes; b++)
        count += test_bake(argv[1], &bakes[b], b % 2, stride);
    printf("%zu bakes without memory\n", count);
    return check_report();
}
