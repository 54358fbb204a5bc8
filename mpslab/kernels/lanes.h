/* Four doubles that the processor works on together: a vector and one more number.

   GCC and Clang turn these into the lanes of the machine that they build for. */
#ifndef MPSLAB_LANES_H
#define MPSLAB_LANES_H

#include <string.h>
#ifdef __AVX__
#include <immintrin.h>
#endif

typedef double four __attribute__((vector_size(32)));
typedef float four_singles __attribute__((vector_size(16)));
typedef long long four_masks __attribute__((vector_size(32)));

#define INLINE static inline __attribute__((always_inline))

/* 0, 0, 0, 0 */
INLINE four nothing(void) { return (four){0.0, 0.0, 0.0, 0.0}; }

/* Four doubles in a row of memory. */
INLINE four load(const double *from) { four v; memcpy(&v, from, sizeof v); return v; }

/* Four singles in a row of memory. */
INLINE four widened(const float *from) {
#ifdef __AVX__
    return (four)_mm256_cvtps_pd(_mm_loadu_ps(from)); /* GCC makes two halves of it by itself */
#else
    four_singles v;
    memcpy(&v, from, sizeof v);
    return __builtin_convertvector(v, four);
#endif
}

INLINE void store(double *to, four v) { memcpy(to, &v, sizeof v); }

/* Store rounded to single precision. */
INLINE void store_rounded(float *to, four v) {
    four_singles rounded = __builtin_convertvector(v, four_singles);
    memcpy(to, &rounded, sizeof rounded);
}

INLINE double lane(four v, int axis) { return v[axis]; }

/* The vector with x as its fourth number. */
INLINE four ended(four v, double x) { v[3] = x; return v; }

INLINE four minus(four a, four b) { return a - b; }

INLINE four times(double factor, four v) { return factor * v; }

/* sum + factor * v */
INLINE four plus(four sum, double factor, four v) { return sum + factor * v; }

/* Nearest image of a distance across the tank; width = 0 means no periodicity. */
INLINE four nearest(four v, double width) {
    four half = {0.5 * width, 0.5 * width, 0.5 * width, 0.5 * width};
    four_masks period = (four_masks)(four){0.0, width, 0.0, 0.0};
    return v - (four)((v > half) & period) + (four)((v < -half) & period);
}

#endif
