// SPDX-License-Identifier: MIT
// Every kind of index finds the areas that hold a point, on the host and on the device.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "boxwood/area_index.hpp"
#include "boxwood/error.hpp"
#include "boxwood/influence.hpp"
#include "build/local_trees.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("influence");

namespace {

constexpr AreaIndexKind all_kinds[] = {AreaIndexKind::list, AreaIndexKind::octree, AreaIndexKind::kd};

/// Areas in a cube of side 10 * scale, askew and along the axes, as a tree has them.
std::vector<LocalArea> random_areas(Random& random, std::uint32_t count, double scale) {
    std::vector<InfluenceArea> areas;
    for (std::uint32_t i = 0; i < count; ++i) {
        InfluenceArea area;
        area.kind = random.below(2) ? AreaKind::point : AreaKind::plane;
        for (int k = 0; k < 3; ++k) {
            area.origin[k] = scale * random.uniform(-5.0f, 5.0f);
            area.direction[k] = random.uniform(-1.0f, 1.0f);
        }
        if (random.below(2)) area.direction = {0, i % 3 == 0 ? 1 : 0, i % 3 == 0 ? 0 : 1};
        const bool point = area.kind == AreaKind::point;
        area.half_width = random.uniform(0.1f, 1.0f) * (point ? 1.0 : scale);
        area.half_height = random.uniform(0.1f, 1.0f) * (point ? 1.0 : scale);
        area.near = point ? 0.1 * scale : 0.0;
        area.far = scale * random.uniform(0.5f, 5.0f);
        areas.push_back(area);
    }
    std::vector<LocalArea> result;
    for (const InfluenceRecord& record : influence_records(areas)) {
        result.push_back(local_area(record));
    }
    return result;
}

/// Of the region, by how much a point may move before it is outside, about; negative where it is outside.
double room(const InfluenceRecord& region, const glm::dvec3& point) {
    const glm::dvec3 from = point - glm::dvec3(region.origin[0], region.origin[1], region.origin[2]);
    const auto along = [&](const float(&axis)[3]) { return from.x * axis[0] + from.y * axis[1] + from.z * axis[2]; };
    const double z = along(region.forward), spread = region.point ? z : 1.0;
    return std::min({spread * region.half_width - std::abs(along(region.right)),
                     spread * region.half_height - std::abs(along(region.up)), z - region.near, region.far - z});
}

/// Anywhere in and around, and on planes that split cells.
std::vector<glm::vec3> random_points(Random& random, std::uint32_t count, float scale, const AreaIndex& index) {
    std::vector<glm::vec3> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        glm::vec3 p;
        for (int k = 0; k < 3; ++k) p[k] = scale * random.uniform(-8.0f, 8.0f);
        const AreaNode& node = index.nodes[random.below(static_cast<std::uint32_t>(index.nodes.size()))];
        for (int k = 0; k < 3; ++k)
            if (random.below(3) == 0 && node.split[k] != 0.0f) p[k] = node.split[k];
        points.push_back(p);
    }
    return points;
}

struct Found {
    std::vector<std::uint32_t> bits;
    std::vector<std::uint32_t> tried;
};

Found find_on_device(const AreaIndex& index, const std::vector<LocalArea>& areas,
                     const std::vector<glm::vec3>& points) {
    Device& device = test_device();
    const auto count = static_cast<std::uint32_t>(points.size());
    std::vector<float> scalars;
    for (const glm::vec3& p : points) scalars.insert(scalars.end(), {p.x, p.y, p.z});
    const Guarded<std::uint32_t> bits(device, count), tried(device, count);
    launch(device, {"traverse/area_lookup_test.cl", "area_lookup_test"}, "area lookup", count,
           upload(device, areas, "areas"), upload(device, index.nodes, "nodes"), upload(device, index.items, "items"),
           upload(device, scalars, "points"), bits.view(), tried.view(), count);
    CHECK(bits.intact());
    CHECK(tried.intact());
    return {bits.values(), tried.values()};
}

} // namespace

TEST_CASE("area_index: every kind finds the areas that hold a point, and no others") {
    // 1: one cell; 32: as many as the test's bits.
    for (const std::uint32_t count : {1u, 3u, 32u}) {
        for (const double scale : {1.0, 1e-10, 1e10}) {
            CAPTURE(count);
            CAPTURE(scale);
            Random random(60 + count);
            const std::vector<LocalArea> areas = random_areas(random, count, scale);
            std::vector<glm::vec3> points;
            for (const AreaIndexKind kind : all_kinds) {
                const auto more = random_points(random, small_sizes() ? 20 : 3000, static_cast<float>(scale),
                                                build_area_index(areas, kind));
                points.insert(points.end(), more.begin(), more.end());
            }
            Found list;
            std::size_t inside = 0, tried[3] = {};
            for (int k = 0; k < 3; ++k) {
                CAPTURE(std::string(name(all_kinds[k])));
                const AreaIndex index = build_area_index(areas, all_kinds[k]);
                CHECK(index.kind == all_kinds[k]);
                const Found found = find_on_device(index, areas, points);
                if (k == 0) list = found;
                CHECK(same_bits(found.bits, list.bits)); // also where rounding decides
                std::size_t wrong = 0, unlike = 0;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    std::vector<std::uint32_t> expected;
                    for (std::uint32_t a = 0; a < count; ++a)
                        if (contains(areas[a].region, points[i])) expected.push_back(a);
                    unlike += find_areas(index, areas, points[i]) != expected;
                    std::uint32_t sure = 0, possible = 0; // well inside, and nearly
                    for (std::uint32_t a = 0; a < count; ++a) {
                        if (room(areas[a].region, points[i]) > 1e-4 * scale) sure |= 1u << a;
                        if (room(areas[a].region, points[i]) > -1e-4 * scale) possible |= 1u << a;
                    }
                    wrong += (found.bits[i] & sure) != sure || (found.bits[i] & ~possible) != 0;
                    inside += found.bits[i] != 0;
                    tried[k] += found.tried[i];
                }
                CHECK(wrong == 0);
                CHECK(unlike == 0);
            }
            if (!small_sizes()) CHECK(inside > 0);
            if (count == 32 && !small_sizes()) {
                CHECK(3 * tried[1] < tried[0]);
                CHECK(3 * tried[2] < tried[0]);
            }
        }
    }
}

