/* Four doubles that the processor works on together: a vector and one more number.

   GCC and Clang turn these into the lanes of the machine that they build for. */
#ifndef MPSLAB_LANES_H
#define MPSLAB_LANES_H

#include <math.h>
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

/* x, x, x, x */
INLINE four same(double x) { return (four){x, x, x, x}; }

INLINE four minus(four a, four b) { return a - b; }

INLINE four product(four a, four b) { return a * b; }

INLINE four quotient(four a, four b) { return a / b; }

/* The number of each lane, or x where that is more. */
INLINE four at_least(double x, four v) {
    four_masks more = v > x;
    return (four)(((four_masks)v & more) | ((four_masks)same(x) & ~more));
}

INLINE four root(four v) {
#ifdef __AVX__
    return (four)_mm256_sqrt_pd((__m256d)v);
#else
    return (four){sqrt(v[0]), sqrt(v[1]), sqrt(v[2]), sqrt(v[3])};
#endif
}

/* The sum of the four numbers. */
INLINE double added(four v) { return (v[0] + v[1]) + (v[2] + v[3]); }

INLINE four times(double factor, four v) { return factor * v; }

/* sum + factor * v */
INLINE four plus(four sum, double factor, four v) { return sum + factor * v; }

/* Nearest image of a distance across the tank; width = 0 means no periodicity. */
INLINE four nearest(four v, double width) {
    if (!(width > 0.0)) return v;
    four half = {0.5 * width, 0.5 * width, 0.5 * width, 0.5 * width};
    four_masks period = (four_masks)(four){0.0, width, 0.0, 0.0};
    return v - (four)((v > half) & period) + (four)((v < -half) & period);
}

/* The numbers at four places of x. */
INLINE four gathered(const double *x, const int *at) {
    return (four){x[at[0]], x[at[1]], x[at[2]], x[at[3]]};
}

/* Sum of value times x at its place over the entries of a row, four at a time.

   There are `room` entries from the row's first on.  So that the end of a row needs no loop of its
   own, up to four of what is behind it are read as well, and count for nothing. */
#define ROW_SUM(name, number, taken)                                                       \
    INLINE double name(const number *value, const int *place, const double *x,             \
                       long count, long room) {                                            \
        four sum = nothing();                                                              \
        long k = 0;                                                                        \
        for (; k + 4 <= count; k += 4) sum += taken(value + k) * gathered(x, place + k);   \
        number last[4] = {0, 0, 0, 0};                                                     \
        int where[4] = {0, 0, 0, 0};                                                       \
        if (k + 4 > room) {                                                                \
            for (long e = 0; k + e < count; e++) {                                         \
                last[e] = value[k + e];                                                    \
                where[e] = place[k + e];                                                   \
            }                                                                              \
            sum += taken(last) * gathered(x, where);                                       \
        } else {                                                                           \
            four_masks wanted = (four_masks){0, 1, 2, 3} < count - k;                      \
            sum += (four)((four_masks)taken(value + k) & wanted) * gathered(x, place + k); \
        }                                                                                  \
        return added(sum);                                                                 \
    }

ROW_SUM(row_of_singles, float, widened)
ROW_SUM(row_of_doubles, double, load)

/* Which of four places, less another one, are nearer than the root of the limit: a bit each. */
INLINE int near_four(four x, four y, four z, double limit, double width) {
    if (width > 0.0) {
        four half = {0.5 * width, 0.5 * width, 0.5 * width, 0.5 * width};
        four_masks period = (four_masks)(half + half);
        y = y - (four)((y > half) & period) + (four)((y < -half) & period);
    }
    four square = x * x + y * y + z * z;
    four_masks near = square < limit;
#ifdef __AVX__
    return _mm256_movemask_pd((__m256d)near);
#else
    return (near[0] & 1) | (near[1] & 2) | (near[2] & 4) | (near[3] & 8);
#endif
}

/* Which of eight places, whose coordinates lie in rows of memory, are near (x, y, z). */
INLINE int near_eight(const double *xs, const double *ys, const double *zs, double x, double y,
                      double z, double limit, double width) {
    return near_four(load(xs) - x, load(ys) - y, load(zs) - z, limit, width)
        | near_four(load(xs + 4) - x, load(ys + 4) - y, load(zs + 4) - z, limit, width) << 4;
}

/* Which of `count` pairs, eight at most, are as near as two reaches together: a bit each. */
INLINE int reached_eight(const float *inverse, const int *other, const float *reach, float mine,
                         long count) {
    const float least = 1.0f - 1e-5f; /* for the rounding */
#ifdef __AVX2__
    __m256i wanted = _mm256_cmpgt_epi32(_mm256_set1_epi32(count < 8 ? (int)count : 8),
                                        _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    __m256i there = _mm256_maskload_epi32(other, wanted);
    __m256 both = _mm256_set1_ps(mine) + _mm256_i32gather_ps(reach, there, 4);
    __m256 near = _mm256_cmp_ps(_mm256_loadu_ps(inverse) * both, _mm256_set1_ps(least), _CMP_GE_OQ);
    return _mm256_movemask_ps(_mm256_and_ps(near, _mm256_castsi256_ps(wanted)));
#else
    int near = 0;
    for (long k = 0; k < 8 && k < count; k++)
        near |= (inverse[k] * (mine + reach[other[k]]) >= least) << k;
    return near;
#endif
}

/* For each choice among eight, a bit each: the numbers of those chosen, a byte each. */
static unsigned long long chosen[256];

/* To be called before `squeeze`. */
static inline void prepare_squeeze(void) {
    for (int choice = 0; choice < 256; choice++) {
        unsigned long long numbers = 0;
        for (int k = 7; k >= 0; k--)
            if (choice >> k & 1) numbers = numbers << 8 | k;
        chosen[choice] = numbers;
    }
}

/* Write those chosen of eight numbers to the front, anything behind them; how many there are. */
INLINE int squeeze(int *to, const int *from, int choice) {
#ifdef __AVX2__
    __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)chosen[choice]));
    __m256i all = _mm256_loadu_si256((const __m256i *)from);
    _mm256_storeu_si256((__m256i *)to, _mm256_permutevar8x32_epi32(all, order));
#else
    for (int k = 0; k < 8; k++) to[k] = from[chosen[choice] >> 8 * k & 7];
#endif
    return __builtin_popcount(choice);
}

#endif
