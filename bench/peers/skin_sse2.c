/* SPDX-License-Identifier: MIT */
#include "skin.h"

#include <emmintrin.h>

/// One column of the blended matrix in each vector.
typedef struct columns {
    __m128 c[4];
} columns;

static inline columns blend(const skin_mesh *mesh, const scene_bone *bones, uint32_t v) {
    const float *bone = bones[mesh->bones[v][0]];
    __m128 weight = _mm_set1_ps(mesh->weights[v][0]);
    columns sum;
    for (int i = 0; i < 4; i++)
        sum.c[i] = _mm_mul_ps(weight, _mm_load_ps(bone + 4 * i));
    for (int k = 1; k < 4; k++) {
        bone = bones[mesh->bones[v][k]];
        weight = _mm_set1_ps(mesh->weights[v][k]);
        for (int i = 0; i < 4; i++)
            sum.c[i] = _mm_add_ps(sum.c[i], _mm_mul_ps(weight, _mm_load_ps(bone + 4 * i)));
    }
    return sum;
}

static inline __m128 turn(const columns *matrix, const float v[3]) {
    const __m128 x = _mm_mul_ps(matrix->c[0], _mm_set1_ps(v[0]));
    const __m128 y = _mm_mul_ps(matrix->c[1], _mm_set1_ps(v[1]));
    const __m128 z = _mm_mul_ps(matrix->c[2], _mm_set1_ps(v[2]));
    return _mm_add_ps(_mm_add_ps(x, y), z);
}

/// With one Newton step, which gives 23 bits. The fourth lane of `v` is 0.
static inline __m128 normalize(__m128 v) {
    __m128 squares = _mm_mul_ps(v, v);
    squares = _mm_add_ps(squares, _mm_shuffle_ps(squares, squares, _MM_SHUFFLE(2, 3, 0, 1)));
    squares = _mm_add_ps(squares, _mm_shuffle_ps(squares, squares, _MM_SHUFFLE(1, 0, 3, 2)));
    const __m128 guess = _mm_rsqrt_ps(squares);
    const __m128 rest = _mm_mul_ps(_mm_mul_ps(squares, guess), guess);
    const __m128 scale =
        _mm_mul_ps(_mm_mul_ps(_mm_set1_ps(0.5f), guess), _mm_sub_ps(_mm_set1_ps(3.0f), rest));
    return _mm_mul_ps(v, scale);
}

void skin_sse2(const skin_mesh *mesh, const scene_bone *bones, float *out) {
    const uint32_t count = mesh->count;
    if (!mesh->normals) {
        for (uint32_t v = 0; v < count; v++, out += 3) {
            const columns matrix = blend(mesh, bones, v);
            _mm_storeu_ps(out, _mm_add_ps(turn(&matrix, mesh->positions[v]), matrix.c[3]));
        }
        return;
    }
    for (uint32_t v = 0; v < count; v++, out += 6) {
        const columns matrix = blend(mesh, bones, v);
        _mm_storeu_ps(out, _mm_add_ps(turn(&matrix, mesh->positions[v]), matrix.c[3]));
        _mm_storeu_ps(out + 3, normalize(turn(&matrix, mesh->normals[v])));
    }
}
