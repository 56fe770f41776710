// SPDX-License-Identifier: MIT
// The oriented box test against slabs in double precision: never a miss where the exact answer is a hit, and tight.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "oracles/reference_obb.hpp"
#include "runtime/launch.hpp"
#include "shared/node.h"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float denormal = std::numeric_limits<float>::denorm_min();
constexpr float largest = std::numeric_limits<float>::max();

struct Answer {
    bool met;
    float entry;
};

std::vector<Answer> test_boxes(const std::vector<Ray>& rays, const std::vector<Obb>& boxes) {
    Device& device = test_device();
    const auto count = static_cast<std::uint32_t>(rays.size());
    // The other slot is not a number, so that whatever is read of it shows.
    OrientedNode blank;
    std::fill_n(blank.volume[0], 15, not_a_number);
    std::fill_n(blank.volume[1], 15, not_a_number);
    blank.child[0] = blank.child[1] = 0x7fc00000u;
    std::vector<OrientedNode> nodes(count, blank);
    for (std::uint32_t i = 0; i < count; ++i) store_volume(boxes[i], nodes[i].volume[i % 2]);
    const Buffer<Ray> source = upload(device, rays, "rays");
    const Buffer<OrientedNode> targets = upload(device, nodes, "nodes");
    const Guarded<std::uint32_t> met(device, count);
    const Guarded<float> entries(device, count);
    launch(device, {"traverse/ray_obb_test.cl", "ray_obb_test", {{"PORTABLE_LANES", "1"}}}, "ray obb", count, source,
           targets, count, met.view(), entries.view());
    CHECK(met.intact());
    CHECK(entries.intact());
    const auto met_values = met.values();
    const auto entry_values = entries.values();
    std::vector<Answer> answers;
    for (std::uint32_t i = 0; i < count; ++i) answers.push_back({met_values[i] != 0, entry_values[i]});
    return answers;
}

struct Slab {
    double first, last;
};

/// Cuts the interval down to the t with speed t <= room.
void cut(Slab& slab, double speed, double room) {
    if (speed > 0.0) slab.last = std::min(slab.last, room / speed);
    if (speed < 0.0) slab.first = std::max(slab.first, room / speed);
    if (speed == 0.0 && room < 0.0) slab.last = -1.0;
}

/// Where the ray is inside the box, exactly but for double rounding; with `loose`, of which each slab k is wider by
/// loose (extent + S_k + t T_k) and 2^-122 (see cl/traverse/ray_obb.h).
Slab slabs_in_double(const Ray& ray, const Obb& box, double loose) {
    Slab slab{ray.t_min, ray.t_max};
    const glm::dmat3 rows = rows_of(box);
    const glm::dvec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
    const glm::dvec3 origin(ray.origin[0], ray.origin[1], ray.origin[2]);
    const glm::dvec3 from_center = origin - glm::dvec3(box.center[0], box.center[1], box.center[2]);
    for (int k = 0; k < 3; ++k) {
        const double position = along(rows, k, from_center), speed = along(rows, k, direction);
        const glm::dvec3 size = glm::abs(rows[k]);
        const double underflow = loose > 0.0 ? 0x1p-122 : 0.0;
        const double reach =
            box.extent[k] + loose * (box.extent[k] + glm::dot(size, glm::abs(from_center))) + underflow;
        const double doubt = loose * glm::dot(size, glm::abs(direction));
        cut(slab, speed - doubt, reach - position);
        cut(slab, -speed - doubt, reach + position);
    }
    return slab;
}

/// The bound that cl/traverse/ray_obb.h states, and the slack of the quotients.
bool may_be_met(const Ray& ray, const Obb& box) {
    const Slab wide = slabs_in_double(ray, box, 0x1p-20);
    return wide.first * (1.0 - 0x1p-19) <= wide.last * (1.0 + 0x1p-19);
}

struct Counts {
    std::size_t met = 0, missed = 0, late = 0, loose = 0, not_a_number = 0;
};

Counts compare(const std::vector<Ray>& rays, const std::vector<Obb>& boxes) {
    const std::vector<Answer> answers = test_boxes(rays, boxes);
    Counts counts;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Slab exact = slabs_in_double(rays[i], boxes[i], 0.0);
        const bool inside = exact.first <= exact.last;
        counts.met += inside;
        counts.missed += inside && !answers[i].met;
        counts.late += inside && answers[i].met && answers[i].entry > exact.first;
        counts.loose += !inside && answers[i].met && !may_be_met(rays[i], boxes[i]);
        counts.not_a_number += std::isnan(answers[i].entry);
    }
    return counts;
}

