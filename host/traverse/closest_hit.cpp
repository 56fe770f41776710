// SPDX-License-Identifier: MIT
#include <limits>
#include <span>
#include <vector>

#include "boxwood/trace.hpp"
#include "traverse/specialise.hpp"

namespace boxwood {

namespace {

void write_misses(Device& device, BufferView<Hit> hits) {
    const Hit miss{std::numeric_limits<float>::infinity(), 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
    const std::vector<Hit> misses(hits.size(), miss);
    write(device, std::span<const Hit>(misses), hits);
}

void trace(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
           BufferView<RayStatistics> statistics, Query query, const TraceOptions& options) {
    const BufferView<const std::uint32_t> starts = tree.arrays().first_triangles;
    const auto instance_count = static_cast<std::uint32_t>(starts.size() == 0 ? 0 : starts.size() - 1);
    launch_traversal(device, traversal_kernel(tree, query, options), "closest hit", tree, rays, starts, instance_count,
                     hits, statistics);
}

} // namespace

void closest_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
                 const TraceOptions& options) {
    if (tree.empty()) return write_misses(device, hits);
    trace(device, tree, rays, hits, {}, Query::closest, options);
}

void closest_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
                 BufferView<RayStatistics> statistics, const TraceOptions& options) {
    if (tree.empty()) {
        const std::vector<RayStatistics> none(statistics.size());
        write(device, std::span<const RayStatistics>(none), statistics);
        return write_misses(device, hits);
    }
    trace(device, tree, rays, hits, statistics, Query::closest_with_statistics, options);
}

} // namespace boxwood
