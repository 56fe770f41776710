// SPDX-License-Identifier: MIT
#include "hierarchy/forest.hpp"

#include <utility>

#include "boxwood/radix_sort.hpp"
#include "boxwood/reduce.hpp"
#include "boxwood/segmented_reduce.hpp"
#include "boxwood/volumes.hpp"
#include "hierarchy/lbvh.hpp"
#include "hierarchy/morton_runs.hpp"
#include "hierarchy/topdown.hpp"

namespace boxwood {

namespace {

/// Launches count under `stage`, or under their `own` where that is empty.
Stage named(Device& device, const std::string& stage, const char* own) {
    return Stage(device, stage.empty() ? own : stage);
}

template <class Key>
Forest build_with_keys(Device& device, BufferView<const Aabb> boxes, Buffer<std::uint32_t> offsets, KeyFormat format,
                       const std::string& stage) {
    Forest forest;
    {
        const Stage bounds = named(device, stage, "bounds");
        forest.tree_bounds = bounds_of_trees(device, boxes, offsets);
    }
    Buffer<Key> keys = make_scratch<Key>(device, boxes.size(), "Morton keys");
    Buffer<std::uint32_t> order = make_scratch<std::uint32_t>(device, boxes.size(), "sorted order");
    {
        const Stage morton = named(device, stage, "morton");
        morton_keys<Key>(device, boxes, offsets, forest.tree_bounds, format, keys, order);
    }
    {
        const Stage sort = named(device, stage, "sort");
        radix_sort<Key>(device, keys, order, 0, format.key_bits);
    }
    {
        const Stage hierarchy = named(device, stage, "hierarchy");
        const Buffer<Gap> gaps = key_gaps<Key>(device, keys, format, offsets.size() - 1);
        part_long_runs<Key>(device, boxes, keys, format, offsets, order, gaps);
        forest.topology = radix_trees(device, gaps, std::move(order), std::move(offsets));
    }
    const Stage volumes = named(device, stage, "volumes");
    forest.volumes = aabb_volumes(device, forest.topology, boxes);
    return forest;
}

} // namespace

Buffer<Aabb> bounds_of_trees(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets) {
    const std::size_t trees = offsets.size() - 1;
    Buffer<Aabb> bounds = make_scratch<Aabb>(device, trees, "bounds of trees");
    if (trees == 1)
        reduce<Aabb>(device, boxes, Operator::sum, bounds);
    else
        segmented_reduce<Aabb>(device, boxes, offsets, Operator::sum, bounds);
    return bounds;
}

Forest build_forest(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                    MortonBits morton, const std::string& stage) {
    const std::size_t trees = offsets.size() - 1;
    const KeyFormat format = key_format(morton, trees);
    Buffer<std::uint32_t> starts = upload(device, offsets, "offsets of trees");
    // Short keys sort faster; those of a forest need room for the tree above the code.
    if (trees == 1 && format.key_bits <= 32)
        return build_with_keys<std::uint32_t>(device, boxes, std::move(starts), format, stage);
    return build_with_keys<std::uint64_t>(device, boxes, std::move(starts), format, stage);
}

Forest build_forest(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                    const TopDownOptions& options, const std::string& stage, BufferView<const InfluenceRecord> areas,
                    BufferView<const std::uint32_t> area_starts) {
    Buffer<std::uint32_t> starts = upload(device, offsets, "offsets of trees");
    Forest forest;
    {
        const Stage bounds = named(device, stage, "bounds");
        forest.tree_bounds = bounds_of_trees(device, boxes, starts);
    }
    {
        const Stage hierarchy = named(device, stage, "hierarchy");
        forest.topology =
            topdown_within(device, boxes, {}, std::move(starts), forest.tree_bounds, areas, area_starts, options, false)
                .topology;
    }
    const Stage volumes = named(device, stage, "volumes");
    forest.volumes = aabb_volumes(device, forest.topology, boxes);
    return forest;
}

} // namespace boxwood
