// SPDX-License-Identifier: MIT
// Box tests against slabs in double precision: never a miss where the exact answer is a hit, and tight.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/launch.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float denormal = std::numeric_limits<float>::denorm_min();
constexpr float largest = std::numeric_limits<float>::max();

KernelRef box_kernel(const std::string& name, const char* portable = "0") {
    return {"traverse/ray_box_test.cl", name, {{"PORTABLE_LANES", portable}}};
}

struct Answer {
    bool met;
    float entry;
};

/// The scalar test, and both twins of the wide one in a lane that changes, which must agree with it.
std::vector<Answer> test_boxes(const std::vector<Ray>& rays, const std::vector<Aabb>& boxes) {
    Device& device = test_device();
    const auto count = static_cast<std::uint32_t>(rays.size());
    const Buffer<Ray> source = upload(device, rays, "rays");
    const Buffer<Aabb> targets = upload(device, boxes, "boxes");
    const Guarded<std::uint32_t> met(device, count);
    const Guarded<float> entries(device, count);
    launch(device, box_kernel("ray_box_test"), "ray box", count, source, targets, count, met.view(), entries.view());
    std::vector<Answer> answers;
    const auto met_values = met.values();
    const auto entry_values = entries.values();
    for (std::uint32_t i = 0; i < count; ++i) answers.push_back({met_values[i] != 0, entry_values[i]});
    CHECK(met.intact());

    std::vector<Wide8Node> nodes(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t lane = 0; lane < 8; ++lane) {
            const bool used = lane == i % 8;
            Wide8Node& n = nodes[i];
            n.min_x[lane] = used ? boxes[i].min[0] : infinity, n.max_x[lane] = used ? boxes[i].max[0] : -infinity;
            n.min_y[lane] = used ? boxes[i].min[1] : infinity, n.max_y[lane] = used ? boxes[i].max[1] : -infinity;
            n.min_z[lane] = used ? boxes[i].min[2] : infinity, n.max_z[lane] = used ? boxes[i].max[2] : -infinity;
        }
    }
    const Buffer<Wide8Node> wide = upload(device, nodes, "nodes");
    for (const char* portable : {"0", "1"}) {
        const Guarded<std::uint32_t> lanes(device, count);
        const Guarded<float> lane_entries(device, 8 * std::size_t{count});
        launch(device, box_kernel("ray_box8_test", portable), "ray box8", count, source, wide, count, lanes.view(),
               lane_entries.view());
        const auto lane_values = lanes.values();
        const auto values = lane_entries.values();
        std::size_t different = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            different += lane_values[i] != (answers[i].met ? 1u << i % 8 : 0u);
            if (answers[i].met) different += values[8 * i + i % 8] != answers[i].entry;
        }
        CHECK(different == 0);
    }
    return answers;
}

struct Slab {
    double first, last;
};

/// Exact but for double rounding; a ray in the plane of a face is inside.
Slab slabs_in_double(const Ray& ray, const Aabb& box) {
    Slab slab{ray.t_min, ray.t_max};
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray.origin[axis], direction = ray.direction[axis];
        if (direction == 0.0) {
            if (origin < box.min[axis] || origin > box.max[axis]) return {1.0, 0.0};
            continue;
        }
        const double a = (box.min[axis] - origin) / direction, b = (box.max[axis] - origin) / direction;
        slab.first = std::max(slab.first, std::min(a, b));
        slab.last = std::min(slab.last, std::max(a, b));
    }
    return slab;
}

} // namespace

TEST_CASE("ray_box: conservative and tight on random boxes, also flat ones and from inside") {
    Random random(10);
    const std::uint32_t count = small_sizes() ? 200 : 20000;
    std::vector<Ray> rays = random_rays(random, count, 1.0f);
    std::vector<Aabb> boxes;
    for (std::uint32_t i = 0; i < count; ++i) {
        Aabb box;
        for (int axis = 0; axis < 3; ++axis) {
            const float a = random.uniform(-1.0f, 1.0f), b = random.uniform(-1.0f, 1.0f);
            box.min[axis] = std::min(a, b);
            box.max[axis] = random.below(4) == 0 ? box.min[axis] : std::max(a, b);
        }
        // Touching: starting on a face, in its plane.
        if (random.below(4) == 0) {
            const int axis = static_cast<int>(random.below(3));
            rays[i].origin[axis] = random.below(2) ? box.min[axis] : box.max[axis];
        }
        boxes.push_back(box);
    }
    const std::vector<Answer> answers = test_boxes(rays, boxes);
    std::size_t missed = 0, late = 0, loose = 0, met = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Slab exact = slabs_in_double(rays[i], boxes[i]);
        const bool inside = exact.first <= exact.last;
        met += inside;
        missed += inside && !answers[i].met;
        late += inside && answers[i].met && answers[i].entry > exact.first;
        // 32 units of 2^-24 is twice the slack: a hit that the exact test denies must be that close.
        loose += !inside && answers[i].met && !(exact.first * (1.0 - 0x1p-19) <= exact.last * (1.0 + 0x1p-19));
    }
    CHECK(met > count / 20);
    CHECK(missed == 0);
    CHECK(late == 0);
    CHECK(loose == 0);
}

