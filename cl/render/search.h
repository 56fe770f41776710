// SPDX-License-Identifier: MIT
// Samples one of many alternatives in proportion to their probability.
#ifndef BOXWOOD_RENDER_SEARCH_H
#define BOXWOOD_RENDER_SEARCH_H
#include "runtime/real.h"

/// Chooses one of `count` > 0 elements in each lane, by row[lane] of the distributions of `count` + 1 values each,
/// which ascend from 0 to 1: element i with the probability distribution[i + 1] - distribution[i]. `u` in [0, 1)
/// becomes what is left of it, uniform in [0, 1) again. O(log count). Any u, even NaN, gives an element.
INLINE void choose(global const float* distributions, uint count, const uint* row, real* u, uint* index,
                   real* probability) {
    // Which way it goes cannot be foreseen: no branch. Floats that are not negative compare as their bits do, and these
    // are at most those of 1, so that the difference has the sign.
    int bits[LANES];
    STORE_LANES(AS_INT(*u), bits);
    global const float* start[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        start[lane] = distributions + (size_t)row[lane] * (count + 1);
        index[lane] = 0;
    }
    for (uint left = count; left > 1; left -= left >> 1) {
        const uint step = left >> 1;
        for (uint lane = 0; lane < LANES; ++lane) {
            const int below = (bits[lane] - as_int(start[lane][index[lane] + step])) >> 31;
            index[lane] += step & ~(uint)below;
        }
    }
    // With 0 and 1 at the ends and u below 1, that is an element of a probability that is not 0.
    float low[LANES], high[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        low[lane] = start[lane][index[lane]];
        high[lane] = start[lane][index[lane] + 1];
    }
    const real first = LOAD_LANES(low);
    *probability = LOAD_LANES(high) - first;
    *u = GREATER(LESSER((*u - first) / *probability, (real)(BEFORE_ONE)), (real)(0.0f));
}

#endif
