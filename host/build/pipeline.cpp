// SPDX-License-Identifier: MIT
#include "build/pipeline.hpp"

#include <string>
#include <utility>

#include "boxwood/volumes.hpp"
#include "build/builder.hpp"
#include "build/capacity.hpp"
#include "build/trees.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

std::vector<std::uint32_t> triangle_offsets(const Scene& scene) {
    std::vector<std::uint32_t> offsets{0};
    for (const Mesh& mesh : scene.meshes)
        offsets.push_back(offsets.back() + static_cast<std::uint32_t>(mesh.triangles.size()));
    return offsets;
}

void upload_geometry(Device& device, const Scene& placed, BuildParts& parts) {
    parts.geometry = upload(device, placed);
    parts.uploaded = std::chrono::steady_clock::now();
    parts.offsets = triangle_offsets(placed);
}

/// Adds the trees of influence areas to those that will be built.
void add_local_trees(Device& device, const Scene& flat, const BuildOptions& options, BuildParts& parts,
                     TreeArrays& tree) {
    parts.local = add_local_triangles(device, flat, options, parts.geometry);
    std::vector<LocalArea>& areas = parts.local.areas;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const auto root = static_cast<std::uint32_t>(parts.offsets.size() - 1);
        areas[i].root = tree.layout == Layout::wide8 ? root : parts.offsets[root];
        parts.offsets.push_back(parts.offsets.back() + parts.local.sizes[i]);
    }
    const AreaIndex index = build_area_index(areas, options.area_index);
    tree.areas = upload(device, areas, "influence areas");
    tree.area_nodes = upload(device, index.nodes, "nodes of areas");
    tree.area_items = upload(device, index.items, "lists of areas");
    tree.area_index = index.kind;
}

/// What is known of the rays: for blend it steers the builder of the only tree, else areas have trees of their own.
void add_areas(Device& device, const Scene& placed, const BuildOptions& options, BuildParts& parts, TreeArrays& tree) {
    if (options.areas.empty()) return;
    if (options.builder != Builder::blend) return add_local_trees(device, placed, options, parts, tree);
    const std::vector<InfluenceRecord> rays = influence_records(options.areas);
    parts.local.rays = upload(device, rays, "rays of areas");
    parts.local.ray_starts =
        upload(device, std::vector<std::uint32_t>{0, static_cast<std::uint32_t>(rays.size())}, "rays of areas");
}

Buffer<Aabb> triangle_boxes(Device& device, const Geometry& geometry) {
    const Stage stage(device, "bounds");
    const auto count = static_cast<std::uint32_t>(geometry.triangle_count());
    Buffer<Aabb> boxes = make_scratch<Aabb>(device, count, "boxes of triangles");
    const Slices slices = cut(device, count);
    launch(device, {"bounds/primitive_bounds.cl", "triangle_bounds"}, "triangle boxes", slices.slices,
           geometry.positions, geometry.triangles, boxes, count, slices.length);
    return boxes;
}

Buffer<Aabb> instance_boxes(Device& device, const BuildParts& parts, const TreeArrays& tree) {
    const auto count = static_cast<std::uint32_t>(tree.instances.size());
    Buffer<Aabb> boxes = make_scratch<Aabb>(device, count, "boxes of instances");
    launch(device, {"bounds/primitive_bounds.cl", "instance_bounds"}, "instance boxes", count, tree.instances,
           parts.bottom.tree_bounds, boxes, count, tree.sphere);
    return boxes;
}

void build_bottom_level(Device& device, const BuildOptions& options, BuildParts& parts) {
    const Buffer<Aabb> boxes = triangle_boxes(device, parts.geometry);
    // Leaves of wide8 test four triangles at once.
    parts.bottom = options.builder == Builder::lbvh
                       ? lbvh_trees(device, boxes, parts.offsets, options.morton)
                       : topdown_trees(device, boxes, parts.offsets,
                                       topdown_options(options.builder, options.layout == Layout::wide8 ? 4 : 1), "",
                                       parts.local.rays, parts.local.ray_starts);
}

/// The oriented box of each mesh: that of its tree's root.
Buffer<Obb> root_boxes(Device& device, const BinaryTrees& trees) {
    const Stage stage(device, "top_level");
    const std::size_t count = trees.topology.trees();
    Buffer<Obb> boxes = make_scratch<Obb>(device, count, "oriented boxes of meshes");
    launch(device, {"volumes/root_boxes.cl", "root_boxes"}, "root boxes", count, trees.topology.offsets, trees.boxes,
           boxes, static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(trees.topology.size()));
    return boxes;
}

