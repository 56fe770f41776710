// SPDX-License-Identifier: MIT
// Reading a forest of trees laid end to end (see Topology in include/boxwood/topology.hpp).
#ifndef BOXWOOD_HIERARCHY_FOREST_H
#define BOXWOOD_HIERARCHY_FOREST_H
#include "shared/types.h"

/// The tree that holds element `i`: the last one that starts at or before it. Trees are not empty. O(log trees).
inline uint tree_of(global const uint* offsets, uint trees, uint i) {
    uint low = 0, high = trees;
    while (high - low > 1) {
        const uint middle = (low + high) / 2;
        if (offsets[middle] <= i) low = middle;
        else high = middle;
    }
    return low;
}

/// First and last sorted position below a node.
inline uint2 range_of(uint node, global const uint* far_ends, uint count) {
    if (node >= count) return (uint2)(node - count, node - count);
    const uint other = far_ends[node];
    return (uint2)(min(node, other), max(node, other));
}

/// Primitives below inner node `node`.
inline uint range_size(uint node, global const uint* far_ends) {
    const uint other = far_ends[node];
    return (other > node ? other - node : node - other) + 1;
}

#endif
