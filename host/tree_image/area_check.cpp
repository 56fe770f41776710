// SPDX-License-Identifier: MIT
#include "tree_image/area_check.hpp"

#include <cmath>
#include <initializer_list>

#include "boxwood/error.hpp"
#include "tree_image/tree_walker.hpp"

namespace boxwood {

namespace {

using namespace detail::tree_check;

/// Unit length and right angles but for the rounding of their components.
bool is_orthonormal(const InfluenceRecord& region) {
    const float(*axes[3])[3] = {&region.right, &region.up, &region.forward};
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            double product = i == j ? -1.0 : 0.0;
            for (int k = 0; k < 3; ++k) product += static_cast<double>((*axes[i])[k]) * (*axes[j])[k];
            if (!(std::abs(product) < 0x1p-16)) return false; // NaN too
        }
    }
    return true;
}

const char* wrong_with(const LocalArea& area) {
    const InfluenceRecord& region = area.region;
    const auto finite = [](std::initializer_list<float> values) { return all_finite(values); };
    if (region.point > 1) return "is neither a plane nor a point area";
    if (!all_finite(region.origin) || !is_orthonormal(region)) return "has axes that are not finite and orthonormal";
    if (!finite({region.half_width, region.half_height, region.near, region.far, region.sin_tolerance, region.share}))
        return "is not finite";
    if (region.half_width <= 0.0f || region.half_height <= 0.0f) return "has no extent";
    if (region.near < 0.0f || region.far <= region.near) return "does not reach from near to far";
    if (region.sin_tolerance < 0.0f || region.sin_tolerance > 1.0f) return "has a tolerance that is no sine";
    if (region.share < 0.0f || region.share > 1.0f) return "has a share out of range";
    if (!(area.near >= 0.0f && area.near < region.far) || (region.point == 0 && area.near != 0.0f))
        return "has rays that do not begin before far";
    if (!all_finite(area.box.min) || !all_finite(area.box.max) || !is_ordered(area.box))
        return "has a box that is not finite or inverted";
    return region.reserved == 0 ? nullptr : "has a reserved word that is not zero";
}

const char* wrong_with(const AreaIndex& index, std::size_t i, std::size_t areas) {
    const AreaNode& node = index.nodes[i];
    if (!all_finite(node.split)) return "has a split that is not finite";
    if (node.count == BOXWOOD_NONE) {
        if (node.axis > BOXWOOD_OCTANTS) return "is split along no axis";
        const std::uint64_t children = node.axis == BOXWOOD_OCTANTS ? 8 : 2;
        if (node.first <= i || node.first + children > index.nodes.size()) return "has children out of range";
        return nullptr;
    }
    if (!all_zero(node.split) || node.axis != 0) return "is a leaf with a split";
    if (std::uint64_t{node.first} + node.count > index.items.size()) return "has areas out of range";
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        if (index.items[k] >= areas) return "names an area out of range";
        if (k > node.first && index.items[k] <= index.items[k - 1]) return "has areas out of order";
    }
    return nullptr;
}

} // namespace

void check_areas(const TreeImage& tree, const std::string& file) {
    const AreaIndex& index = tree.area_index;
    if (index.kind == AreaIndexKind::automatic) throw InputError(file, "area_index", "must be list, octree or kd");
    if (tree.areas.empty() != index.nodes.empty() || (tree.areas.empty() && !index.items.empty()))
        throw InputError(file, "area_nodes", "must be there with areas, and only then");
    for (std::size_t i = 0; i < tree.areas.size(); ++i)
        if (const char* what = wrong_with(tree.areas[i])) throw InputError(file, element("areas", i), what);
    // All nodes of lists whose entries are shared would take quadratic time.
    std::uint64_t listed = 0;
    for (const AreaNode& node : index.nodes) listed += node.count == BOXWOOD_NONE ? 0 : node.count;
    if (listed > index.items.size()) throw InputError(file, "area_items", "are fewer than the leaves list");
    for (std::size_t i = 0; i < index.nodes.size(); ++i)
        if (const char* what = wrong_with(index, i, tree.areas.size()))
            throw InputError(file, element("area_nodes", i), what);
}

} // namespace boxwood
