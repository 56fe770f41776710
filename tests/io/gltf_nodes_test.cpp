// SPDX-License-Identifier: MIT
#include "io/gltf_nodes.hpp"

#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "io/gltf_fixture.hpp"
#include "support.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

// Where M = T R S takes a point, by the formula v + 2 q x (q x v + w v) rather than by a matrix.
glm::dvec3 place(const glm::dvec3& t, const glm::dvec4& q, const glm::dvec3& s, const glm::dvec3& point) {
    const glm::dvec3 v = s * point;
    const glm::dvec3 u(q);
    return t + v + 2.0 * glm::cross(u, glm::cross(u, v) + q.w * v);
}

void check_near(const glm::mat4& transform, const glm::dvec3& point, const glm::dvec3& wanted) {
    const glm::dvec3 got = glm::dmat4(transform) * glm::dvec4(point, 1.0);
    CHECK(glm::length(got - wanted) <= 1e-6 * (1.0 + glm::length(wanted)));
}

} // namespace

TEST_CASE("gltf_nodes: a hierarchy of TRS and matrix nodes, with negative and unequal scale") {
    GltfFixture fixture = test::triangle_fixture();
    const glm::dvec4 q(0.36, 0.48, 0.64, 0.48); // a unit quaternion
    fixture.root["nodes"] = {
        {{"children", {1, 2}}, {"translation", {1, 2, 3}}, {"rotation", {q.x, q.y, q.z, q.w}}, {"scale", {2, -3, 0.5}}},
        {{"mesh", 0}, {"name", "left"}, {"matrix", {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}},
        {{"children", {3}}, {"scale", {-1, 1, 1}}},
        {{"mesh", 0}, {"name", "right"}, {"rotation", {0, 0, 2, 2}}}, // not unit: a quarter turn about z
    };
    fixture.root["scenes"] = {{{"nodes", {0}}}};
    const Scene scene = fixture.load();
    REQUIRE(scene.instances.size() == 2);
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.instances[0].name == "left");
    CHECK(scene.instances[1].name == "right");
    for (const glm::dvec3 p : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(3, -4, 5)}) {
        const glm::dvec3 left(-p.y + 7, 2 * p.x + 8, p.z + 9);
        check_near(scene.instances[0].transform, p, place({1, 2, 3}, q, {2, -3, 0.5}, left));
        const glm::dvec3 right(p.y, p.x, p.z); // (-y, x, z) mirrored in x
        check_near(scene.instances[1].transform, p, place({1, 2, 3}, q, {2, -3, 0.5}, right));
    }
}

TEST_CASE("gltf_nodes: which scene: the default one, else the first, else every root") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["nodes"] = {{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}, {{"mesh", 0}, {"name", "c"}}};
    const auto names = [&fixture] {
        std::string joined;
        for (const Instance& instance : fixture.load().instances) joined += instance.name;
        return joined;
    };
    CHECK(names() == "abc");
    fixture.root["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2, 0}}}};
    CHECK(names() == "b");
    fixture.root["scene"] = 1;
    CHECK(names() == "ca");
    fixture.root["scene"] = 2;
    CHECK(fixture.fault() == "scene");
    fixture.root["scene"] = 0;
    fixture.root["scenes"][0]["nodes"] = {3};
    CHECK(fixture.fault() == "scenes[0].nodes[0]");
    fixture.root["scenes"][0]["nodes"] = {1, 1};
    CHECK(names() == "b");
    CHECK(fixture.load().warnings.at(0).starts_with("scenes[0].nodes[1]: names a node that is in the scene already"));
}

