// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "boxwood/device.hpp"
#include "boxwood/tree_image.hpp"

namespace boxwood {

namespace detail {
struct TreeArrays;
}

/// A built tree on a device, for closest_hit, any_hit and render. What it holds in plain arrays is a TreeImage. One
/// that was moved from may only be assigned to or destroyed.
class Tree {
public:
    Tree(); ///< Without nodes.
    ~Tree();
    Tree(Tree&&) noexcept;
    Tree& operator=(Tree&&) noexcept;

    bool empty() const;    ///< Has no nodes, so that no ray hits anything.
    Layout layout() const; ///< Never automatic.
    Levels levels() const; ///< Never automatic.
    Bounds bounds() const;
    AreaIndexKind area_index() const; ///< Never automatic; without areas it does not matter.
    std::uint64_t node_count() const; ///< Of the layout, both levels and all local trees.
    /// Most nodes on a path from the root to a leaf's parent, both levels added up.
    std::uint32_t max_depth() const;

    /// For the library.
    explicit Tree(detail::TreeArrays arrays);
    detail::TreeArrays& arrays();
    const detail::TreeArrays& arrays() const;

private:
    std::unique_ptr<detail::TreeArrays> arrays_;
};

/// Copies a tree to the host; waits.
TreeImage download(Device& device, const Tree& tree);

/// Copies a valid image (see validate) to a device. Throws CapacityError when it does not fit.
Tree upload(Device& device, const TreeImage& image);

} // namespace boxwood
