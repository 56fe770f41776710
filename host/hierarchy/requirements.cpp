// SPDX-License-Identifier: MIT
#include "boxwood/requirements.hpp"

namespace boxwood {

Requirements requirements(const Scene& scene, const BuildOptions& options) {
    Requirements needs;
    const bool shared = scene.instanced_triangle_count() > scene.triangle_count();
    needs.two_levels = options.levels == Levels::two || (options.levels == Levels::automatic && shared);
    needs.instance_lookup = !needs.two_levels && scene.instances.size() > 1;
    needs.oriented_boxes = options.bounds.kind != Bounds::aabb;
    return needs;
}

std::vector<std::string> words(const Requirements& needs) {
    std::vector<std::string> result;
    if (needs.two_levels) result.push_back("two-levels");
    if (needs.instance_lookup) result.push_back("instance-lookup");
    if (needs.oriented_boxes) result.push_back("oriented-boxes");
    return result;
}

} // namespace boxwood
