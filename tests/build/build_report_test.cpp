// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "build/built_trees.hpp"
#include "build/capacity.hpp"
#include "oracles/wide_cost.hpp"
#include "tree_image/tree_walker.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

/// Metrics of one binary tree, in double.
struct Metrics {
    double area = 0.0, volume = 0.0; ///< Of all nodes.
    double inner_area = 0.0;         ///< Of inner nodes.
    double root_area = 0.0;
    double sah() const { return area / root_area; }
};

double volume_of(const Aabb& box) {
    return (double(box.max[0]) - box.min[0]) * (double(box.max[1]) - box.min[1]) * (double(box.max[2]) - box.min[2]);
}

void add_below(const std::vector<BinaryNode>& nodes, std::uint32_t index, Metrics& metrics) {
    for (std::uint32_t slot = 0; slot < detail::tree_check::used_slots(nodes[index]); ++slot) {
        const Aabb& box = nodes[index].bounds[slot];
        metrics.area += area_of(box);
        metrics.volume += volume_of(box);
        if (nodes[index].child[slot] & BOXWOOD_LEAF) continue;
        metrics.inner_area += area_of(box);
        add_below(nodes, nodes[index].child[slot], metrics);
    }
}

Metrics measure_tree(const std::vector<BinaryNode>& nodes, std::uint32_t root) {
    Metrics metrics;
    Aabb box = nodes[root].bounds[0];
    const bool single = nodes[root].child[1] == BOXWOOD_NONE;
    for (int k = 0; k < 3 && !single; ++k) {
        box.min[k] = std::min(box.min[k], nodes[root].bounds[1].min[k]);
        box.max[k] = std::max(box.max[k], nodes[root].bounds[1].max[k]);
    }
    metrics.root_area = area_of(box);
    if (!single) metrics = {area_of(box), volume_of(box), area_of(box), area_of(box)};
    add_below(nodes, root, metrics);
    return metrics;
}

/// Sizes 200, 1 and 30; the first placed twice, the second time moved by `shift`.
Scene two_level_scene(float shift) {
    Scene scene =
        scene_of({random_mesh(200, 1.0f, 0.2f, 1), random_mesh(1, 1.0f, 1.0f, 2), random_mesh(30, 2.0f, 0.5f, 3)});
    scene.instances.push_back(scene.instances[0]);
    scene.instances.back().transform[3] = glm::vec4(shift, 0, 0, 1);
    return scene;
}

/// The layouts with the volumes that they hold.
constexpr std::pair<Layout, Bounds> volumes[] = {
    {Layout::binary, Bounds::aabb}, {Layout::wide8, Bounds::aabb}, {Layout::binary, Bounds::obb_boxes}};

constexpr double tolerance = 1e-5; // sums of a few hundred floats, pairwise

} // namespace

TEST_CASE("build_report: metrics of one level equal sums in double") {
    const Scene scene = scene_of({random_mesh(999, 1.0f, 0.2f, 5)});
    BuildReport report;
    const TreeImage image =
        download(test_device(), build(test_device(), scene, {Levels::one, Layout::binary}, &report));
    const Metrics metrics = measure_tree(image.binary_nodes, 0);
    CHECK(report.all.sum_area == doctest::Approx(metrics.area).epsilon(tolerance));
    CHECK(report.all.sum_volume == doctest::Approx(metrics.volume).epsilon(tolerance));
    CHECK(report.sah == doctest::Approx(metrics.sah()).epsilon(tolerance));
    CHECK(report.max_depth == image.bottom_depth);
    CHECK(report.nodes == image.binary_nodes.size());
    // The metrics are those of the binary tree, whatever the layout.
    BuildReport wide;
    const Tree tree = build(test_device(), scene, {Levels::one, Layout::wide8}, &wide);
    CHECK(wide.all.sum_area == report.all.sum_area);
    CHECK(wide.all.sum_volume == report.all.sum_volume);
    CHECK(wide.sah == report.sah);
    CHECK(wide.nodes == tree.node_count());
    CHECK(wide.max_depth == tree.max_depth());
}

