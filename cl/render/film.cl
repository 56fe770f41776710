// SPDX-License-Identifier: MIT
// Accumulates samples per pixel. A film has FILM_FLOATS floats for each pixel of the picture, in packets of 8
// consecutive pixels: the first float of all 8, the second, ...; the last packet is whole. The floats of a pixel are
//
//     sum of each of SUMS values, what rounding lost of each sum (Kahan 1965), mean of the luminance, sum of its
//     squared differences from the mean (Welford 1962), number of samples
//
// so that a million samples of equal brightness lose no more digits than one. SUMS = 3 * LIGHTS + AO: R, G, B of each
// part of the light, then the fraction of the ambient light that is not occluded.
//
// LIGHTS      1 to 3: parts of the light; their sum is what is seen.
// AO          1: there is a fraction of ambient light.
// LANES       1 or 8: pixels at once (runtime/real.h).
// GROUP_SIZE  work-items per work-group.
// compile: LIGHTS=1 AO=0 LANES=8
// compile: LIGHTS=1 AO=1 LANES=1
// compile: LIGHTS=2 AO=0 LANES=1
// compile: LIGHTS=2 AO=0 LANES=8
// compile: LIGHTS=3 AO=1 LANES=8
#include "runtime/real.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#if LIGHTS < 1 || LIGHTS > 3 || !defined(AO)
#error "define LIGHTS (1 to 3) and AO (0, 1)"
#endif

#define SUMS (3 * LIGHTS + AO)
#define FILM_FLOATS (2 * SUMS + 3)

/// Luminance of linear sRGB (IEC 61966-2-1).
INLINE real luminance(const real* color) { return 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2]; }

/// Adds a sample to its pixel, in the lanes that are `wanted`. One that is no light leaves it as it is.
INLINE void add_sample(mask wanted, const real* values, real* pixel) {
    real seen[3] = {0.0f, 0.0f, 0.0f};
    mask fine = wanted;
    for (uint k = 0; k < SUMS; ++k) {
        // False for NaN, and where the sum would become infinite.
        fine = fine & (values[k] >= 0.0f) & (pixel[k] + values[k] < INFINITY);
        if (k < 3 * LIGHTS) seen[k % 3] += values[k];
    }
    const real y = luminance(seen);
    fine = fine & (y < INFINITY);
    for (uint k = 0; k < SUMS; ++k) {
        const real value = values[k] - pixel[SUMS + k];
        const real sum = pixel[k] + value;
        pixel[SUMS + k] = CHOOSE(fine, (sum - pixel[k]) - value, pixel[SUMS + k]);
        pixel[k] = CHOOSE(fine, sum, pixel[k]);
    }
    real* moments = pixel + 2 * SUMS;
    const real count = moments[2] + 1.0f; // at most 2^20: exact
    const real difference = y - moments[0];
    const real mean = moments[0] + difference / count;
    const real squares = LESSER(moments[1] + difference * (y - mean), (real)(FLT_MAX));
    moments[0] = CHOOSE(fine, mean, moments[0]);
    moments[1] = CHOOSE(fine, squares, moments[1]);
    moments[2] = CHOOSE(fine, count, moments[2]);
}

/// R, G, B of the lanes' pixels.
INLINE void load_part(global const float* part, const uint* index, real* values) {
    real row[8];
    load_rows3(part, 3, index, row);
    for (uint c = 0; c < 3; ++c) values[c] = row[c];
}

/// Adds a sample to the pixels from number `first` on: R, G, B of each part of pixel first + i at [3 * i], its fraction
/// of ambient light at ao[i]. A sample with a value that is NaN, infinite or negative is left out. Parts beyond LIGHTS
/// and, without AO, `ao` may be null. A work-item takes `length` consecutive pixels, a multiple of LANES; the first
/// one's begin at the last multiple of LANES up to `first`, and those before are left as they are. No barrier:
/// work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void film_add(global const float* part0, global const float* part1, global const float* part2, global const float* ao,
              uint first, uint count, uint length, global float* film) {
    const uint last = first + count; // pictures have fewer than 2^31 pixels
    const ulong begin = first - first % LANES + (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)last);
    for (ulong p = begin; p < end; p += LANES) {
        uint index[LANES]; // lanes without a pixel of the sample read that of another
        int wanted[LANES];
        for (uint lane = 0; lane < LANES; ++lane) {
            const uint chosen = clamp((uint)p + lane, first, last - 1);
            index[lane] = chosen - first;
            wanted[lane] = chosen == p + lane ? -1 : 0;
        }
        real values[SUMS], pixel[FILM_FLOATS];
        load_part(part0, index, values);
#if LIGHTS > 1
        load_part(part1, index, values + 3);
#endif
#if LIGHTS > 2
        load_part(part2, index, values + 6);
#endif
#if AO
        float fraction[LANES];
        for (uint lane = 0; lane < LANES; ++lane) fraction[lane] = ao[index[lane]];
        values[3 * LIGHTS] = LOAD_LANES(fraction);
#endif
        global float* packet = film + (size_t)(p / 8) * 8 * FILM_FLOATS + p % 8;
        for (uint k = 0; k < FILM_FLOATS; ++k) pixel[k] = LOAD_LANES(packet + 8 * k);
        add_sample(LOAD_LANES(wanted), values, pixel);
        for (uint k = 0; k < FILM_FLOATS; ++k) STORE_LANES(pixel[k], packet + 8 * k);
    }
}
