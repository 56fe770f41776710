// SPDX-License-Identifier: MIT
#include "metrics/overlap.hpp"

#include <algorithm>
#include <numeric>

#include "metrics/quality.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

struct Sampled {
    double overlap = 0.0;
    std::uint64_t visits = 0; ///< Nodes looked at.
};

Sampled sample(Device& device, const BinaryTrees& trees, BufferView<const Triangle> triangles, float unit,
               std::uint32_t samples) {
    const Topology& topology = trees.topology;
    Buffer<float> fractions = make_scratch<float>(device, samples, "fractions of triangles in nodes");
    Buffer<float> areas = make_scratch<float>(device, samples, "areas of triangles");
    Buffer<std::uint32_t> visits = make_scratch<std::uint32_t>(device, samples, "nodes looked at");
    const bool oriented = trees.boxes.size() > 0;
    Buffer<Obb> none = make_scratch<Obb>(device, oriented ? 0 : 1, "no oriented boxes");
    launch(device, {"metrics/overlap.cl", "end_point_overlap", {{"ORIENTED", oriented ? "1" : "0"}}},
           "end-point overlap", samples, topology.children, topology.parents, topology.far_ends, topology.offsets,
           trees.volumes, oriented ? trees.boxes.view() : none.view(), triangles, fractions, areas, visits, unit,
           static_cast<std::uint32_t>(topology.trees()), static_cast<std::uint32_t>(topology.size()), samples);
    const std::vector<float> fraction = download(device, fractions), area = download(device, areas);
    double inside = 0.0, total = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        inside += static_cast<double>(fraction[i]) * area[i];
        total += area[i];
    }
    const std::vector<std::uint32_t> visited = download(device, visits);
    return {total > 0.0 ? inside / total : 0.0, std::accumulate(visited.begin(), visited.end(), std::uint64_t{0})};
}

} // namespace

double end_point_overlap(Device& device, const BinaryTrees& trees, BufferView<const Triangle> triangles) {
    const Stage stage(device, "quality");
    const float unit = unit_of_lengths(device, trees);
    const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(trees.topology.size(), overlap_samples));
    // Where triangles lie on each other, each visits all the others' nodes: what few samples cost says how many to
    // take.
    std::uint32_t samples = std::min<std::uint32_t>(most, overlap_samples / 256);
    Sampled result = sample(device, trees, triangles, unit, samples);
    while (samples < most && 4 * result.visits <= overlap_visits) {
        samples = std::min(most, 4 * samples);
        result = sample(device, trees, triangles, unit, samples);
    }
    return result.overlap;
}

} // namespace boxwood