TEST_CASE("gltf_nodes: nodes that are no tree are refused") {
    const auto fault = [](const json& nodes, const json& roots) {
        GltfFixture fixture = test::triangle_fixture();
        fixture.root["nodes"] = nodes;
        fixture.root["scenes"] = {{{"nodes", roots}}};
        return fixture.fault();
    };
    const auto parent_of = [](std::vector<int> children) { return json{{"children", children}}; };
    CHECK(fault(json::array({parent_of({0})}), {0}) == "nodes[0]");
    CHECK(fault({parent_of({1}), parent_of({2}), parent_of({0})}, {0}) == "nodes[0]");
    CHECK(fault({parent_of({}), parent_of({2}), parent_of({1})}, {0}) == "nodes[1]"); // a cycle beside the scene
    CHECK(fault({parent_of({2}), parent_of({2}), parent_of({})}, {0, 1}) == "nodes[1].children[0]");
    CHECK(fault({parent_of({1, 1}), parent_of({})}, {0}) == "nodes[0].children[1]");
    CHECK(fault(json::array({parent_of({5})}), {0}) == "nodes[0].children[0]");
    CHECK(fault({{{"mesh", 1}}}, {0}) == "nodes[0].mesh");
    CHECK(fault({{{"camera", 0}}}, {0}) == "nodes[0].camera");
    CHECK(fault({{{"matrix", {1, 2, 3}}}}, {0}) == "nodes[0].matrix");
    CHECK(fault({{{"matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}, {0}) == "nodes[0].matrix");
}

TEST_CASE("gltf_nodes: a chain of a hundred thousand nodes is no deeper than any other") {
    GltfFixture fixture = test::triangle_fixture();
    constexpr int depth = 100'000; // recursion would need tens of megabytes of stack
    fixture.root["nodes"] = json::array();
    for (int i = 0; i + 1 < depth; ++i) fixture.append("nodes", {{"children", {i + 1}}, {"translation", {1, 0, 0}}});
    fixture.append("nodes", {{"mesh", 0}});
    const Scene scene = fixture.load();
    CHECK(scene.instances.at(0).transform[3] == glm::vec4(depth - 1, 0, 0, 1));
}

TEST_CASE("gltf_nodes: instances that cannot be placed are dropped, counted and named") {
    const auto check = [](const json& node) {
        GltfFixture fixture = test::triangle_fixture();
        json whole = node;
        whole["mesh"] = 0;
        fixture.append("nodes", whole);
        const Scene scene = fixture.load();
        CHECK(scene.instances.size() == 1);
        CHECK(scene.counts.dropped_instances == 1);
        CHECK(scene.warnings.at(0).starts_with("nodes[1]"));
    };
    check({{"scale", {0, 0, 1}}});
    check({{"scale", {1e30, 1e30, 1e30}}});
    check({{"scale", {1e39, 1e39, 1e39}}});
    check({{"translation", {1e300, 0, 0}}});
    check({{"rotation", {0, 0, 0, 0}}});
}

TEST_CASE(
    "gltf_nodes: EXT_mesh_gpu_instancing equals the same instances as nodes, with float and quantised rotations") {
    test::Random random(3);
    constexpr std::size_t count = 9;
    std::vector<float> translations;
    std::vector<float> scales;
    std::vector<std::int16_t> rotations;
    json nodes = json::array();
    for (std::size_t i = 0; i < count; ++i) {
        json t = json::array();
        json s = json::array();
        json r = json::array();
        for (int axis = 0; axis < 3; ++axis) {
            t.push_back(translations.emplace_back(random.uniform(-5, 5)));
            s.push_back(scales.emplace_back(random.uniform(0.5f, 2) * (axis == 0 && i % 3 == 0 ? -1.0f : 1.0f)));
        }
        for (int axis = 0; axis < 4; ++axis) {
            const auto value = rotations.emplace_back(static_cast<std::int16_t>(random.below(65535)) - 32767);
            r.push_back(std::fmax(value / 32767.0f, -1.0f));
        }
        nodes.push_back({{"mesh", 0}, {"translation", t}, {"rotation", r}, {"scale", s}});
    }
    const json parent = {{"scale", {1, 2, 3}}, {"translation", {4, 5, 6}}};

    GltfFixture by_nodes = test::triangle_fixture();
    by_nodes.root["nodes"] = nodes;
    by_nodes.root["nodes"].push_back(parent);
    for (std::size_t i = 0; i < count; ++i) by_nodes.root["nodes"][count]["children"].push_back(i);
    const Scene wanted = by_nodes.load();

    GltfFixture by_extension = test::triangle_fixture();
    const std::size_t rotation = by_extension.accessor(by_extension.view(rotations), 5122, count, "VEC4");
    by_extension.root["accessors"][rotation]["normalized"] = true;
    json& node = by_extension.root["nodes"][0];
    node.update(parent);
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", by_extension.positions(translations)},
        {"ROTATION", rotation},
        {"SCALE", by_extension.positions(scales)}};
    by_extension.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene got = by_extension.load();

    REQUIRE(wanted.instances.size() == count);
    REQUIRE(got.instances.size() == count);
    for (std::size_t i = 0; i < count; ++i) CHECK(got.instances[i].transform == wanted.instances[i].transform);

    const std::string where = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes";
    json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    by_extension.root["accessors"][rotation]["count"] = count - 1;
    CHECK(by_extension.fault().starts_with(where + "."));
    attributes["ROTATION"] = 99;
    CHECK(by_extension.fault() == where + ".ROTATION");
    attributes = json::object();
    CHECK(by_extension.fault() == where);
}

TEST_CASE("gltf_nodes: cameras stand where their nodes do") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 1}}}},
                               {{"type", "orthographic"},
                                {"name", "flat"},
                                {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 1}}}}};
    fixture.append("nodes", {{"camera", 0}, {"name", "eye"}, {"translation", {1, 2, 3}}});
    fixture.append("nodes", {{"camera", 1}});
    fixture.append("nodes", {{"camera", 1}, {"scale", {1, 1, 0}}});
    const Scene scene = fixture.load();
    REQUIRE(scene.cameras.size() == 2);
    CHECK(scene.warnings.size() == 1);
    CHECK(scene.cameras[0].name == "eye");
    CHECK(scene.cameras[0].perspective);
    CHECK(scene.cameras[0].vertical_fov == 0.5f);
    CHECK(scene.cameras[0].to_world[3] == glm::vec4(1, 2, 3, 1));
    CHECK(scene.cameras[1].name == "flat");
    CHECK(!scene.cameras[1].perspective);
    CHECK(scene.cameras[1].half_height == 3.0f);

    fixture.root["nodes"].push_back({{"scale", {1, 4, -1}}, {"children", {2}}});
    const double c = std::sqrt(0.5);
    fixture.root["nodes"][2]["rotation"] = {0, 0, std::sin(0.3), std::cos(0.3)};
    const glm::dmat3 frame(fixture.load().cameras.at(1).to_world);
    CHECK(glm::determinant(frame) > c); // sheared and mirrored before, a rotation now
    CHECK(std::abs(glm::dot(frame[0], frame[1])) < 1e-6);
    CHECK(glm::normalize(frame[2]).z == doctest::Approx(-1.0)); // still looks where it did

    fixture.root["cameras"][1].erase("orthographic");
    CHECK(fixture.fault() == "cameras[1].orthographic");
    fixture.root["cameras"][1]["type"] = "fisheye";
    CHECK(fixture.fault() == "cameras[1].type");
}

TEST_SUITE_END();
