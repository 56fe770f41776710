// SPDX-License-Identifier: MIT
#include "build/trees.hpp"

#include <utility>

#include "boxwood/radix_sort.hpp"
#include "boxwood/volumes.hpp"
#include "build/lbvh.hpp"
#include "build/morton_runs.hpp"
#include "build/topdown.hpp"

namespace boxwood {

namespace {

/// Launches count under `stage`, or under their `own` where that is empty.
Stage named(Device& device, const std::string& stage, const char* own) {
    return Stage(device, stage.empty() ? own : stage);
}

template <class Key>
Topology lbvh_topology(Device& device, BufferView<const Aabb> boxes, Buffer<std::uint32_t> offsets,
                       BufferView<const Aabb> tree_bounds, KeyFormat format, const std::string& stage) {
    Buffer<Key> keys = make_scratch<Key>(device, boxes.size(), "Morton keys");
    Buffer<std::uint32_t> order = make_scratch<std::uint32_t>(device, boxes.size(), "sorted order");
    {
        const Stage morton = named(device, stage, "morton");
        morton_keys(device, boxes, offsets, tree_bounds, format, keys, order);
    }
    {
        const Stage sort = named(device, stage, "sort");
        radix_sort(device, keys, order, 0, format.key_bits);
    }
    const Stage hierarchy = named(device, stage, "hierarchy");
    Buffer<Gap> gaps = key_gaps<Key>(device, keys, format, offsets.size() - 1);
    partition_long_runs<Key>(device, boxes, keys, format, offsets, order, gaps);
    return radix_trees(device, gaps, std::move(order), std::move(offsets));
}

Buffer<Aabb> measure_bounds(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets,
                            const std::string& stage) {
    const Stage bounds = named(device, stage, "bounds");
    return bounds_of_trees(device, boxes, offsets);
}

Buffer<Aabb> fit_volumes(Device& device, const Topology& topology, BufferView<const Aabb> boxes,
                         const std::string& stage) {
    const Stage volumes = named(device, stage, "volumes");
    return aabb_volumes(device, topology, boxes);
}

} // namespace

BinaryTrees lbvh_trees(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                       MortonBits morton, const std::string& stage) {
    const std::size_t count = offsets.size() - 1;
    const KeyFormat format = key_format(morton, count);
    // Short keys sort faster; those of several trees need room for the tree above the code.
    const auto topology_of =
        count == 1 && format.key_bits <= 32 ? lbvh_topology<std::uint32_t> : lbvh_topology<std::uint64_t>;
    Buffer<std::uint32_t> starts = upload(device, offsets, "offsets of trees");
    BinaryTrees trees;
    trees.tree_bounds = measure_bounds(device, boxes, starts, stage);
    trees.topology = topology_of(device, boxes, std::move(starts), trees.tree_bounds, format, stage);
    trees.volumes = fit_volumes(device, trees.topology, boxes, stage);
    return trees;
}

BinaryTrees topdown_trees(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                          const TopDownOptions& options, const std::string& stage,
                          BufferView<const InfluenceRecord> areas, BufferView<const std::uint32_t> area_starts) {
    Buffer<std::uint32_t> starts = upload(device, offsets, "offsets of trees");
    BinaryTrees trees;
    trees.tree_bounds = measure_bounds(device, boxes, starts, stage);
    {
        const Stage hierarchy = named(device, stage, "hierarchy");
        trees.topology =
            topdown_within(device, boxes, {}, std::move(starts), trees.tree_bounds, areas, area_starts, options, false)
                .topology;
    }
    trees.volumes = fit_volumes(device, trees.topology, boxes, stage);
    return trees;
}

} // namespace boxwood
