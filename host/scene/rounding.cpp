// SPDX-License-Identifier: MIT
#include "boxwood/rounding.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "scene/element.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// The largest extent of `bounds` where `transform` has its corners: half-axes add up by magnitude.
double placed_size(const glm::dmat4& transform, const MeshBounds& bounds) {
    const glm::dvec3 extents = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
    glm::dvec3 placed(0.0);
    for (int axis = 0; axis < 3; ++axis) placed += glm::abs(glm::dvec3(transform[axis])) * extents[axis];
    return largest(placed);
}

/// At least what a vertex within `bounds` is moved by: half a unit in the last place, that is 2^-24 of the largest
/// coordinate that it can have, or half the least denormal.
double distance_bound(const glm::dmat4& transform, const MeshBounds& bounds) {
    const glm::dvec3 reach(glm::max(glm::abs(bounds.min), glm::abs(bounds.max)));
    glm::dvec3 farthest = glm::abs(glm::dvec3(transform[3]));
    for (int axis = 0; axis < 3; ++axis) farthest += glm::abs(glm::dvec3(transform[axis])) * reach[axis];
    return std::max(0x1p-24 * largest(farthest), 0x1p-150);
}

double distance_of(const glm::dmat4& transform, const std::vector<glm::vec3>& positions) {
    const glm::dmat3 linear(transform);
    const glm::dvec3 place(transform[3]);
    glm::dvec3 distance(0.0);
    for (const glm::vec3& position : positions) {
        // The difference of floats comes first: double rounds the sum too, and of a mesh of 1e-20 at 1 leaves nothing.
        const glm::dvec3 offset = linear * glm::dvec3(position);
        const glm::dvec3 rounded(glm::vec3(place + offset));
        distance = glm::max(distance, glm::abs((place - rounded) + offset));
    }
    return largest(distance);
}

} // namespace

Rounding rounding_of(const Scene& scene, std::uint32_t instance) {
    const Instance& placed = scene.instances[instance];
    const std::vector<glm::vec3>& positions = scene.meshes[placed.mesh].positions;
    const glm::dmat4 transform(placed.transform);
    return {instance, distance_of(transform, positions), placed_size(transform, mesh_bounds(positions))};
}

std::optional<Rounding> worst_rounding(const Scene& scene) {
    std::optional<Rounding> worst;
    std::vector<std::optional<MeshBounds>> bounds(scene.meshes.size());
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.transform == glm::mat4(1.0f)) continue;
        const std::vector<glm::vec3>& positions = scene.meshes[instance.mesh].positions;
        std::optional<MeshBounds>& box = bounds[instance.mesh];
        if (!box) box = mesh_bounds(positions);
        const glm::dmat4 transform(instance.transform);
        const double largest_fraction = worst ? worst->fraction() : rounding_limit;
        Rounding rounding{i, distance_bound(transform, *box), placed_size(transform, *box)};
        if (rounding.fraction() <= largest_fraction) continue;
        rounding.distance = distance_of(transform, positions);
        if (rounding.fraction() > largest_fraction) worst = rounding;
    }
    return worst;
}

bool collapses(const Scene& scene) {
    std::vector<std::optional<MeshBounds>> bounds(scene.meshes.size());
    bool some = false;
    for (const Instance& instance : scene.instances) {
        std::optional<MeshBounds>& box = bounds[instance.mesh];
        if (!box) box = mesh_bounds(scene.meshes[instance.mesh].positions);
        const glm::dmat4 transform(instance.transform);
        const double size = placed_size(transform, *box);
        if (distance_bound(transform, *box) < 0.5 * size) return false;
        some = some || size > 0.0;
    }
    return some;
}

std::string words(const Rounding& rounding, const Scene& scene) {
    const std::uint32_t mesh = scene.instances[rounding.instance].mesh;
    std::ostringstream text;
    text << std::setprecision(2) << element("instances", rounding.instance, "") << " of "
         << element("meshes", mesh, scene.meshes[mesh].name) << " by up to " << rounding.distance << " units, "
         << 100.0 * rounding.fraction() << " % of its size";
    return text.str();
}

} // namespace boxwood
