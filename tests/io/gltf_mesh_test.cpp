// SPDX-License-Identifier: MIT
#include "io/gltf_mesh.hpp"

#include <limits>

#include <doctest/doctest.h>

#include "io/gltf_fixture.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

// A zigzag (x, y): 0 below, 1 above, 2 below ... as strips have it, with the vertices in the order of `order`.
GltfFixture zigzag(int mode, const std::vector<std::uint32_t>& order) {
    GltfFixture fixture;
    const std::size_t positions = fixture.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0});
    fixture.show({{"attributes", {{"POSITION", positions}}}, {"indices", fixture.indices(order)}, {"mode", mode}});
    return fixture;
}

double normal_z(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.positions[t.x]);
    return glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a).z;
}

} // namespace

TEST_CASE("gltf_mesh: strips and fans: every triangle faces the way of the first") {
    const Mesh strip = zigzag(5, {0, 1, 2, 3, 4, 5}).load().meshes.at(0);
    CHECK(strip.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}); // glTF 2.0, 3.7.2.1
    for (const glm::uvec3& t : strip.triangles) CHECK(normal_z(strip, t) > 0);

    const Mesh fan = zigzag(6, {0, 1, 3, 5, 4, 2}).load().meshes.at(0);
    CHECK(fan.triangles == std::vector<glm::uvec3>{{1, 3, 0}, {3, 5, 0}, {5, 4, 0}, {4, 2, 0}});
    for (const glm::uvec3& t : fan.triangles) CHECK(normal_z(fan, t) >= 0);
    CHECK(zigzag(5, {0, 1}).load().meshes.empty());
    CHECK(zigzag(6, {0}).load().meshes.empty());
}

TEST_CASE("gltf_mesh: points and lines are skipped and counted, modes beyond fans refused") {
    for (int mode = 0; mode < 4; ++mode) {
        const Scene scene = zigzag(mode, {0, 1, 2}).load();
        CHECK(scene.meshes.empty());
        CHECK(scene.counts.skipped_points_and_lines == 1);
        CHECK(scene.counts.dropped_instances == 1);
        CHECK(scene.warnings.at(0).starts_with("meshes[0].primitives[0]"));
    }
    CHECK(zigzag(7, {0, 1, 2}).fault() == "meshes[0].primitives[0].mode");
}

TEST_CASE("gltf_mesh: primitives of a mesh are concatenated; those that share positions share vertices") {
    GltfFixture fixture;
    const std::size_t a = fixture.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const std::size_t b = fixture.positions({0, 0, 5, 1, 0, 5, 0, 1, 5});
    const json first = {{"attributes", {{"POSITION", a}}}, {"indices", fixture.indices({0, 1, 2})}};
    const json second = {{"attributes", {{"POSITION", b}}}};
    const json third = {{"attributes", {{"POSITION", a}}}, {"indices", fixture.indices({1, 3, 2})}};
    fixture.append("meshes", {{"primitives", {first, second, third}}, {"name", "joined"}});
    fixture.append("nodes", {{"mesh", 0}});
    const Mesh mesh = fixture.load().meshes.at(0);
    CHECK(mesh.name == "joined");
    CHECK(mesh.positions.size() == 7);
    CHECK(mesh.positions[4] == glm::vec3(0, 0, 5));
    CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {4, 5, 6}, {1, 3, 2}});
}

TEST_CASE("gltf_mesh: an index out of range or a restart value is refused by name") {
    CHECK(zigzag(4, {0, 1, 2, 3, 6, 4}).fault() == "meshes[0].primitives[0].indices[4]");
    CHECK(zigzag(4, {0, 1, 0xffffffff}).fault() == "meshes[0].primitives[0].indices");
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9;
    CHECK(fixture.fault() == "meshes[0].primitives[0].attributes.POSITION");
    fixture = test::triangle_fixture();
    fixture.root["meshes"][0]["primitives"][0]["indices"] = 9;
    CHECK(fixture.fault() == "meshes[0].primitives[0].indices");
}

TEST_CASE("gltf_mesh: vertices that are not finite or out of range take their triangles with them, counted") {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, 2.0f * largest_coordinate}) {
        CAPTURE(bad);
        GltfFixture fixture;
        // Four corners and a bad vertex in their midst: of four triangles, two use it.
        const std::size_t positions = fixture.positions({0, 0, 0, 1, 0, 0, 0, bad, 0, 0, 1, 0, 1, 1, 0});
        const std::size_t indices = fixture.indices({0, 1, 3, 0, 1, 2, 2, 3, 4, 1, 4, 3});
        fixture.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        const Scene scene = fixture.load();
        CHECK(scene.counts.dropped_triangles == 2);
        CHECK(scene.meshes.at(0).positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
        CHECK(scene.meshes[0].triangles == std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}});
        CHECK(scene.warnings.at(0).starts_with("meshes[0].primitives[0].attributes.POSITION[2]"));

        fixture.root["accessors"][indices]["byteOffset"] = 12; // the triangles that use it, and no other
        fixture.root["accessors"][indices]["count"] = 6;
        CHECK(fixture.fault() == "meshes[0].primitives[0].attributes.POSITION[2]");
    }
}

TEST_CASE("gltf_mesh: triangles without area are kept") {
    GltfFixture fixture;
    fixture.show(
        {{"attributes", {{"POSITION", fixture.positions({1, 1, 1, 1, 1, 1, 2, 2, 2, 0, 0, 0, 1, 0, 0, 2, 0, 0})}}}});
    CHECK(fixture.load().triangle_count() == 2);
}

TEST_SUITE_END();