/// How far apart things are: boxes of `size`, within `offset` of the origin, rays from within `distance` of the box.
struct Scale {
    const char* what;
    double size, offset, distance;
};

glm::dvec3 random_vector(Random& random) {
    const double x = random.uniform(-1.0f, 1.0f), y = random.uniform(-1.0f, 1.0f);
    return {x, y, random.uniform(-1.0f, 1.0f)};
}

Obb random_box(Random& random, const Scale& scale) {
    const glm::dmat3 rows = random_rows(random, random.below(2) == 0);
    Obb box = box_around(rows, {scale.offset * random_vector(random)});
    for (int k = 0; k < 3; ++k)
        box.extent[k] = random.below(4) == 0 ? 0.0f : static_cast<float>(scale.size * random.uniform(0.0f, 1.0f));
    return box;
}

/// Through a point of the box, exactly but for the rounding of origin and direction: from afar or from the box, along a
/// face, or with components of zero; half the rays end or begin near that point.
Ray random_ray(Random& random, const Obb& box, const Scale& scale) {
    const glm::dmat3 to_world = glm::inverse(glm::transpose(rows_of(box)));
    glm::dvec3 local;
    for (int k = 0; k < 3; ++k)
        local[k] = box.extent[k] * (random.below(2) == 0 ? random.uniform(-1.0f, 1.0f) : random.below(2) ? 1.0 : -1.0);
    const glm::dvec3 target = glm::dvec3(box.center[0], box.center[1], box.center[2]) + to_world * local;
    glm::dvec3 direction = random_vector(random);
    if (random.below(4) == 0) direction[static_cast<int>(random.below(3))] = 0.0;
    if (random.below(4) == 0) direction = to_world[0];
    if (random.below(4) == 0) // in the plane of a face
        direction =
            to_world[0] * double(random.uniform(-1.0f, 1.0f)) + to_world[1] * double(random.uniform(-1.0f, 1.0f));
    if (glm::length(direction) < 0.1) direction = {0.0, 1.0, 0.0};
    const glm::vec3 d(direction);
    if (random.below(8) == 0) { // from just beside the middle, so slowly out of its plane that the speed has no sign
        const glm::dvec3 start = target - to_world * (local + 3e-7 * scale.size * random_vector(random));
        direction = target - start;
        const glm::vec3 from(start), to(direction);
        return {{from.x, from.y, from.z}, 0.0f, {to.x, to.y, to.z}, infinity};
    }
    const double back = random.below(4) == 0 ? 0.0 : scale.distance * random.uniform(0.0f, 1.0f);
    const glm::vec3 origin(target - back * glm::dvec3(d));
    Ray ray{{origin.x, origin.y, origin.z}, 0.0f, {d.x, d.y, d.z}, infinity};
    if (random.below(4) == 0) ray.t_max = static_cast<float>(back);
    if (random.below(4) == 0) ray.t_min = static_cast<float>(back);
    return ray;
}

const std::vector<Scale> scales = {
    {"near", 1.0, 1.0, 4.0},
    {"far from the origin", 1e-3, 1e7, 1.0},
    {"rays from afar", 1.0, 1.0, 1e7},
    {"needles", 1e6, 1.0, 1.0},
    {"tiny", 1e-30, 1e-30, 1e-30},
    {"huge", 1e18, 1e18, 1e18},
    {"tiny, from afar", 1e-30, 1e-30, 1e18},
};

} // namespace

TEST_CASE("ray_obb: conservative and tight at every scale, turned, sheared, flat, from inside and along faces") {
    // 20,000 of each: every arrangement of random_ray, which are a few hundred, with every kind of box.
    const std::uint32_t count = small_sizes() ? 200 : 20000;
    for (const Scale& scale : scales) {
        CAPTURE(std::string(scale.what));
        Random random(40);
        std::vector<Obb> boxes;
        std::vector<Ray> rays;
        for (std::uint32_t i = 0; i < count; ++i) {
            boxes.push_back(random_box(random, scale));
            rays.push_back(random_ray(random, boxes.back(), scale));
        }
        const Counts counts = compare(rays, boxes);
        CHECK(counts.met > count / 20);
        CHECK(counts.missed == 0);
        CHECK(counts.late == 0);
        CHECK(counts.loose == 0);
        CHECK(counts.not_a_number == 0);

        // Beside the box: most rays miss.
        std::rotate(boxes.begin(), boxes.begin() + 1, boxes.end());
        const Counts others = compare(rays, boxes);
        CHECK(others.missed == 0);
        CHECK(others.late == 0);
        CHECK(others.loose == 0);
    }
}

