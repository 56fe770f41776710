// SPDX-License-Identifier: MIT
#include "io/gltf_forms.hpp"

#include <cstdint>

#include <doctest/doctest.h>

#include "io/gltf_fixture.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

/// A tetrahedron with all attributes, shown by one node.
GltfFixture tetrahedron() {
    GltfFixture fixture;
    const std::vector<float> directions{0, 0, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const json attributes = {
        {"POSITION", fixture.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25f, 0.25f, 1})},
        {"NORMAL", fixture.positions(directions)},
        {"TANGENT", fixture.accessor(fixture.view(std::vector<float>{0, 1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}),
                                     5126, 4, "VEC4")},
        {"TEXCOORD_0", fixture.accessor(fixture.view(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2")}};
    fixture.show({{"attributes", attributes},
                  {"indices", fixture.indices({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})},
                  {"material", 0}});
    fixture.root["materials"] = {{{"name", "paint"}}};
    return fixture;
}

glm::vec3 normal_of(const Mesh& mesh, std::size_t triangle) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    return glm::cross(b - a, c - a);
}

} // namespace

TEST_CASE("gltf_forms: a mesh flattened by a scale of 0 on one axis is a sheet of its own in world space") {
    GltfFixture fixture = tetrahedron();
    fixture.append("nodes", {{"mesh", 0}, {"name", "sheet"}, {"scale", {2, 3, 0}}, {"translation", {0, 0, 7}}});
    fixture.append("nodes", {{"mesh", 0}, {"name", "mirrored"}, {"scale", {-2, 3, 0}}});
    fixture.append("nodes", {{"mesh", 0}, {"name", "turned"}, {"scale", {0, 2, 1}}, {"rotation", {0, 2, 2, 2}}});
    const Scene scene = fixture.load();
    CHECK(scene.counts.dropped_instances == 0);
    CHECK(scene.warnings.empty());
    REQUIRE(scene.instances.size() == 4);
    REQUIRE(scene.meshes.size() == 4);
    const Mesh& whole = scene.meshes[0];
    CHECK(scene.instances[0].mesh == 0);
    for (std::size_t i = 1; i < 4; ++i) {
        CAPTURE(i);
        CHECK(scene.instances[i].mesh == i);
        CHECK(scene.instances[i].transform == glm::mat4(1.0f));
        const Mesh& sheet = scene.meshes[i];
        CHECK(sheet.uvs[0] == whole.uvs[0]);
        CHECK(sheet.materials == whole.materials);
        CHECK(sheet.triangles == whole.triangles);                          // nothing mirrors where a determinant is 0
        CHECK(sheet.normals == std::vector<glm::vec3>(4, glm::vec3(0.0f))); // the triangles' own stand in
    }
    CHECK(scene.instances[1].name == "sheet");
    CHECK(scene.meshes[1].positions == std::vector<glm::vec3>{{0, 0, 7}, {2, 0, 7}, {0, 3, 7}, {0.5f, 0.75f, 7}});
    CHECK(scene.meshes[1].tangents[2] == glm::vec4(1, 0, 0, 1));
    // Down the axis that is gone one sees the bottom from below and the three sides from above.
    CHECK(normal_of(scene.meshes[1], 0).z < 0.0f);
    for (const std::size_t side : {1, 2, 3}) CHECK(normal_of(scene.meshes[1], side).z > 0.0f);
}

TEST_CASE("gltf_forms: an instance is dropped where less than a plane is left of it, and only there") {
    const auto load = [](const json& node) {
        GltfFixture fixture = tetrahedron(); // of which no axis leaves nothing
        json& only = fixture.root["nodes"][0];
        only.update(node);
        return fixture.load();
    };
    const auto dropped = [&](const json& node) {
        const Scene scene = load(node);
        CHECK(scene.instances.size() + scene.counts.dropped_instances == 1);
        CHECK(scene.warnings.size() == scene.counts.dropped_instances);
        return scene.counts.dropped_instances == 1;
    };
    for (const double size : {1e-15, 1.0, 1e15}) {
        CAPTURE(size);
        for (const double turn : {0.0, 0.3}) {
            const json rotation = {0.2 * turn, turn, 0.5 * turn, 1};
            CHECK(!dropped({{"scale", {size, size, 0}}, {"rotation", rotation}}));
            CHECK(!dropped({{"scale", {size, 0, 1e-3 * size}}, {"rotation", rotation}}));
            CHECK(dropped({{"scale", {0, 0, size}}, {"rotation", rotation}}));
            CHECK(dropped({{"scale", {0, size, 0}}, {"rotation", rotation}}));
        }
    }
    CHECK(dropped({{"scale", {0, 0, 0}}}));
    CHECK(!dropped({{"scale", {1, 1, 1e-39}}}));  // its inverse is out of the range of float
    CHECK(dropped({{"scale", {1e30, 1e30, 0}}})); // out of range itself
    // Two turned scales whose product flattens: rounding leaves something of the determinant, but no space.
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["nodes"][0]["rotation"] = {0.1, 0.2, 0.3, 0.9};
    fixture.append("nodes", {{"children", {0}}, {"scale", {0.1, 0, 0.7}}, {"rotation", {0.5, -0.1, 0.2, 0.7}}});
    const Scene scene = fixture.load();
    CHECK(scene.counts.dropped_instances == 0);
    CHECK(scene.instances.at(0).transform == glm::mat4(1.0f));
}

TEST_CASE("gltf_forms: instances of EXT_mesh_gpu_instancing that are flattened are sheets, too") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"SCALE", fixture.positions({1, 1, 1, 1, 1, 0, 0, 0, 1, 2, 2, 2})}};
    const Scene scene = fixture.load();
    CHECK(scene.meshes.size() == 2);
    CHECK(scene.instances.size() == 3);
    CHECK(scene.counts.dropped_instances == 1);
}

