// SPDX-License-Identifier: MIT
#include "traverse/area_checks.hpp"

#include <doctest/doctest.h>

namespace boxwood::test {

Ray ray_of(const glm::dvec3& origin, const glm::dvec3& direction, float t_max) {
    const glm::vec3 o(origin), d(direction);
    return {{o.x, o.y, o.z}, 0.0f, {d.x, d.y, d.z}, t_max};
}

TreeImage built(const Scene& scene, Layout layout, const std::vector<InfluenceArea>& areas, AreaIndexKind index,
                BuildReport* report) {
    BuildOptions options;
    options.levels = Levels::one;
    options.layout = layout;
    options.areas = areas;
    options.area_index = index;
    return download(test_device(), build(test_device(), scene, options, report));
}

Searches check_areas(const Scene& scene, const std::vector<InfluenceArea>& areas, const std::vector<Ray>& rays,
                     const std::vector<Hit>& expected) {
    Searches searches;
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        for (const AreaIndexKind index : {AreaIndexKind::list, AreaIndexKind::octree, AreaIndexKind::kd}) {
            CAPTURE(std::string(name(layout)));
            CAPTURE(std::string(name(index)));
            const TreeImage tree = built(scene, layout, areas, index);
            CHECK_NOTHROW(validate(tree, scene, "tree"));
            std::vector<RayStatistics> statistics;
            CHECK(count_different(trace(tree, rays), expected) == 0);
            CHECK(count_different(trace(tree, rays, statistics), expected) == 0);
            const std::vector<std::uint32_t> any = trace_any(tree, rays);
            std::size_t disagreeing = 0;
            searches = {};
            for (std::size_t i = 0; i < rays.size(); ++i) {
                disagreeing += any[i] != (expected[i].primitive == BOXWOOD_NONE ? 0u : 1u);
                searches.local += statistics[i].areas == 2;
                searches.continued += statistics[i].areas == 1;
            }
            CHECK(disagreeing == 0);
        }
    }
    return searches;
}

std::uint32_t ray_count(std::uint32_t count) { return small_sizes() ? 60 : count; }

} // namespace boxwood::test