TEST_CASE("ray_box: zero, denormal and huge components, faces, edges and corners") {
    const Aabb cube{{-1, -1, -1}, {1, 1, 1}};
    const Aabb flat{{-1, -1, 0}, {1, 1, 0}};
    const Aabb empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    struct Case {
        const char* what;
        Ray ray;
        Aabb box;
        bool met;
    };
    const std::vector<Case> cases{
        {"through the middle", {{0, 0, -5}, 0, {0, 0, 1}, infinity}, cube, true},
        {"negative zeros", {{0, 0, -5}, 0, {-0.0f, -0.0f, 1}, infinity}, cube, true},
        {"in the plane of a face", {{1, 0, -5}, 0, {0, 0, 1}, infinity}, cube, true},
        {"in the plane of a face, negative zero", {{1, 0, -5}, 0, {-0.0f, 0, 1}, infinity}, cube, true},
        {"in the plane of the other face", {{-1, 0, -5}, 0, {0, 0, 1}, infinity}, cube, true},
        {"along an edge", {{1, 1, -5}, 0, {0, 0, 1}, infinity}, cube, true},
        {"just outside the face", {{std::nextafter(1.0f, 2.0f), 0, -5}, 0, {0, 0, 1}, infinity}, cube, false},
        {"beside, endless", {{3, 0, 0}, 0, {0, 0, 1}, infinity}, cube, false},
        {"through a corner", {{2, 2, 2}, 0, {-1, -1, -1}, infinity}, cube, true},
        {"away from it", {{0, 0, 5}, 0, {0, 0, 1}, infinity}, cube, false},
        {"from inside", {{0, 0, 0}, 0, {1, 2, 3}, infinity}, cube, true},
        {"from the face outwards", {{0, 0, 1}, 0, {0, 0, 1}, infinity}, cube, true},
        {"within a flat box", {{-5, 0, 0}, 0, {1, 0, 0}, infinity}, flat, true},
        {"across a flat box", {{0, 0, -5}, 0, {0, 0, 1}, infinity}, flat, true},
        {"ends before", {{0, 0, -5}, 0, {0, 0, 1}, 3.5f}, cube, false},
        {"ends on the face", {{0, 0, -5}, 0, {0, 0, 1}, 4.0f}, cube, true},
        {"begins behind", {{0, 0, -5}, 6.5f, {0, 0, 1}, infinity}, cube, false},
        {"denormal aside, outside", {{3, 0, 0}, 0, {denormal, 0, 1}, infinity}, cube, false},
        {"denormal aside, inside", {{0.5f, 0, -5}, 0, {denormal, -denormal, 1}, infinity}, cube, true},
        {"denormal direction from a denormal distance",
         {{-64 * denormal, 0, 0}, 0, {denormal, 0, 0}, 100.0f},
         {{0, 0, 0}, {1, 1, 1}},
         true},
        {"huge direction", {{0, 0, -5}, 0, {0, 0, largest}, infinity}, cube, true},
        {"the empty box", {{0, 0, 0}, 0, {1, 1, 1}, infinity}, empty, false},
        {"the empty box, backwards", {{0, 0, 0}, 0, {-1, -1, -1}, infinity}, empty, false},
        {"the empty box, along an axis", {{0, 0, 0}, 0, {0, 0, 1}, infinity}, empty, false},
    };
    std::vector<Ray> rays;
    std::vector<Aabb> boxes;
    for (const Case& each : cases) rays.push_back(each.ray), boxes.push_back(each.box);
    const std::vector<Answer> answers = test_boxes(rays, boxes);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        CAPTURE(cases[i].what);
        CHECK(answers[i].met == cases[i].met);
        CHECK_FALSE(std::isnan(answers[i].entry));
    }
}
