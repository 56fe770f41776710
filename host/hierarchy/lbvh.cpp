// SPDX-License-Identifier: MIT
#include "boxwood/lbvh.hpp"

#include <utility>

#include "runtime/launch.hpp"

namespace boxwood {

template <class Key>
Topology lbvh(Device& device, BufferView<const Key> keys, KeyFormat format, Buffer<std::uint32_t> order,
              Buffer<std::uint32_t> offsets) {
    const std::size_t count = keys.size();
    Topology topology;
    topology.order = std::move(order);
    topology.offsets = std::move(offsets);
    topology.children = make_scratch<cl_uint2>(device, count, "children of nodes");
    topology.parents = make_scratch<std::uint32_t>(device, 2 * count, "parents of nodes");
    topology.far_ends = make_scratch<std::uint32_t>(device, count, "ranges of nodes");

    const Buffer<std::uint32_t> outer_ends = make_scratch<std::uint32_t>(device, 2 * count, "ends beside splits");
    const Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(device, count, "arrivals at splits");
    fill<std::uint32_t>(device, arrivals, 0);
    const Slices slices = cut(device, count);
    const KernelRef kernel{"hierarchy/lbvh.cl",
                           "lbvh",
                           {{"KEY", sizeof(Key) == 4 ? "uint" : "ulong"},
                            {"FOREST", topology.trees() > 1 ? "1" : "0"},
                            {"CODE_BITS", std::to_string(format.code_bits)}}};
    launch(device, kernel, "radix tree", slices.slices, keys, topology.children, topology.parents, topology.far_ends,
           outer_ends, arrivals, static_cast<std::uint32_t>(count), slices.length);
    return topology;
}

template Topology lbvh<std::uint32_t>(Device&, BufferView<const std::uint32_t>, KeyFormat, Buffer<std::uint32_t>,
                                      Buffer<std::uint32_t>);
template Topology lbvh<std::uint64_t>(Device&, BufferView<const std::uint64_t>, KeyFormat, Buffer<std::uint32_t>,
                                      Buffer<std::uint32_t>);

} // namespace boxwood
