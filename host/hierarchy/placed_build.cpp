// SPDX-License-Identifier: MIT
#include "hierarchy/placed_build.hpp"

#include <string>
#include <utility>

#include "boxwood/collapse.hpp"
#include "boxwood/error.hpp"
#include "boxwood/requirements.hpp"
#include "boxwood/volumes.hpp"
#include "hierarchy/capacity.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

std::vector<std::uint32_t> triangle_offsets(const Scene& scene) {
    std::vector<std::uint32_t> offsets{0};
    for (const Mesh& mesh : scene.meshes)
        offsets.push_back(offsets.back() + static_cast<std::uint32_t>(mesh.triangles.size()));
    return offsets;
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

/// Leaves of wide8 test four triangles at once; instances are never tested together.
Forest forest_over(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                   const BuildOptions& options, const LocalTrees& local, std::uint32_t block,
                   const std::string& stage = "") {
    if (options.builder == Builder::lbvh) return build_forest(device, boxes, offsets, options.morton, stage);
    return build_forest(device, boxes, offsets, topdown_options(options.builder, block), stage, local.rays,
                        local.ray_starts);
}

/// Lays the forest's nodes out for traversal and keeps them in `tree`.
void collapse_bottom(Device& device, const BuildParts& parts, Tree& tree) {
    const Stage stage(device, "collapse");
    const Forest& forest = parts.bottom;
    const Geometry& geometry = parts.geometry;
    if (tree.bounds != Bounds::aabb) {
        OrientedLayout layout = collapse_oriented(device, forest.topology, forest.volumes, forest.boxes, geometry);
        tree.oriented_nodes = std::move(layout.nodes);
        tree.triangles = std::move(layout.triangles);
        tree.bottom_depth = layout.depth;
    } else if (tree.layout == Layout::wide8) {
        WideLayout layout = collapse_wide(device, forest.topology, forest.volumes, geometry, parts.local.names);
        tree.wide_nodes = std::move(layout.nodes);
        tree.blocks = std::move(layout.blocks);
        tree.bottom_depth = layout.depth;
    } else {
        BinaryLayout layout = collapse_binary(device, forest.topology, forest.volumes, geometry, parts.local.names);
        tree.binary_nodes = std::move(layout.nodes);
        tree.triangles = std::move(layout.triangles);
        tree.bottom_depth = layout.depth;
    }
}

void collapse_top(Device& device, const Forest& forest, Tree& tree) {
    if (tree.bounds != Bounds::aabb) {
        OrientedLayout layout = collapse_oriented(device, forest.topology, forest.volumes, forest.boxes);
        tree.oriented_top = std::move(layout.nodes);
        tree.top_depth = layout.depth;
    } else if (tree.layout == Layout::wide8) {
        WideLayout layout = collapse_wide(device, forest.topology, forest.volumes);
        tree.wide_top = std::move(layout.nodes);
        tree.top_depth = layout.depth;
    } else {
        BinaryLayout layout = collapse_binary(device, forest.topology, forest.volumes);
        tree.binary_top = std::move(layout.nodes);
        tree.top_depth = layout.depth;
    }
}

/// The oriented box of each mesh: that of its tree's root.
Buffer<Obb> root_boxes(Device& device, const Forest& forest) {
    const std::size_t trees = forest.topology.trees();
    Buffer<Obb> boxes = make_scratch<Obb>(device, trees, "oriented boxes of meshes");
    launch(device, {"hierarchy/root_boxes.cl", "root_boxes"}, "root boxes", trees, forest.topology.offsets,
           forest.boxes, boxes, static_cast<std::uint32_t>(trees), static_cast<std::uint32_t>(forest.topology.size()));
    return boxes;
}

/// For one level over several instances: where each instance's triangles start in the flattened scene.
std::vector<std::uint32_t> first_triangles(const Scene& scene) {
    std::vector<std::uint32_t> first{0};
    for (const Instance& instance : scene.instances)
        first.push_back(first.back() + static_cast<std::uint32_t>(scene.meshes[instance.mesh].triangles.size()));
    return first;
}

/// Adds the trees of influence areas to those that will be built. Node arrays are as tree.layout has them.
void add_areas(Device& device, const Scene& flat, const BuildOptions& options, BuildParts& parts, Tree& tree) {
    parts.local = add_local_triangles(device, flat, options, tree.layout, parts.geometry);
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

/// Tells the builder of the only tree about the rays of the areas.
void share_areas(Device& device, const BuildOptions& options, BuildParts& parts) {
    const std::vector<InfluenceRecord> rays = influence_records(options.areas);
    parts.local.rays = upload(device, rays, "rays of areas");
    parts.local.ray_starts =
        upload(device, std::vector<std::uint32_t>{0, static_cast<std::uint32_t>(rays.size())}, "rays of areas");
}

/// `placed` is the scene itself for two levels, flattened for one.
Tree build_placed(Device& device, const Scene& placed, const SceneSphere& sphere, const BuildOptions& options,
                  bool two_levels, BuildParts& parts) {
    Tree tree = empty_tree(options);
    tree.sphere = sphere;
    tree.levels = two_levels ? Levels::two : Levels::one;
    check_capacity(device, tree.layout, tree.bounds, placed.triangle_count(), placed.vertex_count(),
                   two_levels ? placed.instances.size() : 0, options.builder);
    parts.geometry = upload(device, placed);
    parts.uploaded = std::chrono::steady_clock::now();
    parts.offsets = triangle_offsets(placed);
    if (options.builder == Builder::blend)
        share_areas(device, options, parts);
    else if (!options.areas.empty())
        add_areas(device, placed, options, parts, tree);
    {
        const Buffer<Aabb> boxes = triangle_boxes(device, parts.geometry);
        parts.bottom =
            forest_over(device, boxes, parts.offsets, options, parts.local, tree.layout == Layout::wide8 ? 4 : 1);
    }
    lay_out(device, placed, options, parts, tree);
    device.finish();
    return tree;
}

} // namespace

bool is_flat(const Scene& scene) {
    return scene.meshes.size() == 1 && scene.instances.size() == 1 && scene.instances[0].transform == glm::mat4(1.0f);
}

Tree empty_tree(const BuildOptions& options) {
    Tree tree;
    tree.bounds = options.bounds.kind;
    const bool oriented = tree.bounds != Bounds::aabb;
    if (oriented && options.layout == Layout::wide8)
        throw InputError("layout", std::string(name(options.layout)),
                         "holds axis-aligned boxes only; oriented boxes (" + std::string(name(tree.bounds)) +
                             ") need the layout binary");
    if (!options.areas.empty() && (oriented || options.levels == Levels::two))
        throw InputError("areas", oriented ? std::string(name(tree.bounds)) : "levels two",
                         "influence areas need one level of axis-aligned boxes");
    if (options.areas.empty() && needs_areas(options.builder))
        throw InputError("builder", std::string(name(options.builder)), "needs influence areas");
    validate(options.areas, "influence areas");
    tree.layout = options.layout != Layout::automatic ? options.layout : oriented ? Layout::binary : Layout::wide8;
    return tree;
}

Tree build_tree(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts) {
    const bool two_levels = requirements(scene, options).two_levels;
    const SceneSphere sphere = scene_sphere(scene);
    if (two_levels || is_flat(scene)) return build_placed(device, scene, sphere, options, two_levels, parts);
    const Tree tree = empty_tree(options);
    check_capacity(device, tree.layout, tree.bounds, scene.instanced_triangle_count(), 0, 0, options.builder);
    return build_placed(device, flatten(scene), sphere, options, false, parts);
}

void add_instance_lookup(Device& device, const Scene& scene, Tree& tree) {
    if (tree.levels == Levels::one && scene.instances.size() > 1)
        tree.first_triangles = upload(device, first_triangles(scene), "first triangles");
}

void fit_bottom(Device& device, BuildParts& parts) {
    const Buffer<Aabb> boxes = triangle_boxes(device, parts.geometry);
    {
        const Stage stage(device, "bounds");
        parts.bottom.tree_bounds = bounds_of_trees(device, boxes, parts.bottom.topology.offsets);
    }
    const Stage stage(device, "volumes");
    parts.bottom.volumes = aabb_volumes(device, parts.bottom.topology, boxes);
}

void lay_out(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts, Tree& tree) {
    Forest& bottom = parts.bottom;
    if (tree.bounds != Bounds::aabb) {
        const Stage stage(device, "volumes");
        bottom.boxes = obb_volumes(device, bottom.topology, bottom.volumes, parts.geometry, options.bounds);
    }
    collapse_bottom(device, parts, tree);
    if (tree.levels == Levels::one) return;
    if (tree.bounds != Bounds::aabb) {
        const Stage stage(device, "top_level");
        parts.mesh_boxes = root_boxes(device, bottom);
    }
    build_top_level(device, scene, options, parts, tree);
}

void build_top_level(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts, Tree& tree) {
    const Stage stage(device, "top_level");
    std::vector<InstanceRecord> records = instance_records(scene);
    for (InstanceRecord& record : records)
        record.root = tree.layout == Layout::wide8 ? record.mesh : parts.offsets[record.mesh];
    tree.instances = upload(device, records, "instances");
    const auto count = static_cast<std::uint32_t>(records.size());
    const Buffer<Aabb> boxes = make_scratch<Aabb>(device, count, "boxes of instances");
    launch(device, {"bounds/primitive_bounds.cl", "instance_bounds"}, "instance boxes", count, tree.instances,
           parts.bottom.tree_bounds, boxes, count, tree.sphere);
    parts.top = forest_over(device, boxes, {0, count}, options, {}, 1, "top_level");
    if (tree.bounds != Bounds::aabb)
        parts.top.boxes = obb_volumes(device, parts.top.topology, parts.top.volumes, tree.instances, parts.mesh_boxes,
                                      tree.sphere, options.bounds);
    collapse_top(device, parts.top, tree);
}

} // namespace boxwood
