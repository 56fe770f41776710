// SPDX-License-Identifier: MIT
#include "boxwood/tree.hpp"

namespace boxwood {

TreeImage download(Device& device, const Tree& tree) {
    TreeImage image;
    image.layout = tree.layout;
    image.levels = tree.levels;
    image.bounds = tree.bounds;
    image.binary_nodes = download(device, tree.binary_nodes);
    image.oriented_nodes = download(device, tree.oriented_nodes);
    image.triangles = download(device, tree.triangles);
    image.wide_nodes = download(device, tree.wide_nodes);
    image.blocks = download(device, tree.blocks);
    image.binary_top = download(device, tree.binary_top);
    image.oriented_top = download(device, tree.oriented_top);
    image.wide_top = download(device, tree.wide_top);
    image.instances = download(device, tree.instances);
    image.first_triangles = download(device, tree.first_triangles);
    image.areas = download(device, tree.areas);
    image.area_index = {tree.area_index, download(device, tree.area_nodes), download(device, tree.area_items)};
    image.sphere = tree.sphere;
    image.bottom_depth = tree.bottom_depth;
    image.top_depth = tree.top_depth;
    return image;
}

Tree upload(Device& device, const TreeImage& image) {
    Tree tree;
    tree.layout = image.layout;
    tree.levels = image.levels;
    tree.bounds = image.bounds;
    tree.binary_nodes = upload(device, image.binary_nodes, "binary nodes");
    tree.oriented_nodes = upload(device, image.oriented_nodes, "oriented nodes");
    tree.triangles = upload(device, image.triangles, "triangles");
    tree.wide_nodes = upload(device, image.wide_nodes, "wide8 nodes");
    tree.blocks = upload(device, image.blocks, "triangle blocks");
    tree.binary_top = upload(device, image.binary_top, "binary top nodes");
    tree.oriented_top = upload(device, image.oriented_top, "oriented top nodes");
    tree.wide_top = upload(device, image.wide_top, "wide8 top nodes");
    tree.instances = upload(device, image.instances, "instances");
    tree.first_triangles = upload(device, image.first_triangles, "first triangles");
    tree.areas = upload(device, image.areas, "influence areas");
    tree.area_nodes = upload(device, image.area_index.nodes, "nodes of areas");
    tree.area_items = upload(device, image.area_index.items, "lists of areas");
    tree.area_index = image.area_index.kind;
    tree.sphere = image.sphere;
    tree.bottom_depth = image.bottom_depth;
    tree.top_depth = image.top_depth;
    return tree;
}

} // namespace boxwood
