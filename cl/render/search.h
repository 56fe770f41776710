// SPDX-License-Identifier: MIT
// Choosing one of many by chance.
#ifndef BOXWOOD_RENDER_SEARCH_H
#define BOXWOOD_RENDER_SEARCH_H
#include "runtime/inline.h"

/// Chooses one of `count` > 0 elements: element i with the probability distribution[i + 1] - distribution[i], where the
/// `count` + 1 values ascend from 0 to 1. `u` in [0, 1) becomes what is left of it, uniform in [0, 1) again. O(log count).
INLINE uint choose(global const float* distribution, uint count, float* u, float* probability) {
    uint low = 0;
    for (uint left = count; left > 1;) {
        // Which way it goes cannot be foreseen: no branch. Floats that are not negative compare as their bits do, and these
        // are at most those of 1, so that the difference has the sign.
        const uint step = left >> 1;
        const int below = (as_int(*u) - as_int(distribution[low + step])) >> 31;
        low += step & ~(uint)below;
        left -= step;
    }
    // With 0 and 1 at the ends and u below 1, low is an element of a probability that is not 0.
    const float first = distribution[low];
    *probability = distribution[low + 1] - first;
    const float rest = (*u - first) / *probability;
    *u = rest < 1.0f ? rest : 0x1.fffffep-1f;
    return low;
}

#endif
