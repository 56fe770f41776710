// SPDX-License-Identifier: MIT
// Oracles for the shape of binary trees: a plain top-down builder, and a checker of what Topology promises.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/topology.hpp"

namespace boxwood::test {

/// A Topology in host arrays.
struct HostTopology {
    std::vector<std::uint32_t> offsets, order;
    std::vector<cl_uint2> children;
    std::vector<std::uint32_t> parents, far_ends;

    std::uint32_t size() const { return static_cast<std::uint32_t>(order.size()); }
    std::uint32_t trees() const { return static_cast<std::uint32_t>(offsets.size() - 1); }
    /// Root of tree `tree`: an inner node, or the leaf of a tree of one primitive.
    std::uint32_t root(std::uint32_t tree) const {
        const std::uint32_t first = offsets[tree];
        return offsets[tree + 1] - first == 1 ? size() + first : first;
    }
};

HostTopology to_host(Device& device, const Topology& topology);

/// Children of each node of a layout with a node for each position: those of the inner node, or for a root over one
/// primitive that leaf and BOXWOOD_NONE.
std::vector<cl_uint2> layout_children(const HostTopology& topology);

/// Positions [first, last] below a node.
struct Span {
    std::uint32_t first, last;
};
Span span_of(const HostTopology& topology, std::uint32_t node);

/// Karras's radix trees over sorted keys, built from the roots down: a range is parted at the highest bit in which its
/// first and last key differ, a range of equal keys at the highest bit in which its first and last position differ.
HostTopology reference_topology(const std::vector<std::uint64_t>& keys, std::vector<std::uint32_t> order,
                                std::vector<std::uint32_t> offsets);

/// The same from the gaps after sorted positions: a range is parted after the position with the largest gap.
HostTopology reference_topology_of_gaps(const std::vector<std::uint64_t>& gaps, std::vector<std::uint32_t> order,
                                        std::vector<std::uint32_t> offsets);

/// The first node in which two topologies differ, in words; "" when they are equal.
std::string difference(const HostTopology& a, const HostTopology& b);

/// What `topology` breaks of the promises of Topology over sorted `keys`, in words; "" when it keeps them all: the
/// order is a permutation within each tree, every node but a root is the child of its parent and of no other, ranges of
/// children are the two parts of their parent's, indices follow the rule, parts are at the highest differing bit,
/// unused slots hold what they should.
std::string broken_promise(const HostTopology& topology, const std::vector<std::uint64_t>& keys);

} // namespace boxwood::test
