// SPDX-License-Identifier: MIT
#include "build/lbvh.hpp"

#include <utility>

#include "boxwood/lbvh.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

template <class Key>
Buffer<Gap> key_gaps(Device& device, BufferView<const Key> keys, KeyFormat format, std::size_t trees) {
    Buffer<Gap> gaps = make_scratch<Gap>(device, keys.size(), "gaps after positions");
    const Slices slices = cut(device, keys.size());
    const KernelRef kernel{"build/morton_runs.cl",
                           "key_gaps",
                           {{"KEY", sizeof(Key) == 4 ? "uint" : "ulong"},
                            {"TREE_IN_KEY", trees > 1 ? "1" : "0"},
                            {"CODE_BITS", std::to_string(format.code_bits)}}};
    launch(device, kernel, "gaps", slices.slices, keys, gaps, gap_rank(0), static_cast<std::uint32_t>(keys.size()),
           slices.length);
    return gaps;
}

Topology radix_trees(Device& device, BufferView<const Gap> gaps, Buffer<std::uint32_t> order,
                     Buffer<std::uint32_t> offsets) {
    const std::size_t count = gaps.size();
    Topology topology;
    topology.order = std::move(order);
    topology.offsets = std::move(offsets);
    topology.children = make_scratch<cl_uint2>(device, count, "children of nodes");
    topology.parents = make_scratch<std::uint32_t>(device, 2 * count, "parents of nodes");
    topology.far_ends = make_scratch<std::uint32_t>(device, count, "ranges of nodes");

    Buffer<std::uint32_t> outer_ends = make_scratch<std::uint32_t>(device, 2 * count, "ends beside splits");
    Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(device, count, "arrivals at splits");
    fill(device, arrivals, 0);
    const Slices slices = cut(device, count);
    launch(device, {"build/lbvh.cl", "lbvh"}, "radix tree", slices.slices, gaps, topology.children, topology.parents,
           topology.far_ends, outer_ends, arrivals, static_cast<std::uint32_t>(count), slices.length);
    return topology;
}

template <class Key>
Topology detail::lbvh(Device& device, BufferView<const Key> keys, KeyFormat format, Buffer<std::uint32_t> order,
                      Buffer<std::uint32_t> offsets) {
    const Buffer<Gap> gaps = key_gaps<Key>(device, keys, format, offsets.size() - 1);
    return radix_trees(device, gaps, std::move(order), std::move(offsets));
}

template Buffer<Gap> key_gaps<std::uint32_t>(Device&, BufferView<const std::uint32_t>, KeyFormat, std::size_t);
template Buffer<Gap> key_gaps<std::uint64_t>(Device&, BufferView<const std::uint64_t>, KeyFormat, std::size_t);
template Topology detail::lbvh<std::uint32_t>(Device&, BufferView<const std::uint32_t>, KeyFormat,
                                              Buffer<std::uint32_t>, Buffer<std::uint32_t>);
template Topology detail::lbvh<std::uint64_t>(Device&, BufferView<const std::uint64_t>, KeyFormat,
                                              Buffer<std::uint32_t>, Buffer<std::uint32_t>);

} // namespace boxwood
