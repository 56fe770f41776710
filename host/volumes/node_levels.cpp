// SPDX-License-Identifier: MIT
#include "volumes/node_levels.hpp"

#include <bit>

#include "boxwood/radix_sort.hpp"
#include "boxwood/reduce.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

NodeHeights node_heights(Device& device, const Topology& topology) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    NodeHeights result{make_scratch<std::uint32_t>(device, count, "heights of nodes")};
    Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(device, count, "arrivals at splits");
    Buffer<std::uint32_t> greatest = make_scratch<std::uint32_t>(device, 1, "greatest height");
    fill(device, result.heights, 0);
    fill(device, arrivals, 0);
    const Slices slices = cut(device, count);
    launch(device, {"volumes/depth.cl", "node_heights"}, "node heights", slices.slices, topology.children,
           topology.parents, topology.far_ends, arrivals, result.heights, count, slices.length);
    reduce(device, result.heights, Operator::max, greatest);
    result.greatest = download(device, greatest)[0];
    return result;
}

NodeLevels node_levels(Device& device, const Topology& topology) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    auto [heights, greatest] = node_heights(device, topology);
    NodeLevels levels{make_scratch<std::uint32_t>(device, count, "nodes by height"), {}};
    const Slices slices = cut(device, count);
    launch(device, {"volumes/levels.cl", "number"}, "numbers", slices.slices, levels.nodes, count, slices.length);
    radix_sort(device, heights, levels.nodes, 0, static_cast<int>(std::bit_width(greatest)));
    Buffer<std::uint32_t> starts = make_scratch<std::uint32_t>(device, greatest + 2, "starts of levels");
    launch(device, {"volumes/levels.cl", "level_starts"}, "starts of levels", slices.slices, heights, starts, count,
           slices.length);
    levels.starts = download(device, starts);
    levels.starts[0] = 0;
    levels.starts[greatest + 1] = count;
    return levels;
}

} // namespace boxwood
