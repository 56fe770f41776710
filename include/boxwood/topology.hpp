// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <CL/cl.h>

#include "boxwood/buffer.hpp"

namespace boxwood {

/// The shape of binary trees over n primitives, apart from any volumes. Trees are concatenated: tree t
/// holds the primitives at the sorted positions [offsets[t], offsets[t + 1]), at least one.
///
/// Node indices: inner nodes in [0, n), the leaf of sorted position i is n + i. A tree over positions [a, b) has its
/// b - a - 1 inner nodes in [a, b - 1) and its root at a; index b - 1 is an unused slot. The inner node of a left child
/// has the index of its range's last position, that of a right child of its first (Karras 2012). A tree of one
/// primitive has no inner node: its only node is the leaf n + a.
struct Topology {
    Buffer<std::uint32_t> offsets;  ///< trees + 1
    Buffer<std::uint32_t> order;    ///< n: the primitive at each sorted position.
    Buffer<cl_uint2> children;      ///< n: left and right child of each inner node; unused slots hold BOXWOOD_NONE.
    Buffer<std::uint32_t> parents;  ///< 2n: BOXWOOD_NONE for roots and unused slots.
    Buffer<std::uint32_t> far_ends; ///< n: the other end of each inner node's range of positions; unused slots: own.

    std::size_t size() const { return order.size(); }
    std::size_t trees() const { return offsets.size() - 1; }
};

} // namespace boxwood
