// SPDX-License-Identifier: MIT
// Which of consecutive segments an element is in, by binary search: O(log segments).
#ifndef BOXWOOD_PRIMITIVES_SEGMENTS_H
#define BOXWOOD_PRIMITIVES_SEGMENTS_H

/// The last segment that starts at or before element `i`. `starts` holds `segments` > 0 ascending entries, the first at
/// most i.
static inline uint segment_of(global const uint* starts, uint segments, uint i) {
    uint low = 0, high = segments;
    while (high - low > 1) {
        const uint middle = low + (high - low) / 2;
        if (starts[middle] <= i)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/// The first segment that ends after element `i`, `segments` if there is none. `offsets` holds segments + 1 ascending
/// entries, which may begin after i.
static inline uint segment_ending_after(global const uint* offsets, uint segments, uint i) {
    uint low = 0, high = segments;
    while (low < high) {
        const uint middle = low + (high - low) / 2;
        if (offsets[middle + 1] > i)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

#endif
