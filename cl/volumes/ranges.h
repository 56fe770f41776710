// SPDX-License-Identifier: MIT
// Reading trees laid end to end (see Topology in include/boxwood/topology.hpp).
#ifndef BOXWOOD_VOLUMES_RANGES_H
#define BOXWOOD_VOLUMES_RANGES_H
#include "shared/types.h"

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

/// Primitives below any node, leaves among them.
inline uint node_size(uint node, global const uint* far_ends, uint count) {
    return node < count ? range_size(node, far_ends) : 1;
}

#endif
