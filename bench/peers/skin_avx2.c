/* SPDX-License-Identifier: MIT */
/* Built with AVX2 and FMA. */
#include "skin.h"

#include <immintrin.h>

/// Columns 0 and 1, and 2 and 3, of the blended matrix.
typedef struct columns {
    __m256 low, high;
} columns;

static inline columns blend(const skin_mesh *mesh, const scene_bone *bones, uint32_t v) {
    const uint8_t *const indices = mesh->bones[v];
    __m256 weight = _mm256_broadcast_ss(&mesh->weights[v][0]);
    columns sum = {_mm256_mul_ps(weight, _mm256_load_ps(bones[indices[0]])),
                   _mm256_mul_ps(weight, _mm256_load_ps(bones[indices[0]] + 8))};
    for (int k = 1; k < 4; k++) {
        weight = _mm256_broadcast_ss(&mesh->weights[v][k]);
        sum.low = _mm256_fmadd_ps(weight, _mm256_load_ps(bones[indices[k]]), sum.low);
        sum.high = _mm256_fmadd_ps(weight, _mm256_load_ps(bones[indices[k]] + 8), sum.high);
    }
    return sum;
}

static inline __m128 apply(columns matrix, __m256 xy, __m256 zw) {
    const __m256 halves = _mm256_fmadd_ps(matrix.low, xy, _mm256_mul_ps(matrix.high, zw));
    return _mm_add_ps(_mm256_castps256_ps128(halves), _mm256_extractf128_ps(halves, 1));
}

/// a in the lower half, b in the upper one.
static inline __m256 halves(const float *a, const float *b) {
    return _mm256_insertf128_ps(_mm256_broadcast_ss(a), _mm_broadcast_ss(b), 1);
}

static inline __m128 turn_position(columns matrix, const float p[3]) {
    static const float one = 1.0f;
    return apply(matrix, halves(p, p + 1), halves(p + 2, &one));
}

static inline __m128 turn_normal(columns matrix, const float n[3]) {
    const __m256 zw = _mm256_zextps128_ps256(_mm_broadcast_ss(n + 2));
    return apply(matrix, halves(n, n + 1), zw);
}

/// With one Newton step, which gives 23 bits. The fourth lane of `v` is 0.
static inline __m128 normalize(__m128 v) {
    const __m128 squares = _mm_dp_ps(v, v, 0xff);
    const __m128 guess = _mm_rsqrt_ps(squares);
    const __m128 rest = _mm_mul_ps(_mm_mul_ps(squares, guess), guess);
    const __m128 scale =
        _mm_mul_ps(_mm_mul_ps(_mm_set1_ps(0.5f), guess), _mm_sub_ps(_mm_set1_ps(3.0f), rest));
    return _mm_mul_ps(v, scale);
}

void skin_avx2(const skin_mesh *mesh, const scene_bone *bones, float *out) {
    const uint32_t count = mesh->count;
    if (!mesh->normals) {
        for (uint32_t v = 0; v < count; v++, out += 3)
            _mm_storeu_ps(out, turn_position(blend(mesh, bones, v), mesh->positions[v]));
        return;
    }
    for (uint32_t v = 0; v < count; v++, out += 6) {
        const columns matrix = blend(mesh, bones, v);
        _mm_storeu_ps(out, turn_position(matrix, mesh->positions[v]));
        _mm_storeu_ps(out + 3, normalize(turn_normal(matrix, mesh->normals[v])));
    }
}
