// SPDX-License-Identifier: MIT
#include "boxwood/error.hpp"
#include "boxwood/scan.hpp"
#include "boxwood/volumes.hpp"
#include "runtime/launch.hpp"
#include "volumes/node_levels.hpp"
#include "volumes/obb_kinds.hpp"

namespace boxwood {

namespace {

/// Primitives that one work-item may take at a time; see cl/volumes/obb_ranges.cl.
constexpr std::uint32_t longest_range = 4096;
/// Primitives from which on a node's axes are refined: larger nodes hold most of the volume, smaller ones most of the
/// nodes. A top level has few nodes, and large ones.
constexpr std::uint32_t refined_triangles = 256, refined_instances = 2;
/// Floats that a vector load may read behind the last point.
constexpr std::uint32_t padding = 64;

/// What all passes need: the trees, their points, and how the kernels are specialised.
struct Fit {
    Device& device;
    const Topology& topology;
    BufferView<const Aabb> aabbs;
    BoundsOptions options;
    std::uint32_t points_per_primitive;
    std::uint32_t count;
    Buffer<float> points;
    std::uint32_t stride;
    Buffer<float> errors;  ///< Top level only.
    Buffer<float> moments; ///< obb_moments only.
    Buffer<Obb> boxes;
};

/// Boxes at once: more than eight have too many numbers for the registers.
std::uint32_t lanes(const Fit& fit) { return std::min(fit.device.tuning().lanes, 8u); }

/// `extra` are the kernel's own macros, and those that it has otherwise than the rest.
KernelRef kernel_of(const Fit& fit, const char* file, const char* name, Defines extra = {}) {
    extra.merge(Defines{{"LANES", std::to_string(lanes(fit))},
                        {"POINTS_PER_PRIMITIVE", std::to_string(fit.points_per_primitive)},
                        {"MEASURE_AREA", fit.options.measure == Measure::area ? "1" : "0"},
                        {"FALLBACK", fit.options.fallback ? "1" : "0"}});
    return {file, name, std::move(extra)};
}

const char* flag(bool value) { return value ? "1" : "0"; }

void fit_triangles(Fit& fit, const Geometry& geometry) {
    const Bounds kind = fit.options.kind;
    const bool needs_points = reads_points(kind);
    const KernelRef kernel =
        kernel_of(fit, "volumes/obb_leaves.cl", "triangle_leaves",
                  {{"SORTED_POINTS", flag(needs_points)}, {"MOMENTS", flag(kind == Bounds::obb_moments)}});
    const Slices slices = cut(fit.device, fit.count);
    launch(fit.device, kernel, "leaf boxes", slices.slices, fit.topology.order, geometry.positions, geometry.triangles,
           fit.aabbs, fit.points, fit.stride, fit.moments, fit.boxes, fit.count, slices.length);
    launch(fit.device, {"volumes/obb_empty.cl", "empty_boxes"}, "unused boxes", fit.topology.trees(),
           fit.topology.offsets, fit.boxes, static_cast<std::uint32_t>(fit.topology.trees()));
}

/// Calls run(first, size) for each level, from the leaves' parents up.
template <class Run>
void each_level(const NodeLevels& levels, const Run& run) {
    for (std::uint32_t height = 1; height <= levels.height(); ++height)
        run(levels.starts[height], levels.starts[height + 1] - levels.starts[height]);
}

/// One launch per level; `extents`: boxes from the children's, else axes alone.
void merge_levels(Fit& fit, const NodeLevels& levels, const char* merge, bool extents) {
    const KernelRef kernel =
        kernel_of(fit, "volumes/obb_merge.cl", "merge_level", {{"MERGE", merge}, {"EXTENTS", flag(extents)}});
    each_level(levels, [&](std::uint32_t first, std::uint32_t size) {
        const Slices slices = cut(fit.device, size, 8);
        launch(fit.device, kernel, "merged nodes", slices.slices, levels.nodes, first, size, slices.length,
               fit.topology.children, fit.topology.far_ends, fit.aabbs, fit.points, fit.stride, fit.errors, fit.moments,
               fit.boxes, fit.count);
    });
}

/// Pass "0": the axes of nodes by the covariance of their points, "1": their boxes along these; of all nodes, or of
/// those with up to `longest` primitives. The sum of volumes with 3 sweeps of the eigenvector solver is that with 5 to
/// five digits (bunny, dragon); small nodes have little volume, and 2 sweeps do for them alone.
void pass_over_ranges(Fit& fit, const char* pass, const char* label, std::uint32_t longest = 0) {
    Device& device = fit.device;
    const std::uint32_t chunk = longest ? longest : longest_range;
    Defines extra{{"PASS", pass}, {"CHUNK", std::to_string(chunk)}};
    if (pass[0] == '0') extra["JACOBI_SWEEPS"] = longest ? "2" : "3";
    const auto kernel = [&](const char* name) { return kernel_of(fit, "volumes/obb_ranges.cl", name, extra); };
    Buffer<std::uint32_t> chunks = make_scratch<std::uint32_t>(device, fit.count, "chunks of nodes");
    const Slices slices = cut(device, fit.count);
    launch(device, kernel("node_chunks"), "chunks of nodes", slices.slices, fit.topology.children,
           fit.topology.far_ends, chunks, fit.count, slices.length);
    launch(device, kernel("short_nodes"), label, slices.slices, chunks, fit.topology.children, fit.topology.far_ends,
           fit.aabbs, fit.points, fit.stride, fit.errors, fit.boxes, fit.count, slices.length);
    if (longest || fit.count <= chunk) return;
    Buffer<std::uint32_t> first_chunks = make_scratch<std::uint32_t>(device, fit.count, "first chunks");
    exclusive_scan(device, chunks, Operator::sum, first_chunks);
    const std::uint32_t total =
        download_element(device, first_chunks, fit.count - 1) + download_element(device, chunks, fit.count - 1);
    const std::size_t results = pass[0] == '0' ? 9 : 6;
    Buffer<float> parts = make_scratch<float>(device, results * total, "results of chunks");
    launch(device, kernel("long_chunks"), label, total, first_chunks, fit.topology.far_ends, fit.aabbs, fit.points,
           fit.stride, fit.boxes, parts, fit.count, total);
    launch(device, kernel("long_nodes"), label, slices.slices, chunks, first_chunks, fit.topology.children,
           fit.topology.far_ends, fit.aabbs, fit.errors, parts, fit.boxes, fit.count, slices.length);
}

std::uint32_t smallest_refined(const Fit& fit) {
    return fit.points_per_primitive == 3 ? refined_triangles : refined_instances;
}

/// Turns the axes of nodes with many points until the box around their extreme points is smallest.
void refine_frames(Fit& fit) {
    Device& device = fit.device;
    const auto kernel = [&](const char* name) {
        return kernel_of(fit, "volumes/obb_refine.cl", name,
                         {{"SMALLEST", std::to_string(smallest_refined(fit))}, {"LANES", "1"}});
    };
    Buffer<std::uint32_t> refined = make_scratch<std::uint32_t>(device, fit.count, "refined nodes");
    Buffer<std::uint32_t> slots = make_scratch<std::uint32_t>(device, fit.count, "slots of refined nodes");
    const Slices slices = cut(device, fit.count);
    launch(device, kernel("refined_nodes"), "refined nodes", slices.slices, fit.topology.children,
           fit.topology.far_ends, refined, fit.count, slices.length);
    exclusive_scan(device, refined, Operator::sum, slots);
    const std::uint32_t total =
        download_element(device, slots, fit.count - 1) + download_element(device, refined, fit.count - 1);
    if (total == 0) return;
    Buffer<std::uint32_t> extremes =
        make_scratch<std::uint32_t>(device, std::size_t{BOXWOOD_EXTREMES} * total, "extreme points of nodes");
    Buffer<std::uint32_t> slot_nodes = make_scratch<std::uint32_t>(device, total, "nodes of slots");
    Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(device, total, "arrivals at nodes");
    fill(device, arrivals, 0);
    launch(device, kernel("refined_slots"), "refined nodes", slices.slices, refined, slots, slot_nodes, fit.count,
           slices.length);
    const Slices parts = cut(device, total);
    launch(device, kernel("node_extremes"), "extreme points", parts.slices, fit.topology.children, fit.topology.parents,
           fit.topology.far_ends, arrivals, fit.aabbs, fit.points, fit.stride, slots, slot_nodes, extremes, fit.count,
           total, parts.length);
    // Few nodes and much work for each: one per work-item.
    launch(device, kernel("refine_frames"), "refined frames", total, slot_nodes, fit.aabbs, fit.points, fit.stride,
           extremes, fit.boxes, total);
}

/// levels: of all inner nodes; empty for kinds that do not work by levels.
void fit_inner_nodes(Fit& fit, const NodeLevels& levels) {
    switch (fit.options.kind) {
    case Bounds::obb_points:
        pass_over_ranges(fit, "0", "covariances");
        pass_over_ranges(fit, "1", "extents");
        break;
    case Bounds::obb_boxes:
        merge_levels(fit, levels, "1", true);
        break;
    case Bounds::obb_quaternion:
        merge_levels(fit, levels, "2", true);
        break;
    case Bounds::obb_cascade:
        merge_levels(fit, levels, "3", true);
        break;
    case Bounds::obb_moments:
        merge_levels(fit, levels, "0", fit.options.extents == Extents::corners);
        if (fit.options.extents == Extents::exact) pass_over_ranges(fit, "1", "extents");
        break;
    case Bounds::obb_refined:
        // The smallest inner nodes have two primitives.
        if (smallest_refined(fit) > 2) pass_over_ranges(fit, "0", "covariances", smallest_refined(fit) - 1);
        refine_frames(fit);
        pass_over_ranges(fit, "1", "extents");
        break;
    case Bounds::aabb:
        throw InputError("bounds", std::string(name(fit.options.kind)), "is not a kind of oriented box");
    }
}

Buffer<float> make_moments(Device& device, std::uint32_t count, Bounds kind) {
    if (kind != Bounds::obb_moments) return {};
    return make_scratch<float>(device, 2 * std::size_t{BOXWOOD_MOMENT_FLOATS} * count, "moments of nodes");
}

Fit make_fit(Device& device, const Topology& topology, BufferView<const Aabb> aabbs, const BoundsOptions& options,
             std::uint32_t points_per_primitive) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    const std::uint32_t stride = points_per_primitive * count + padding;
    const bool needs_points = points_per_primitive == 8 || reads_points(options.kind);
    return {device,
            topology,
            aabbs,
            options,
            points_per_primitive,
            count,
            needs_points ? make_scratch<float>(device, 3 * std::size_t{stride}, "sorted points") : Buffer<float>{},
            stride,
            {},
            make_moments(device, count, options.kind),
            make_scratch<Obb>(device, 2 * std::size_t{count}, "oriented boxes of nodes")};
}

} // namespace