TEST_CASE("build_report: metrics of two levels equal sums in double") {
    const Scene scene = two_level_scene(10.0f);
    BuildReport report;
    const TreeImage image =
        download(test_device(), build(test_device(), scene, {Levels::two, Layout::binary}, &report));
    const Metrics top = measure_tree(image.binary_top, 0);
    const Metrics bottom[] = {measure_tree(image.binary_nodes, 0), measure_tree(image.binary_nodes, 200),
                              measure_tree(image.binary_nodes, 201)};
    double area = top.area, volume = top.volume, sah = top.inner_area / top.root_area;
    for (const Metrics& metrics : bottom) {
        area += metrics.area;
        volume += metrics.volume;
    }
    for (const BinaryNode& node : image.binary_top)
        for (std::uint32_t slot = 0; slot < 2; ++slot)
            if (node.child[slot] != BOXWOOD_NONE && (node.child[slot] & BOXWOOD_LEAF))
                sah += area_of(node.bounds[slot]) / top.root_area *
                       bottom[image.instances[node.child[slot] & ~BOXWOOD_LEAF].mesh].sah();
    CHECK(report.all.sum_area == doctest::Approx(area).epsilon(tolerance));
    CHECK(report.all.sum_volume == doctest::Approx(volume).epsilon(tolerance));
    CHECK(report.sah == doctest::Approx(sah).epsilon(tolerance));
    CHECK(report.max_depth == image.bottom_depth + image.top_depth);
    CHECK(report.nodes == image.binary_nodes.size() + image.binary_top.size());
}

TEST_CASE("build_report: every stage has its time, memory is counted") {
    BuildReport report;
    const Tree tree = build(test_device(), two_level_scene(3.0f), {}, &report);
    REQUIRE(tree.levels() == Levels::two);
    for (const char* stage : {"bounds", "morton", "sort", "hierarchy", "volumes", "collapse", "top_level"}) {
        CAPTURE(stage);
        CHECK(report.profile.stage_ms(stage) > 0.0);
    }
    for (const PassTime& pass : report.profile.passes) {
        CAPTURE(pass.label);
        CHECK(pass.stage != "");
    }
    CHECK(report.total_ms > 0.0);
    CHECK(report.compile_ms >= 0.0);
    // At the least its positions, indices, nodes and blocks.
    CHECK(report.peak_device_bytes > 231 * (36 + 12) + tree.node_count() * sizeof(Wide8Node));
    CHECK(report.peak_device_bytes >= test_device().held_bytes());
}

TEST_CASE("build_report: memory is that of this build alone") {
    Device& device = test_device();
    BuildReport large, small;
    build(device, scene_of({random_mesh(small_sizes() ? 2000 : 20000, 1.0f, 0.01f, 6)}), {}, &large);
    device.trim();
    build(device, scene_of({random_mesh(100, 1.0f, 0.01f, 7)}), {}, &small);
    CHECK(small.peak_device_bytes < large.peak_device_bytes / 2);
}

TEST_CASE("build_report: memory does not depend on the number of threads") {
    if (small_sizes()) return; // nothing that other builds do not launch
    const Scene single = scene_of({random_mesh(20000, 1.0f, 0.01f, 6)});
    InfluenceArea area;
    area.half_width = area.half_height = 0.5;
    const BuildOptions kinds[] = {{},
                                  {.morton = MortonBits::bits63},
                                  {.layout = Layout::binary},
                                  {.bounds = {Bounds::obb_moments}},
                                  {.bounds = {Bounds::obb_refined}},
                                  {.areas = {area}}};
    for (const BuildOptions& options : kinds) {
        CAPTURE(&options - kinds);
        for (const Scene& scene : {single, two_level_scene(3.0f)}) {
            if (scene.instances.size() > 1 && !options.areas.empty()) continue;
            std::vector<std::uint64_t> reported;
            check_memory_by_compute_units([&] {
                BuildReport report;
                const std::uint64_t held = test_device().held_bytes();
                build(test_device(), scene, options, &report);
                reported.push_back(report.peak_device_bytes - held);
                CHECK(reported.back() == reported.front());
            });
        }
    }
}

