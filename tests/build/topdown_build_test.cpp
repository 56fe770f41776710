// SPDX-License-Identifier: MIT
// Whole builds by the builders from the top down.
#include <doctest/doctest.h>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/update.hpp"
#include "build/built_trees.hpp"
#include "build/capacity.hpp"
#include "build/topdown.hpp"
#include "shared/instance.h"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

double cost_of(const Scene& scene, Layout layout, Builder builder) {
    BuildReport report;
    build(test_device(), scene, {.levels = Levels::automatic, .layout = layout, .builder = builder}, &report);
    return report.sah;
}

} // namespace

TEST_CASE("topdown_build: the surface area heuristic costs less than Morton order, on every kind of scene") {
    for (const ProceduralKind& kind : procedural_kinds()) {
        CAPTURE(kind.name);
        const std::uint64_t triangles = small_sizes() ? 100 : 5000, instances = small_sizes() ? 9 : 100;
        const Scene scene = make_procedural(kind.name, {.triangles = triangles, .instances = instances});
        for (const Layout layout : {Layout::binary, Layout::wide8}) {
            const double sah = cost_of(scene, layout, Builder::sah), lbvh = cost_of(scene, layout, Builder::lbvh);
            if (!small_sizes()) CHECK(sah <= lbvh); // of a hundred triangles the greedy tree may be the dearer
        }
    }
}

TEST_CASE("topdown_build: updates build anew by the same builder") {
    const Scene scene = make_procedural("forest", {.triangles = 300, .instances = 20});
    for (const Builder builder : {Builder::sah, Builder::midpoint}) {
        const BuildOptions options{.levels = Levels::two, .builder = builder};
        AnimatedTree animated(test_device(), scene, options);
        std::vector<glm::mat4> transforms;
        for (const Instance& instance : scene.instances) transforms.push_back(instance.transform);
        std::swap(transforms.front()[3], transforms.back()[3]);
        animated.move_instances(transforms);
        animated.rebuild();
        CHECK(same_trees(download(test_device(), animated.tree()),
                         download(test_device(), build(test_device(), animated.scene(), options))));
    }
}

TEST_CASE("topdown_build: scenes of other sizes use the same programs") {
    if (small_sizes()) return; // too few triangles for other chunks
    const auto build_of = [](std::uint64_t triangles) {
        const Scene scene = make_procedural("terrain", {.triangles = triangles});
        build(test_device(), scene, {.builder = Builder::sah});
        return test_device().compile_ms();
    };
    const double compiled = build_of(200'000); // of all the passes that there are
    CHECK(build_of(60'000) == compiled);
    CHECK(build_of(20'000) == compiled);
}

TEST_CASE("topdown_build: what the check of capacity counts on is what is taken") {
    if (small_sizes()) return; // no use for memory of a simulator
    for (const Tuning& tuning : {test_device().tuning(), Tuning{64, 4096, 1, 8}}) {
        const TuningScope scope(tuning);
        Device& device = test_device();
        const std::size_t count = 20000;
        const Mesh mesh = random_mesh(count, 1.0f, 0.1f, 3);
        std::vector<Aabb> boxes;
        for (const glm::uvec3& triangle : mesh.triangles) boxes.push_back(box_of(mesh, triangle));
        const Buffer<Aabb> uploaded = upload(device, boxes, "boxes");
        Buffer<std::uint32_t> offsets = upload(device, std::vector<std::uint32_t>{0, 20000}, "offsets");
        device.finish();
        device.trim();
        device.reset_peak();
        const std::uint64_t before = device.held_bytes();
        const TopDownTree tree = topdown(device, uploaded, {}, std::move(offsets), {}, {}, {});
        const std::uint64_t taken = device.peak_bytes() - before, topology = 24 * count;
        const std::uint64_t counted = topdown_bytes(device, count, 32).all + topology;
        CHECK(counted >= 0.9 * static_cast<double>(taken));
        CHECK(counted <= 1.1 * static_cast<double>(taken));
    }
}

namespace {

/// The most triangles, or instances of one triangle, that the check of capacity lets through.
std::uint64_t most_accepted(Builder builder, bool instances) {
    const auto accepts = [&](std::uint64_t n) {
        try {
            check_capacity(test_device(), {.layout = Layout::wide8, .builder = builder}, instances ? 1 : n,
                           instances ? 3 : n, instances ? n : 0);
            return true;
        } catch (const CapacityError&) {
            return false;
        }
    };
    std::uint64_t low = 1, high = std::uint64_t{1} << 31;
    REQUIRE(accepts(low));
    REQUIRE(!accepts(high));
    while (high - low > 1) {
        const std::uint64_t middle = (low + high) / 2;
        (accepts(middle) ? low : high) = middle;
    }
    return low;
}

} // namespace

TEST_CASE("topdown_build: refused before the work when splitting nodes does not fit, of either level") {
    Device& device = test_device();
    device.trim();
    const std::uint64_t available = device.info().global_bytes - device.held_bytes();
    for (const bool instances : {false, true}) {
        CAPTURE(instances);
        const std::uint64_t most = most_accepted(Builder::sah, instances);
        CHECK(most <= most_accepted(Builder::lbvh, instances));
        // Held meanwhile, by primitive: its box, the topology, and what it is, a triangle with a vertex or an instance.
        const std::uint64_t beside = sizeof(Aabb) + 24 + (instances ? sizeof(InstanceRecord) : 24);
        const TopDownBytes splits = topdown_bytes(device, most, 32);
        CHECK(splits.all + beside * most <= available);
        CHECK(splits.largest <= device.info().largest_buffer_bytes);
    }
}

TEST_SUITE_END();
