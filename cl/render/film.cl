// SPDX-License-Identifier: MIT
// Samples added up, pixel by pixel. A film has FILM_FLOATS floats for each pixel of the picture:
//
//     sum of each of SUMS values, what rounding lost of each sum (Kahan 1965), mean of the luminance, sum of its squared
//     differences from the mean (Welford 1962), number of samples
//
// so that a million samples of one brightness lose no more digits than one. SUMS = 3 * LIGHTS + AO: R, G, B of each part of the
// light, then the share of the ambient light that is not occluded.
//
// LIGHTS      1 to 3: parts of the light; their sum is what is seen.
// AO          1: there is a share of ambient light.
// GROUP_SIZE  work-items per work-group.
// compile: LIGHTS=1 AO=0
// compile: LIGHTS=1 AO=1
// compile: LIGHTS=2 AO=0
// compile: LIGHTS=3 AO=1
#include "runtime/numerics.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#if LIGHTS < 1 || LIGHTS > 3 || !defined(AO)
#error "define LIGHTS (1 to 3) and AO (0, 1)"
#endif

#define SUMS (3 * LIGHTS + AO)
#define FILM_FLOATS (2 * SUMS + 3)

/// Luminance of linear sRGB (IEC 61966-2-1).
inline float luminance(const float* color) { return 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2]; }

inline void add_sample(const float* values, global float* pixel) {
    float seen[3] = {0.0f, 0.0f, 0.0f};
    bool fine = true;
    for (uint k = 0; k < SUMS; ++k) {
        // False for NaN, and where the sum would become infinite.
        fine = fine && values[k] >= 0.0f && pixel[k] + values[k] < INFINITY;
        if (k < 3 * LIGHTS) seen[k % 3] += values[k];
    }
    const float y = luminance(seen);
    if (!fine || !(y < INFINITY)) return;
    for (uint k = 0; k < SUMS; ++k) {
        const float value = values[k] - pixel[SUMS + k];
        const float sum = pixel[k] + value;
        pixel[SUMS + k] = (sum - pixel[k]) - value;
        pixel[k] = sum;
    }
    global float* moments = pixel + 2 * SUMS;
    const float count = moments[2] + 1.0f; // at most 2^20: exact
    const float difference = y - moments[0];
    const float mean = moments[0] + difference / count;
    moments[0] = mean;
    moments[1] = fmin(moments[1] + difference * (y - mean), FLT_MAX);
    moments[2] = count;
}

/// Adds a sample to the pixels from number `first` on: R, G, B of each part of pixel first + i at [3 * i], its share of ambient light
/// at ao[i]. A sample with a value that is NaN, infinite or negative is left out. Parts beyond LIGHTS and, without AO, `ao` may be
/// null. A work-item takes `length` consecutive pixels of the `count`. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
film_add(global const float* part0, global const float* part1, global const float* part2, global const float* ao, uint first,
         uint count, uint length, global float* film) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        float values[SUMS];
        for (uint c = 0; c < 3; ++c) {
            values[c] = part0[3 * i + c];
#if LIGHTS > 1
            values[3 + c] = part1[3 * i + c];
#endif
#if LIGHTS > 2
            values[6 + c] = part2[3 * i + c];
#endif
        }
#if AO
        values[3 * LIGHTS] = ao[i];
#endif
        add_sample(values, film + (first + i) * FILM_FLOATS);
    }
}
