// SPDX-License-Identifier: MIT
#include "boxwood/build.hpp"

#include <chrono>
#include <utility>

#include "boxwood/collapse.hpp"
#include "boxwood/error.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/requirements.hpp"
#include "boxwood/volumes.hpp"
#include "hierarchy/capacity.hpp"
#include "hierarchy/forest.hpp"
#include "hierarchy/overlap.hpp"
#include "hierarchy/quality.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

/// Everything a build makes on its way to the tree.
struct Parts {
    Forest bottom;
    Forest top; ///< Two levels only, like the next two.
    std::vector<InstanceRecord> instances;
    Buffer<Aabb> instance_boxes;
    Clock::time_point uploaded; ///< When the geometry was on the device.
};

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

/// Lays the forest's nodes out for traversal and keeps them in `tree`.
void collapse_bottom(Device& device, const Forest& forest, const Geometry& geometry, Tree& tree) {
    const Stage stage(device, "collapse");
    if (tree.bounds != Bounds::aabb) {
        OrientedLayout layout = collapse_oriented(device, forest.topology, forest.volumes, forest.boxes, geometry);
        tree.oriented_nodes = std::move(layout.nodes);
        tree.triangles = std::move(layout.triangles);
        tree.bottom_depth = layout.depth;
    } else if (tree.layout == Layout::wide8) {
        WideLayout layout = collapse_wide(device, forest.topology, forest.volumes, geometry);
        tree.wide_nodes = std::move(layout.nodes);
        tree.blocks = std::move(layout.blocks);
        tree.bottom_depth = layout.depth;
    } else {
        BinaryLayout layout = collapse_binary(device, forest.topology, forest.volumes, geometry);
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

/// The tree over instances (dissertation 3.6.2): the same passes over the boxes of the placed meshes.
void build_top_level(Device& device, const Scene& scene, const Geometry& geometry,
                     const std::vector<std::uint32_t>& offsets, const BuildOptions& options, Parts& parts, Tree& tree) {
    const Stage stage(device, "top_level");
    parts.instances = instance_records(scene);
    for (InstanceRecord& record : parts.instances)
        record.root = tree.layout == Layout::wide8 ? record.mesh : offsets[record.mesh];
    tree.instances = upload(device, parts.instances, "instances");
    const auto count = static_cast<std::uint32_t>(parts.instances.size());
    parts.instance_boxes = make_scratch<Aabb>(device, count, "boxes of instances");
    launch(device, {"bounds/primitive_bounds.cl", "instance_bounds"}, "instance boxes", count, geometry.instances,
           parts.bottom.tree_bounds, parts.instance_boxes, count);
    parts.top = build_forest(device, parts.instance_boxes, {0, count}, options.morton, "top_level");
    if (tree.bounds != Bounds::aabb)
        parts.top.boxes = obb_volumes(device, parts.top.topology, parts.top.volumes, geometry.instances,
                                      root_boxes(device, parts.bottom), options.bounds);
    collapse_top(device, parts.top, tree);
}

/// For one level over several instances: where each instance's triangles start in the flattened scene.
std::vector<std::uint32_t> first_triangles(const Scene& scene) {
    std::vector<std::uint32_t> first{0};
    for (const Instance& instance : scene.instances)
        first.push_back(first.back() + static_cast<std::uint32_t>(scene.meshes[instance.mesh].triangles.size()));
    return first;
}

/// The tree that a build starts from: `options` resolved. Throws InputError for a layout that cannot hold the volumes.
Tree empty_tree(const BuildOptions& options) {
    Tree tree;
    tree.bounds = options.bounds.kind;
    const bool oriented = tree.bounds != Bounds::aabb;
    if (oriented && options.layout == Layout::wide8)
        throw InputError("layout", std::string(name(options.layout)),
                         "holds axis-aligned boxes only; oriented boxes (" + std::string(name(tree.bounds)) +
                             ") need the layout binary");
    tree.layout = options.layout != Layout::automatic ? options.layout : oriented ? Layout::binary : Layout::wide8;
    return tree;
}

/// `placed` is the scene itself for two levels, flattened for one.
Tree build_placed(Device& device, const Scene& placed, const BuildOptions& options, bool two_levels, Parts& parts) {
    Tree tree = empty_tree(options);
    tree.levels = two_levels ? Levels::two : Levels::one;
    check_capacity(device, tree.layout, tree.bounds, placed.triangle_count(), placed.vertex_count(),
                   two_levels ? placed.instances.size() : 0);
    const Geometry geometry = upload(device, placed);
    parts.uploaded = Clock::now();
    const std::vector<std::uint32_t> offsets = triangle_offsets(placed);
    {
        const Buffer<Aabb> boxes = triangle_boxes(device, geometry);
        parts.bottom = build_forest(device, boxes, offsets, options.morton);
    }
    if (tree.bounds != Bounds::aabb) {
        const Stage stage(device, "volumes");
        parts.bottom.boxes = obb_volumes(device, parts.bottom.topology, parts.bottom.volumes, geometry, options.bounds);
    }
    collapse_bottom(device, parts.bottom, geometry, tree);
    if (two_levels) build_top_level(device, placed, geometry, offsets, options, parts, tree);
    device.finish();
    return tree;
}

void fill_quality(Device& device, const Tree& tree, const Parts& parts, bool overlap, BuildReport& report) {
    const ForestQuality bottom = measure(device, parts.bottom);
    report.bottom = report.all = bottom.sums;
    report.sah = bottom.sah[0];
    if (tree.levels == Levels::two) {
        const ForestQuality top = measure(device, parts.top, true);
        report.top = top.sums;
        report.all = total(bottom, top);
        report.sah = two_level_sah(bottom, top, parts.instances);
    }
    if (overlap && tree.layout == Layout::binary)
        report.overlap = end_point_overlap(device, parts.bottom, tree.triangles);
    report.max_depth = tree.bottom_depth + tree.top_depth;
    report.nodes = tree.wide_nodes.size() + tree.wide_top.size() + tree.binary_nodes.size() + tree.binary_top.size() +
                   tree.oriented_nodes.size() + tree.oriented_top.size();
}

bool is_flat(const Scene& scene) {
    return scene.meshes.size() == 1 && scene.instances.size() == 1 && scene.instances[0].transform == glm::mat4(1.0f);
}

} // namespace

Tree build(Device& device, const Scene& scene, const BuildOptions& options, BuildReport* report) {
    const Requirements needs = requirements(scene, options);
    Tree tree = empty_tree(options);
    if (scene.instances.empty()) {
        if (report) *report = {};
        return tree;
    }
    device.take_profile();
    device.reset_peak();
    const double compiled = device.compile_ms();
    const auto start = Clock::now();

    Parts parts;
    if (needs.two_levels || is_flat(scene)) {
        tree = build_placed(device, scene, options, needs.two_levels, parts);
    } else {
        check_capacity(device, tree.layout, tree.bounds, scene.instanced_triangle_count(), 0, 0);
        tree = build_placed(device, flatten(scene), options, false, parts);
    }
    if (needs.instance_lookup) tree.first_triangles = upload(device, first_triangles(scene), "first triangles");

    if (report) {
        report->compile_ms = device.compile_ms() - compiled;
        report->total_ms = Milliseconds(Clock::now() - start).count() - report->compile_ms;
        report->upload_ms = Milliseconds(parts.uploaded - start).count();
        report->profile = device.take_profile();
        report->peak_device_bytes = device.peak_bytes();
        fill_quality(device, tree, parts, options.measure_overlap, *report);
    }
    return tree;
}

} // namespace boxwood
