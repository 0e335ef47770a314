/* SPDX-License-Identifier: MIT */
/* limn-bench compare: whether one run of limn-bench frame was slower than another. */
#include "../arguments.h"
#include "../bench.h"
#include "../peers/allocate.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: limn-bench compare [OPTIONS] A.json B.json\n\n"
    "Compares two results of limn-bench frame on the same scene: how much longer the frames of B\n"
    "take. Frames of the same number do the same work, so their times are compared in pairs. A "
    "way\n"
    "is slower, or faster, if the 99 % confidence interval of the median of B / A lies outside of\n"
    "1 - T to 1 + T. The interval goes from the kth smallest ratio to the kth largest, with\n"
    "k = n / 2 - 1.288 sqrt(n) of n frames: no distribution is assumed, but frames are taken to "
    "be\n"
    "independent. What slows a whole run down, such as other programs, looks like a slower way:\n"
    "use the median of several rounds, on a quiet machine, or --clock thread.\n\n"
    "Options:\n"
    "  --threshold P  T in percent, 0 to 1000 (default 5)\n\n"
    "Exit status:\n"
    "  0              nothing is slower\n"
    "  1              something is slower\n"
    "  2              an error\n";

enum { FRAMES_LEAST = 16 };

/// A file of results.
typedef struct results {
    const char *path;
    json_t *root;
} results;

static bool read_results(results *r, const char *path) {
    json_error_t error;
    *r = (results){path, json_load_file(path, 0, &error)};
    if (!r->root) {
        fprintf(stderr, "limn-bench: %s:%d: %s\n", path, error.line, error.text);
        return false;
    }
    if (json_is_array(json_object_get(r->root, "ways")) &&
        json_is_object(json_object_get(r->root, "conditions")))
        return true;
    fprintf(stderr, "limn-bench: %s: not a result of limn-bench frame\n", path);
    return false;
}

static json_t *find_way(const results *r, const char *name) {
    size_t index;
    json_t *way;
    json_array_foreach(json_object_get(r->root, "ways"), index, way) {
        const char *const own = json_string_value(json_object_get(way, "name"));
        if (own && strcmp(own, name) == 0) return way;
    }
    return NULL;
}

/// Whether both have done the same work; otherwise says which condition differs.
static bool check_same_work(const results *a, const results *b) {
    static const char *const keys[] = {"scene", "mesh", "characters", "frames"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        json_t *const left = json_object_get(json_object_get(a->root, "conditions"), keys[k]);
        json_t *const right = json_object_get(json_object_get(b->root, "conditions"), keys[k]);
        if (left && json_equal(left, right)) continue;
        fprintf(stderr, "limn-bench: %s and %s differ in \"%s\"\n", a->path, b->path, keys[k]);
        return false;
    }
    return true;
}

static void print_conditions(const results *r) {
    json_t *const c = json_object_get(r->root, "conditions");
    const char *values[5];
    static const char *const keys[5] = {"commit", "compiler", "flags", "cpu", "isa"};
    for (int k = 0; k < 5; k++) {
        values[k] = json_string_value(json_object_get(c, keys[k]));
        if (!values[k]) values[k] = "?";
    }
    printf("%s: commit %s, %s, flags %s, CPU %s, %s\n", r->path, values[0], values[1], values[2],
           values[3], values[4]);
}

/// The median of ratios, and the interval that it is in.
typedef struct interval {
    double low, median, high;
} interval;

static interval find_interval(double *ratios, uint32_t count) {
    const double median = bench_median(ratios, count); // and so they are in order
    const double rank = floor(count / 2.0 - 1.288 * sqrt(count));
    const uint32_t k = rank < 1 ? 0 : (uint32_t)rank - 1;
    return (interval){ratios[k], median, ratios[count - 1 - k]};
}

/// B / A of each frame. False: they are not times.
static bool read_ratios(json_t *a, json_t *b, double *ratios, uint32_t count) {
    for (uint32_t f = 0; f < count; f++) {
        const double left = json_number_value(json_array_get(a, f));
        const double right = json_number_value(json_array_get(b, f));
        if (!(left > 0) || !(right > 0)) return false;
        ratios[f] = right / left;
    }
    return true;
}

typedef enum verdict { SAME, FASTER, SLOWER, WRONG } verdict;

static verdict judge(interval i, double threshold) {
    if (i.low > 1 + threshold) return SLOWER;
    return i.high < 1 - threshold ? FASTER : SAME;
}

static verdict compare_way(const char *name, json_t *a, json_t *b, double threshold) {
    static const char *const words[] = {"no difference", "faster", "slower"};
    json_t *const left = json_object_get(a, "frames"), *const right = json_object_get(b, "frames");
    const uint32_t count = (uint32_t)json_array_size(left);
    if (count < FRAMES_LEAST || count != json_array_size(right)) {
        fprintf(stderr, "limn-bench: %s: fewer than %d frames, or not as many in both\n", name,
                FRAMES_LEAST);
        return WRONG;
    }
    double *const ratios = bench_allocate(count, sizeof *ratios);
    verdict found = WRONG;
    if (read_ratios(left, right, ratios, count)) {
        const interval i = find_interval(ratios, count);
        found = judge(i, threshold);
        printf("%-18s %8.3f   %6.3f to %6.3f   %s\n", name, i.median, i.low, i.high, words[found]);
    } else {
        fprintf(stderr, "limn-bench: %s: a frame has no time\n", name);
    }
    free(ratios);
    return found;
}

/// All ways that both have.
static int compare(const results *a, const results *b, double threshold) {
    bool slower = false;
    uint32_t compared = 0;
    size_t index;
    json_t *way;
    print_conditions(a);
    print_conditions(b);
    printf("\n%-18s %8s   %16s\n", "B / A", "median", "99 % interval");
    json_array_foreach(json_object_get(a->root, "ways"), index, way) {
        const char *const name = json_string_value(json_object_get(way, "name"));
        json_t *const other = name ? find_way(b, name) : NULL;
        if (!other) continue;
        const verdict found = compare_way(name, way, other, threshold);
        if (found == WRONG) return 2;
        slower |= found == SLOWER;
        compared++;
    }
    if (compared > 0) return slower ? 1 : 0;
    fprintf(stderr, "limn-bench: %s and %s have no way in common\n", a->path, b->path);
    return 2;
}

static bool parse_option(int option, void *parsed) {
    return option == 't' && limni_parse_real(optarg, 0, 1000, parsed);
}

int bench_compare(int argc, char **argv) {
    static const struct option names[] = {
        {"threshold", required_argument, NULL, 't'}, {"help", no_argument, NULL, 'h'}, {0}};
    float percent = 5;
    int status = bench_read_options(argc, argv, help, names, parse_option, &percent);
    if (status >= 0) return status;
    if (argc - optind != 2) {
        fputs("limn-bench: compare takes two files; see limn-bench compare --help\n", stderr);
        return 2;
    }
    results a, b = {0};
    status = 2;
    if (read_results(&a, argv[optind]) && read_results(&b, argv[optind + 1]) &&
        check_same_work(&a, &b))
        status = compare(&a, &b, (double)percent / 100);
    json_decref(a.root);
    json_decref(b.root);
    return status;
}