Buffer<Obb> obb_volumes(Device& device, const Topology& topology, BufferView<const Aabb> aabbs,
                        const Geometry& geometry, const BoundsOptions& options) {
    Fit fit = make_fit(device, topology, aabbs, options, 3);
    fit_triangles(fit, geometry);
    fit_inner_nodes(fit, works_by_levels(options.kind) ? node_levels(device, topology) : NodeLevels{});
    return std::move(fit.boxes);
}

Buffer<Obb> obb_volumes(Device& device, const Topology& topology, BufferView<const Aabb> aabbs,
                        BufferView<const InstanceRecord> instances, BufferView<const Obb> mesh_boxes,
                        const SceneSphere& sphere, const BoundsOptions& options) {
    Fit fit = make_fit(device, topology, aabbs, options, 8);
    fit.errors = make_scratch<float>(device, 8 * std::size_t{fit.count}, "errors of corners");
    const auto kernel = [&](const char* kernel_name) {
        return kernel_of(fit, "volumes/obb_instances.cl", kernel_name,
                         {{"LANES", "1"}, {"MOMENTS", flag(options.kind == Bounds::obb_moments)}});
    };
    launch(device, kernel("instance_leaves"), "leaf boxes", fit.count, topology.order, instances, mesh_boxes, aabbs,
           fit.points, fit.stride, fit.errors, fit.moments, fit.boxes, fit.count, sphere);
    launch(device, {"volumes/obb_empty.cl", "empty_boxes"}, "unused boxes", 1, topology.offsets, fit.boxes, 1u);
    const NodeLevels levels = node_levels(device, topology);
    each_level(levels, [&](std::uint32_t first, std::uint32_t size) {
        launch(device, kernel("merge_errors"), "merged errors", size, levels.nodes, first, size, topology.children,
               fit.errors);
    });
    fit_inner_nodes(fit, levels);
    launch(device, kernel("transform_leaves"), "placed boxes", fit.count, topology.order, instances, mesh_boxes, aabbs,
           fit.boxes, fit.count, sphere);
    return std::move(fit.boxes);
}

} // namespace boxwood