void fit_oriented_boxes(Device& device, const BuildOptions& options, BuildParts& parts) {
    if (options.bounds.kind == Bounds::aabb) return;
    const Stage stage(device, "volumes");
    BinaryTrees& bottom = parts.bottom;
    bottom.boxes = obb_volumes(device, bottom.topology, bottom.volumes, parts.geometry, options.bounds);
}

void collapse_bottom_level(Device& device, const BuildParts& parts, TreeArrays& tree) {
    const Stage stage(device, "collapse");
    tree.bottom = collapse(device, tree.layout, tree.bounds, parts.bottom, &parts.geometry, parts.local.names);
}

/// For one level over several instances: where each instance's triangles start in the flattened scene.
void add_instance_lookup(Device& device, const Scene& scene, TreeArrays& tree) {
    if (tree.levels == Levels::two || scene.instances.size() < 2) return;
    std::vector<std::uint32_t> first{0};
    for (const Instance& instance : scene.instances)
        first.push_back(first.back() + static_cast<std::uint32_t>(scene.meshes[instance.mesh].triangles.size()));
    tree.first_triangles = upload(device, first, "first triangles");
}

} // namespace

TreeArrays start_tree(const BuildOptions& options, const SceneSphere& sphere) {
    TreeArrays tree;
    tree.layout = options.layout;
    tree.levels = options.levels;
    tree.bounds = options.bounds.kind;
    tree.bottom = empty_layout(tree.layout, tree.bounds);
    tree.top = empty_layout(tree.layout, tree.bounds);
    tree.sphere = sphere;
    return tree;
}

bool is_flat(const Scene& scene) {
    return scene.meshes.size() == 1 && scene.instances.size() == 1 && scene.instances[0].transform == glm::mat4(1.0f);
}

TreeArrays build_tree(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts) {
    const bool two_levels = options.levels == Levels::two;
    const bool flattens = !two_levels && !is_flat(scene);
    if (flattens) check_capacity(device, options, scene.instanced_triangle_count(), 0, 0);
    const Scene flat = flattens ? flatten(scene) : Scene{};
    const Scene& placed = flattens ? flat : scene;
    check_capacity(device, options, placed.triangle_count(), placed.vertex_count(),
                   two_levels ? placed.instances.size() : 0);

    TreeArrays tree = start_tree(options, scene_sphere(scene));
    upload_geometry(device, placed, parts);
    add_areas(device, placed, options, parts, tree);
    build_bottom_level(device, options, parts);
    finish_tree(device, placed, options, parts, tree);
    add_instance_lookup(device, scene, tree);
    return tree;
}

void refit_bottom_level(Device& device, BuildParts& parts) {
    const Buffer<Aabb> boxes = triangle_boxes(device, parts.geometry);
    {
        const Stage stage(device, "bounds");
        parts.bottom.tree_bounds = bounds_of_trees(device, boxes, parts.bottom.topology.offsets);
    }
    const Stage stage(device, "volumes");
    parts.bottom.volumes = aabb_volumes(device, parts.bottom.topology, boxes);
}

void finish_tree(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts, TreeArrays& tree) {
    fit_oriented_boxes(device, options, parts);
    collapse_bottom_level(device, parts, tree);
    if (tree.levels == Levels::two) {
        if (tree.bounds != Bounds::aabb) parts.mesh_boxes = root_boxes(device, parts.bottom);
        build_top_level(device, scene, options, parts, tree);
    }
    device.finish();
}

void build_top_level(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts,
                     TreeArrays& tree) {
    const Stage stage(device, "top_level");
    std::vector<InstanceRecord> records = instance_records(scene);
    for (InstanceRecord& record : records)
        record.root = tree.layout == Layout::wide8 ? record.mesh : parts.offsets[record.mesh];
    tree.instances = upload(device, records, "instances");
    const std::vector<std::uint32_t> all{0, static_cast<std::uint32_t>(records.size())};
    const Buffer<Aabb> boxes = instance_boxes(device, parts, tree);
    // Instances are never tested together.
    BinaryTrees& top = parts.top;
    top = options.builder == Builder::lbvh
              ? lbvh_trees(device, boxes, all, options.morton, "top_level")
              : topdown_trees(device, boxes, all, topdown_options(options.builder, 1), "top_level");
    if (tree.bounds != Bounds::aabb)
        top.boxes = obb_volumes(device, top.topology, top.volumes, tree.instances, parts.mesh_boxes, tree.sphere,
                                options.bounds);
    tree.top = collapse(device, tree.layout, tree.bounds, top, nullptr);
}

} // namespace boxwood
