// SPDX-License-Identifier: MIT
#include "boxwood/tree.hpp"

#include <tuple>
#include <utility>

#include "layout/tree_arrays.hpp"

namespace boxwood {

namespace {

/// The arrays of an image that hold a layout: nodes, leaves, nodes of the top level.
constexpr auto arrays_of(const WideLayout&) {
    return std::tuple(&TreeImage::wide_nodes, &TreeImage::blocks, &TreeImage::wide_top);
}
constexpr auto arrays_of(const BinaryLayout&) {
    return std::tuple(&TreeImage::binary_nodes, &TreeImage::triangles, &TreeImage::binary_top);
}
constexpr auto arrays_of(const OrientedLayout&) {
    return std::tuple(&TreeImage::oriented_nodes, &TreeImage::triangles, &TreeImage::oriented_top);
}

template <class One>
void upload_layout(Device& device, const TreeImage& image, One& bottom, AnyLayout& top) {
    const auto [nodes, leaves, top_nodes] = arrays_of(bottom);
    bottom.nodes = upload(device, image.*nodes, "nodes");
    bottom.leaves = upload(device, image.*leaves, "leaves");
    bottom.depth = image.bottom_depth;
    One above;
    above.nodes = upload(device, image.*top_nodes, "nodes of the top level");
    above.depth = image.top_depth;
    top = std::move(above);
}

} // namespace

Tree::Tree() : Tree(TreeArrays{}) {}
Tree::Tree(TreeArrays arrays) : arrays_(std::make_unique<TreeArrays>(std::move(arrays))) {}
Tree::~Tree() = default;
Tree::Tree(Tree&&) noexcept = default;
Tree& Tree::operator=(Tree&&) noexcept = default;

bool Tree::empty() const {
    return std::visit([](const auto& bottom) { return bottom.nodes.size() == 0; }, arrays_->bottom);
}
Layout Tree::layout() const { return arrays_->layout; }
Levels Tree::levels() const { return arrays_->levels; }
Bounds Tree::bounds() const { return arrays_->bounds; }
AreaIndexKind Tree::area_index() const { return arrays_->area_index; }

std::uint64_t Tree::node_count() const {
    return visit_layout(*arrays_, [](const auto& bottom, const auto& top) {
        return std::uint64_t{bottom.nodes.size()} + top.nodes.size();
    });
}

std::uint32_t Tree::max_depth() const {
    return visit_layout(*arrays_, [](const auto& bottom, const auto& top) { return bottom.depth + top.depth; });
}

TreeArrays& Tree::arrays() { return *arrays_; }
const TreeArrays& Tree::arrays() const { return *arrays_; }

TreeImage download(Device& device, const Tree& tree) {
    const TreeArrays& arrays = tree.arrays();
    TreeImage image;
    image.layout = arrays.layout;
    image.levels = arrays.levels;
    image.bounds = arrays.bounds;
    visit_layout(arrays, [&](const auto& bottom, const auto& top) {
        const auto [nodes, leaves, top_nodes] = arrays_of(bottom);
        image.*nodes = download(device, bottom.nodes);
        image.*leaves = download(device, bottom.leaves);
        image.*top_nodes = download(device, top.nodes);
        image.bottom_depth = bottom.depth;
        image.top_depth = top.depth;
    });
    image.instances = download(device, arrays.instances);
    image.first_triangles = download(device, arrays.first_triangles);
    image.areas = download(device, arrays.areas);
    image.area_index = {arrays.area_index, download(device, arrays.area_nodes), download(device, arrays.area_items)};
    image.sphere = arrays.sphere;
    return image;
}

Tree upload(Device& device, const TreeImage& image) {
    TreeArrays arrays;
    arrays.layout = image.layout;
    arrays.levels = image.levels;
    arrays.bounds = image.bounds;
    arrays.bottom = empty_layout(image.layout, image.bounds);
    std::visit([&](auto& bottom) { upload_layout(device, image, bottom, arrays.top); }, arrays.bottom);
    arrays.instances = upload(device, image.instances, "instances");
    arrays.first_triangles = upload(device, image.first_triangles, "first triangles");
    arrays.areas = upload(device, image.areas, "influence areas");
    arrays.area_nodes = upload(device, image.area_index.nodes, "nodes of areas");
    arrays.area_items = upload(device, image.area_index.items, "lists of areas");
    arrays.area_index = image.area_index.kind;
    arrays.sphere = image.sphere;
    return Tree(std::move(arrays));
}

} // namespace boxwood