TEST_CASE("build_report: memory of a top-down builder does not depend on threads from 32,768 primitives for each") {
    if (small_sizes()) return;
    const Scene scene = scene_of({random_mesh(2 * 32768, 1.0f, 0.01f, 8)});
    check_memory_by_compute_units([&] { build(test_device(), scene, {.builder = Builder::sah}); }, 2);
}

TEST_CASE("build_report: what cannot fit is refused before any work, with both numbers") {
    Device& device = test_device();
    // 2^17 triangles placed 2^14 times, in one level: 2^31 primitives.
    Scene scene = scene_of({random_mesh(1, 1, 1, 1)});
    scene.meshes[0].triangles.assign(1u << 17, scene.meshes[0].triangles[0]);
    scene.instances.assign(1u << 14, scene.instances[0]);
    device.take_profile();
    const std::uint64_t held = device.held_bytes();
    try {
        build(device, scene, {Levels::one, Layout::wide8});
        FAIL("did not throw");
    } catch (const CapacityError& error) {
        CHECK(error.asked == std::uint64_t(1) << 31);
        CHECK(error.available == (1u << 30) - 1);
        CHECK(std::string(error.what()).find("2147483648") != std::string::npos);
        CHECK(std::string(error.what()).find("1073741823") != std::string::npos);
    }
    CHECK(device.take_profile().passes.empty());
    CHECK(device.held_bytes() == held);
}

TEST_CASE("build_report: capacity: the largest buffer is a limit, for every layout") {
    Device& device = test_device();
    const std::uint64_t largest = device.info().largest_buffer_bytes;
    for (const auto& volume : volumes) {
        const auto layout = volume.first; // clang 14 captures no structured bindings
        const auto bounds = volume.second;
        CHECK_NOTHROW(check_capacity(device, {.layout = layout, .bounds = {.kind = bounds}}, 1000, 3000, 10));
        CHECK_NOTHROW(check_capacity(device, {.layout = layout, .bounds = {.kind = bounds}}, 0, 0, 0));
        const auto refused = [&](std::uint64_t triangles, std::uint64_t vertices, std::uint64_t instances) {
            try {
                check_capacity(device, {.layout = layout, .bounds = {.kind = bounds}}, triangles, vertices, instances);
            } catch (const CapacityError& error) {
                return error.asked > error.available && error.available > 0;
            }
            return false;
        };
        CHECK(refused(1000, largest / 12 + 1, 0));
        CHECK(refused(std::min<std::uint64_t>(largest / 48 + 1, 1u << 30), 3, 0));
        CHECK(refused(1000, 3000, std::min<std::uint64_t>(largest / 112 + 1, 1u << 30)));
        if (bounds != Bounds::aabb) // two oriented boxes each
            CHECK(refused(std::min<std::uint64_t>(largest / 128 + 1, 1u << 30), 3, 0));
        CHECK(refused(std::uint64_t(1) << 40, 3, 0));
        CHECK(refused(10, 3, std::uint64_t(1) << 30));
    }
}

TEST_CASE("build_report: capacity: what the device holds already is not available") {
    if (small_sizes()) return; // Oclgrind takes pages for buffers that are never touched
    Device device(std::to_string(test_device().info().index));
    const std::uint64_t largest = device.info().largest_buffer_bytes, memory = device.info().global_bytes;
    std::vector<Buffer<char>> held;
    const std::size_t bytes = std::min<std::uint64_t>(largest, 0x7fffffff);
    while (device.held_bytes() + bytes <= memory) held.push_back(make_buffer<char>(device, bytes, "filler"));
    const std::uint64_t left = memory - device.held_bytes();
    for (const auto& [layout, bounds] : volumes) {
        // Each array fits a buffer; positions and boxes of nodes together do not fit what is left.
        const std::uint64_t vertices = bytes / 12, triangles = bytes / 128;
        try {
            check_capacity(device, {.layout = layout, .bounds = {.kind = bounds}}, triangles, vertices, 0);
            FAIL("did not throw");
        } catch (const CapacityError& error) {
            CHECK(error.available == left);
            CHECK(error.asked >= 12 * vertices + 48 * triangles + (bounds == Bounds::aabb ? 0 : 256 * triangles));
        }
    }
    held.clear();
    CHECK_NOTHROW(check_capacity(device, {.layout = Layout::wide8}, 1000, 3000, 0));
}