TEST_CASE("area_index: an octree stops at cells that areas enclose or do not meet, and at five levels") {
    InfluenceArea area;
    area.direction = {0, 0, 1};
    area.half_width = area.half_height = 1.0;
    area.far = 2.0;
    LocalArea only{influence_records(std::vector{area})[0], {{-1, -1, 0}, {1, 1, 2}}, 0, 0};
    CHECK(build_area_index(std::vector{only}, AreaIndexKind::octree).nodes.size() == 1);
    only.box = {{-1, -1, -2}, {1, 1, 2}}; // the lower half is empty, but for the cells that touch
    const AreaIndex index = build_area_index(std::vector{only}, AreaIndexKind::octree);
    CHECK(index.nodes.size() > 1);
    CHECK(index.nodes.size() <= 1 + 8 + 64 + 512 + 4096);
    CHECK(find_areas(index, std::vector{only}, {0.5f, 0.5f, 1.0f}) == std::vector<std::uint32_t>{0});
    CHECK(find_areas(index, std::vector{only}, {0.5f, 0.5f, -1.0f}).empty());
    CHECK(find_areas(index, std::vector{only}, {50.0f, 0.5f, 1.0f}).empty());
}

TEST_CASE("area_index: words, no areas, and the choice by their number") {
    for (const AreaIndexKind kind : all_kinds) CHECK(to_area_index(name(kind)) == kind);
    CHECK_THROWS_AS(to_area_index("grid"), InputError);
    CHECK(build_area_index({}, AreaIndexKind::automatic).nodes.empty());
    Random random(61);
    const std::vector<LocalArea> many = random_areas(random, 9, 1.0);
    CHECK(build_area_index(std::span(many).first(8), AreaIndexKind::automatic).kind == AreaIndexKind::list);
    CHECK(build_area_index(many, AreaIndexKind::automatic).kind == AreaIndexKind::kd);
}

TEST_CASE("area_index: a point beside a region by less than coordinates can tell is found in every kind") {
    // Floats are 2^-3 apart here. The octree's first split in x is the float that the first region misses by 2^-21,
    // which is within the rounding of area_contains.
    std::vector<InfluenceArea> areas(2);
    for (InfluenceArea& area : areas) area.direction = {0, 0, 1};
    areas[0].origin.x = 0x1p20;
    areas[0].half_width = 0.875 - 0x1p-21;
    areas[1].origin.x = 0x1p20 + 2.0;
    areas[1].half_width = 0.5;
    std::vector<LocalArea> local;
    for (const InfluenceRecord& record : influence_records(areas)) local.push_back(local_area(record));
    const std::vector<glm::vec3> point{{0x1p20f + 0.875f, 0.0f, 0.5f}};
    CHECK(!contains(local[0].region, point[0]));
    const AreaIndex octree = build_area_index(local, AreaIndexKind::octree);
    CHECK(octree.nodes[0].split[0] == point[0].x);
    for (const AreaIndexKind kind : all_kinds) {
        CAPTURE(std::string(name(kind)));
        CHECK(find_on_device(build_area_index(local, kind), local, point).bits[0] == 1);
    }
}

TEST_CASE("area_index: as many areas as there can be, all over each other") {
    // The same region again and again, a little larger each time: no plane parts them.
    const std::uint32_t count = small_sizes() ? 40 : most_areas;
    std::vector<InfluenceArea> areas(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        areas[i].direction = {0.3, 1.0, 0.2};
        areas[i].half_width = areas[i].half_height = areas[i].far = 1.0 + i / 65536.0;
    }
    std::vector<LocalArea> local;
    for (const InfluenceRecord& record : influence_records(areas)) local.push_back(local_area(record));
    for (const AreaIndexKind kind : all_kinds) {
        const AreaIndex index = build_area_index(local, kind);
        CHECK(index.items.size() >= count);
        CHECK(index.items.size() <= 73 * count + 0x8000); // 64 an area and some, and what one more split adds
        CHECK(find_areas(index, local, {0.15f, 0.5f, 0.1f}).size() == count);
        CHECK(find_areas(index, local, {5.0f, 0.5f, 0.1f}).empty());
    }
}

TEST_SUITE_END();