TEST_CASE("ray_obb: zero, denormal, huge and invalid components, faces, edges and corners") {
    // Exact numbers: a box turned by a quarter about z, with half sizes 1, 2 and 3 along y, -x and z.
    const Obb turned{{0, 0, 0}, {1, 2, 3}, {0, 1, 0, -1, 0, 0, 0, 0, 1}, 0};
    const Obb flat{{0, 0, 0}, {0, 2, 3}, {0, 1, 0, -1, 0, 0, 0, 0, 1}, 0};
    const Obb point{{0, 0, 0}, {0, 0, 0}, {0, 1, 0, -1, 0, 0, 0, 0, 1}, 0};
    struct Case {
        const char* what;
        Ray ray;
        Obb box;
        bool met;
    };
    const std::vector<Case> cases{
        {"through the middle", {{0, 0, -5}, 0, {0, 0, 1}, infinity}, turned, true},
        {"negative zeros", {{0, 0, -5}, 0, {-0.0f, -0.0f, 1}, infinity}, turned, true},
        {"in the plane of a face", {{2, 0, -5}, 0, {0, 0, 1}, infinity}, turned, true},
        {"in the plane of the other face", {{0, -1, -5}, 0, {0, -0.0f, 1}, infinity}, turned, true},
        {"along an edge", {{2, 1, -5}, 0, {0, 0, 1}, infinity}, turned, true},
        {"outside the face", {{2.001f, 0, -5}, 0, {0, 0, 1}, infinity}, turned, false},
        {"beside, endless", {{0, 3, 0}, 0, {0, 0, 1}, infinity}, turned, false},
        {"through a corner", {{4, 3, 5}, 0, {-1, -1, -1}, infinity}, turned, true},
        {"away from it", {{0, 0, 5}, 0, {0, 0, 1}, infinity}, turned, false},
        {"from inside", {{0, 0, 0}, 0, {1, 2, 3}, infinity}, turned, true},
        {"from the face outwards", {{0, 0, 3}, 0, {0, 0, 1}, infinity}, turned, true},
        {"within a flat box", {{-5, 0, 0}, 0, {1, 0, 0}, infinity}, flat, true},
        {"across a flat box", {{0, -5, 0}, 0, {0, 1, 0}, infinity}, flat, true},
        {"beside a flat box", {{-5, 0.001f, 0}, 0, {1, 0, 0}, infinity}, flat, false},
        {"through a point", {{3, 3, 3}, 0, {-1, -1, -1}, infinity}, point, true},
        {"past a point", {{3, 3, 3}, 0, {-1, -1, -1.001f}, infinity}, point, false},
        {"from a point", {{0, 0, 0}, 0, {0, 0, 1}, 0}, point, true},
        {"ends before", {{0, 0, -5}, 0, {0, 0, 1}, 1.5f}, turned, false},
        {"ends on the face", {{0, 0, -5}, 0, {0, 0, 1}, 2.0f}, turned, true},
        {"begins behind", {{0, 0, -5}, 8.5f, {0, 0, 1}, infinity}, turned, false},
        {"denormal aside, outside", {{3, 0, 0}, 0, {denormal, 0, 1}, 100.0f}, turned, false},
        {"denormal aside, inside", {{0.5f, 0, -5}, 0, {denormal, -denormal, 1}, infinity}, turned, true},
        {"denormal direction", {{0, 0, -64 * denormal}, 0, {0, 0, denormal}, 100.0f}, point, true},
        {"huge direction", {{0, 0, -5}, 0, {0, 0, largest}, infinity}, turned, true},
        {"from beyond all numbers", {{0, 0, -largest}, 0, {0, 0, 1}, infinity}, turned, true},
    };
    std::vector<Ray> rays;
    std::vector<Obb> boxes;
    for (const Case& each : cases) rays.push_back(each.ray), boxes.push_back(each.box);
    std::vector<Answer> answers = test_boxes(rays, boxes);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        CAPTURE(cases[i].what);
        CHECK(answers[i].met == cases[i].met);
        CHECK_FALSE(std::isnan(answers[i].entry));
    }
    // No ray that traversal lets through; still nothing that is not a number comes out.
    rays.clear();
    for (const float bad : {not_a_number, infinity, -infinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            rays.push_back({{0, 0, -5}, 0, {0, 0, 1}, infinity}), rays.back().origin[axis] = bad;
            rays.push_back({{0, 0, -5}, 0, {0, 0, 1}, infinity}), rays.back().direction[axis] = bad;
        }
    }
    boxes.assign(rays.size(), turned);
    answers = test_boxes(rays, boxes);
    for (const Answer& answer : answers) CHECK_FALSE(std::isnan(answer.entry));
}
