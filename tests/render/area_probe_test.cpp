// SPDX-License-Identifier: MIT
// What a probe finds in a scene, and whether areas are worth their trees.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "boxwood/area_probe.hpp"
#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "support.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// A floor of n x n squares over [-1, 1]^2 in the plane y = 0.
Scene floor_of(std::uint32_t n, double scale = 1) {
    Mesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t k = 0; k <= n; ++k)
            mesh.positions.emplace_back(scale * (2.0 * k / n - 1), 0.0, scale * (2.0 * i / n - 1));
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t first = i * (n + 1) + k, above = first + n + 1;
            mesh.triangles.emplace_back(first, above, first + 1);
            mesh.triangles.emplace_back(first + 1, above, above + 1);
        }
    return single(mesh);
}

/// The floor below slivers from one edge to another, whose boxes are over all of it, but not the slivers.
Scene cluttered_floor() {
    Scene scene = floor_of(4);
    Mesh& mesh = scene.meshes[0];
    for (std::uint32_t i = 0; i < (small_sizes() ? 8u : 200u); ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const float y = 0.1f + 0.004f * static_cast<float>(i);
        mesh.positions.insert(mesh.positions.end(), {{-1, y, 1.3f}, {1.3f, y, -1}, {1.3f, y, -0.99f}});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return scene;
}

/// Looks down from a height; orthographic where half_height is given, else with a tangent of a half of 0.25.
Camera camera_above(double height, double half_height = 0) {
    Camera camera;
    camera.to_world = glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, -1, 0), glm::vec4(0, 1, 0, 0),
                                glm::vec4(0, static_cast<float>(height), 0, 1));
    camera.perspective = half_height == 0;
    camera.half_height = static_cast<float>(half_height);
    camera.vertical_fov = 2 * std::atan(0.25f);
    return camera;
}

const ProbedArea* of_rays(const std::vector<ProbedArea>& probed, const std::string& rays) {
    const auto found = std::find_if(probed.begin(), probed.end(), [&](const ProbedArea& p) { return p.rays == rays; });
    return found == probed.end() ? nullptr : &*found;
}

std::uint32_t squares() { return small_sizes() ? 4 : 64; }

} // namespace

TEST_CASE("area_probe: a camera's rays come from its eye, or are parallel") {
    for (const double scale : {1.0, 0x1p-40, 0x1p40}) {
        CAPTURE(scale);
        const Scene scene = floor_of(squares(), scale);
        std::vector<ProbedArea> probed = probe_areas(test_device(), scene, camera_above(2 * scale), {});
        const ProbedArea* found = of_rays(probed, "primary");
        REQUIRE(found != nullptr);
        CHECK(found->count == 256); // half a floor's width in sight
        CHECK(found->area.kind == AreaKind::point);
        CHECK(glm::length(found->area.origin - glm::dvec3(0, 2 * scale, 0)) < 1e-3 * scale);
        CHECK(glm::normalize(found->area.direction).y == doctest::Approx(-1).epsilon(1e-4));
        CHECK(found->area.half_width == doctest::Approx(0.25 * 255 / 256).epsilon(1e-2));
        CHECK(found->area.far == doctest::Approx(2 * scale).epsilon(1e-2));
        CHECK(of_rays(probed, "diffuse") == nullptr);
        REQUIRE(found->area.share.has_value());
        CHECK(*found->area.share > 0);
        CHECK(*found->area.share <= 1);

        probed = probe_areas(test_device(), scene, camera_above(2 * scale, 0.5 * scale), {});
        found = of_rays(probed, "primary");
        REQUIRE(found != nullptr);
        CHECK(found->count == 256);
        CHECK(found->area.kind == AreaKind::plane);
        CHECK(std::abs(glm::normalize(found->area.direction).y) == doctest::Approx(1).epsilon(1e-6));
        CHECK(found->area.half_width == doctest::Approx(0.5 * scale * 255 / 256).epsilon(1e-2));
        CHECK(found->area.half_height == doctest::Approx(0.5 * scale * 255 / 256).epsilon(1e-2));
    }
}

TEST_CASE("area_probe: shadow rays end at the light") {
    Scene scene = floor_of(squares());
    scene.instances.push_back(scene.instances[0]); // a ceiling, so that the light is off the floor
    scene.instances[1].transform[3] = glm::vec4(0, 4, 0, 1);
    const glm::dvec3 light = default_light(scene);
    const std::vector<ProbedArea> probed = probe_areas(test_device(), scene, camera_above(2), {});
    const ProbedArea* found = of_rays(probed, "shadow");
    REQUIRE(found != nullptr);
    CHECK(found->area.kind == AreaKind::point);
    CHECK(glm::length(found->area.origin - light) < 1e-3);
    CHECK(found->count == 256);
}

