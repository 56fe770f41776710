// SPDX-License-Identifier: MIT
#include "boxwood/requirements.hpp"

#include "boxwood/rounding.hpp"
#include "scene/element.hpp"
#include "scene/shading_reasons.hpp"

namespace boxwood {

namespace {

bool shares_meshes(const Scene& scene) { return scene.instanced_triangle_count() > scene.triangle_count(); }

} // namespace

Requirements requirements(const Scene& scene, const BuildOptions& options) {
    Requirements needs;
    needs.two_levels = options.levels == Levels::two || (options.levels == Levels::automatic && options.areas.empty() &&
                                                         (shares_meshes(scene) || worst_rounding(scene)));
    needs.instance_lookup = !needs.two_levels && scene.instances.size() > 1;
    needs.oriented_boxes = options.bounds.kind != Bounds::aabb;
    needs.influence_areas = !options.areas.empty() && options.builder != Builder::blend;
    return needs;
}

namespace {

std::string two_levels_because(const Scene& scene, const BuildOptions& options) {
    if (options.levels == Levels::two) return "the options ask for two levels";
    if (!shares_meshes(scene)) return "one level would move vertices of " + words(*worst_rounding(scene), scene);
    std::vector<std::uint64_t> placed(scene.meshes.size(), 0);
    for (const Instance& instance : scene.instances) ++placed[instance.mesh];
    std::size_t i = 0;
    while (placed[i] < 2) ++i;
    return element("meshes", i, scene.meshes[i].name) + " is placed " + std::to_string(placed[i]) + " times";
}

} // namespace

std::vector<Reason> reasons(const Scene& scene, const BuildOptions& options) {
    const Requirements needs = requirements(scene, options);
    std::vector<Reason> result;
    if (needs.two_levels) result.push_back({"two-levels", two_levels_because(scene, options)});
    if (needs.instance_lookup)
        result.push_back(
            {"instance-lookup", "one level holds " + std::to_string(scene.instances.size()) + " instances"});
    if (needs.oriented_boxes)
        result.push_back({"oriented-boxes", "the options ask for " + std::string(name(options.bounds.kind))});
    if (needs.influence_areas)
        result.push_back({"influence-areas", "areas with trees of their own: " + std::to_string(options.areas.size())});
    const std::vector<Reason> shading = shading_reasons(scene);
    result.insert(result.end(), shading.begin(), shading.end());
    return result;
}

std::vector<std::string> words(const Requirements& needs) {
    std::vector<std::string> result;
    if (needs.two_levels) result.push_back("two-levels");
    if (needs.instance_lookup) result.push_back("instance-lookup");
    if (needs.oriented_boxes) result.push_back("oriented-boxes");
    if (needs.influence_areas) result.push_back("influence-areas");
    return result;
}

} // namespace boxwood
