// SPDX-License-Identifier: MIT
// Cuts space into cells and finds the areas that meet each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "boxwood/area_index.hpp"

namespace boxwood {

struct AreaCell {
    Aabb box;
    std::vector<std::uint32_t> areas; ///< That meet it, ascending.
    std::uint32_t level = 0;
};

class AreaCells {
public:
    explicit AreaCells(std::span<const LocalArea> areas);

    /// Breadth first, so that children stand together and after their parents.
    AreaIndex build(AreaIndexKind kind) const;

private:
    Aabb widened(const Aabb& box) const;
    AreaCell child(const AreaCell& parent, const Aabb& box) const;
    /// Every area that meets the cell encloses it: no part of it would tell more (paper 6.1.1).
    bool is_homogeneous(const AreaCell& cell) const;
    static void make_leaf(const AreaCell& cell, std::uint32_t node, AreaIndex& index);
    /// The parts of a split, and the node that makes it but for its children.
    static std::vector<Aabb> octants(const AreaCell& cell, AreaNode& node);
    /// None where a leaf is cheaper.
    std::vector<Aabb> halves(const AreaCell& cell, AreaNode& node) const;

    std::span<const LocalArea> areas_;
    AreaCell root_;
    float slack_ = 0.0f; ///< Largest area_rounding.
};

} // namespace boxwood