TEST_CASE("area_probe: areas are kept where their trees cost less") {
    // Through the middle of the floor, which no sliver crosses.
    std::vector<ProbedArea> probed = probe_areas(test_device(), cluttered_floor(), camera_above(2, 1.0 / 32), {});
    const ProbedArea* found = of_rays(probed, "primary");
    REQUIRE(found != nullptr);
    CHECK(found->local_cost < found->global_cost);
    CHECK(found->kept);
    // A floor of two triangles: the local tree is the global one, and the lookup comes on top.
    probed = probe_areas(test_device(), floor_of(1), camera_above(2), {});
    found = of_rays(probed, "primary");
    REQUIRE(found != nullptr);
    CHECK(found->local_cost > found->global_cost);
    CHECK(!found->kept);
    for (const ProbedArea& each : probed) CHECK((!each.kept || each.local_cost < each.global_cost));
}

TEST_CASE("area_probe: the same every time, and by every builder") {
    const Scene scene = floor_of(squares());
    for (const Builder builder : {Builder::lbvh, Builder::sah, Builder::pah, Builder::blend}) {
        CAPTURE(std::string(name(builder)));
        BuildOptions options;
        options.builder = builder;
        const auto first = probe_areas(test_device(), scene, camera_above(2), options);
        const auto second = probe_areas(test_device(), scene, camera_above(2), options);
        REQUIRE(first.size() == second.size());
        CHECK(!first.empty());
        for (std::size_t i = 0; i < first.size(); ++i) {
            CHECK(first[i].area.origin == second[i].area.origin);
            CHECK(first[i].area.direction == second[i].area.direction);
            CHECK(first[i].area.half_width == second[i].area.half_width);
            CHECK(first[i].rays == second[i].rays);
            CHECK(first[i].count == second[i].count);
            CHECK(first[i].global_cost == second[i].global_cost);
            CHECK(first[i].local_cost == second[i].local_cost);
            CHECK(first[i].kept == second[i].kept);
        }
        if (builder == Builder::blend) continue;
        for (const ProbedArea& each : first) CHECK(each.global_cost > 0);
    }
}

TEST_CASE("area_probe: scenes without triangles, out of sight, and at the ends of coordinates") {
    CHECK(probe_areas(test_device(), Scene(), Camera(), {}).empty());
    Camera up = camera_above(2);
    up.to_world = glm::mat4(1.0f);
    up.to_world[3] = glm::vec4(0, 2, 0, 1); // along the floor, over it
    const std::vector<ProbedArea> away = probe_areas(test_device(), floor_of(1), up, {});
    for (const ProbedArea& each : away) CHECK(each.count >= 16);
    for (const double scale : {0x1p-58, 0x1p59, 0x1p60}) {
        CAPTURE(scale);
        CHECK_NOTHROW(probe_areas(test_device(), floor_of(2, scale), camera_above(2 * scale), {}));
        CHECK_NOTHROW(probe_areas(test_device(), floor_of(2, scale), camera_above(2 * scale, 0.5 * scale), {}));
    }
}

TEST_CASE("area_probe: areas are judged one by one, those that light nothing among them") {
    const Scene scene = cluttered_floor();
    InfluenceArea window;
    window.origin = {0.25, 1, 0.25};
    window.direction = {0, -1, 0};
    window.half_width = window.half_height = 1.0 / 32;
    window.far = 2;
    window.share = 0.125;
    InfluenceArea beside = window;
    beside.origin.x = 50;
    InfluenceArea lamp = window;
    lamp.kind = AreaKind::point;
    lamp.near = 0.125;
    const std::vector<InfluenceArea> areas{beside, window, lamp};
    const std::vector<ProbedArea> judged = judge_areas(test_device(), scene, areas, {});
    REQUIRE(judged.size() == 3);
    CHECK(judged[0].count == 0);
    CHECK(!judged[0].kept);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(judged[i].area.origin == areas[i].origin);
        CHECK(judged[i].area.share == areas[i].share);
        CHECK(judged[i].rays == "shadow");
        if (i > 0) CHECK(judged[i].count == 256);
        // Nothing is between the floor and where the area's rays leave, so that local trees answer no ray: they are not
        // kept, though there is less to test.
        if (i > 0) CHECK(judged[i].local_cost < judged[i].global_cost);
        CHECK(!judged[i].kept);
    }
    CHECK(judge_areas(test_device(), scene, {}, {}).empty());
    CHECK(judge_areas(test_device(), Scene(), areas, {}).empty());
    std::vector<InfluenceArea> bad = areas;
    bad[2].far = 0;
    CHECK_THROWS_WITH_AS(judge_areas(test_device(), scene, bad, {}), doctest::Contains("area 2"), InputError);
}

TEST_SUITE_END();