TEST_CASE("gltf_forms: a mesh that is only shown in a form of its own is not there besides") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["nodes"][0]["scale"] = {1, 0, 1};
    CHECK(fixture.load().meshes.size() == 1);
}

TEST_CASE("gltf_forms: points are counted and warned about once, however many forms their mesh has") {
    GltfFixture fixture = tetrahedron();
    fixture.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    for (int i = 0; i < 3; ++i) fixture.append("nodes", {{"mesh", 0}, {"scale", {1, 1, 0}}});
    const Scene scene = fixture.load();
    CHECK(scene.meshes.size() == 4);
    CHECK(scene.counts.skipped_points_and_lines == 1);
    CHECK(scene.warnings.size() == 1);
}

TEST_CASE("gltf_forms: more copies of a mesh than a file of its size may ask for are refused before any is made") {
    constexpr std::size_t vertices = 30'000, nodes = 12'000; // 12 bytes each: 4.3 GB
    GltfFixture fixture;
    fixture.show({{"attributes", {{"POSITION", fixture.positions(std::vector<float>(3 * vertices, 1.0f))}}}},
                 {{"scale", {1, 1, 0}}});
    CHECK(fixture.fault() == "no error");
    for (std::size_t i = 1; i < nodes; ++i) fixture.append("nodes", {{"mesh", 0}, {"scale", {1, 1, 0}}});
    CHECK(fixture.fault().starts_with("nodes[11"));
    // What poses read counts, too: here one joint and its many names.
    GltfFixture skinned;
    skinned.show({{"attributes", {{"POSITION", skinned.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}, {{"skin", 0}});
    skinned.root["skins"] = {{{"joints", std::vector<int>(20'000, 0)}}};
    CHECK(skinned.fault() == "no error");
    for (std::size_t i = 1; i < 2'000; ++i) skinned.append("nodes", {{"mesh", 0}, {"skin", 0}});
    CHECK(skinned.fault().starts_with("nodes[16"));
}

TEST_SUITE_END();
