// SPDX-License-Identifier: MIT
// What exporters write against the specification, or in a rare way, without any doubt about what is meant.
#include "io/gltf_fields.hpp"

#include <algorithm>

#include <doctest/doctest.h>

#include "io/gltf_fixture.hpp"
#include "io/gltf_warnings.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

using Lines = std::vector<std::string>;

/// The triangle after `change` of its JSON; it must be there once.
template <class Change>
Lines warnings_after(Change change) {
    GltfFixture fixture = test::triangle_fixture();
    change(fixture);
    const Scene scene = fixture.load();
    CHECK(scene.instances.size() == 1);
    CHECK(scene.triangle_count() == 1);
    return scene.warnings;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("gltf_fields: whole numbers may be written with a point or an exponent") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["buffers"] = {
        {{"byteLength", 48}, {"uri", "data:;base64," + std::string(64, 'A')}}}; // 48 bytes of zeros
    const std::string text = fixture.root.dump();
    for (const char* count : {"3", "3.0", "3e0", "30e-1", "0.3E1"}) {
        CAPTURE(count);
        const std::string changed = replaced(replaced(text, "\"count\":3", std::string("\"count\":") + count),
                                             "\"byteOffset\":0", "\"byteOffset\":0.0");
        const Scene scene = load_gltf_memory(std::as_bytes(std::span(changed)), "text", {});
        CHECK(scene.triangle_count() == 1);
    }
    for (const char* count : {"3.5", "1e300", "-3.0", "\"3\""}) {
        CAPTURE(count);
        const std::string changed = replaced(text, "\"count\":3", std::string("\"count\":") + count);
        CHECK_THROWS_WITH_AS(load_gltf_memory(std::as_bytes(std::span(changed)), "text", {}),
                             doctest::Contains("accessors[0].count"), InputError);
    }
}

TEST_CASE("gltf_fields: a negative zero stays one") {
    const Lines lines = warnings_after([](GltfFixture& f) { f.root["nodes"][0]["translation"] = {-0.0, 0, 0}; });
    CHECK(lines.empty());
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["nodes"][0]["translation"] = {-0.0, 1.0, -2.0};
    const glm::vec4 place = fixture.load().instances.at(0).transform[3];
    CHECK(std::signbit(place.x));
    CHECK(place == glm::vec4(0, 1, -2, 1));
}

TEST_CASE("gltf_fields: references of -1 count as absent, with a warning") {
    const auto check = [](const char* pointer, const std::string& where) {
        CAPTURE(pointer);
        const Lines lines = warnings_after([&](GltfFixture& f) { f.root[json::json_pointer(pointer)] = -1; });
        REQUIRE(lines.size() == 1);
        CHECK(lines[0].starts_with(where + ": is -1, which is no index"));
    };
    check("/meshes/0/primitives/0/material", "meshes[0].primitives[0].material");
    check("/meshes/0/primitives/0/indices", "meshes[0].primitives[0].indices");
    check("/nodes/0/camera", "nodes[0].camera");
    check("/nodes/0/skin", "nodes[0].skin");
    check("/scene", "scene");

    Lines lines =
        warnings_after([](GltfFixture& f) { f.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = -1; });
    CHECK(lines == Lines{"meshes[0].primitives[0].attributes: holds -1, which is no index; left out"});
    lines = warnings_after([](GltfFixture& f) { f.root["nodes"][0]["children"] = {-1}; });
    CHECK(lines == Lines{"nodes[0].children: holds -1, which is no index; left out"});

    // What is needed is missed as if it were not there.
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["bufferViews"][0]["buffer"] = -1;
    CHECK(fixture.fault() == "bufferViews[0].buffer");
    fixture = test::triangle_fixture();
    fixture.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -1;
    CHECK(fixture.load().warnings.at(1) == "meshes[0].primitives[0]: has no positions, skipped");
}

TEST_CASE("gltf_fields: null and empty members count as absent, with a warning for each kind") {
    const Lines lines = warnings_after([](GltfFixture& f) {
        f.root["nodes"][0]["name"] = nullptr;
        f.root["meshes"][0]["name"] = nullptr;
        f.root["nodes"][0]["extensions"] = json::object();
        f.root["nodes"][0]["children"] = json::array();
        f.root["nodes"][0]["extras"] = nullptr;
        f.root["cameras"] = json::array();
        f.root["extensionsRequired"] = json::array();
    });
    CHECK(lines == Lines{"cameras: is empty; taken as absent (and 3 more like it)",
                         "meshes[0].name: is null; taken as absent (and 1 more like it)"});
    // Not empty in the file, though nothing in it is read.
    CHECK(warnings_after([](GltfFixture& f) { f.root["nodes"][0]["extensions"] = {{"ACME_new", 7}}; }).empty());
}

TEST_CASE("gltf_fields: a byteStride that glTF forbids is followed where elements fit in it, with a warning") {
    const auto stride = [](std::size_t view, std::size_t value) {
        return warnings_after([=](GltfFixture& f) { f.root["bufferViews"][view]["byteStride"] = value; });
    };
    CHECK(stride(0, 0) == Lines{"bufferViews[0].byteStride: is 0, which glTF forbids; taken as absent"});
    CHECK(stride(1, 4) == Lines{"meshes[0].primitives[0].indices: are in a buffer view with a byteStride, which glTF "
                                "forbids; followed as it is"});
    GltfFixture fixture = test::triangle_fixture();
    std::vector<std::byte> bytes(2 * 13 + 12);
    const float one = 1.0f;
    std::memcpy(&bytes[13], &one, 4);
    std::memcpy(&bytes[26 + 4], &one, 4);
    fixture.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        fixture.accessor(fixture.view(bytes, 13), 5126, 3, "VEC3");
    const Scene scene = fixture.load();
    CHECK(scene.meshes.at(0).positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(scene.warnings.size() == 1);
    fixture.root["bufferViews"].back()["byteStride"] = 11; // elements would overlap
    CHECK(fixture.fault() == "bufferViews[2]");
    fixture.root["bufferViews"].back()["byteStride"] = std::uint64_t{1} << 53;
    CHECK(fixture.fault() == "accessors[2]");
}

TEST_CASE("gltf_fields: an alpha mode that glTF does not know is opaque, with a warning") {
    const Lines lines = warnings_after([](GltfFixture& f) {
        f.root["materials"] = {{{"name", "paint"}, {"alphaMode", "DITHER"}}};
    });
    CHECK(lines == Lines{"materials[0].alphaMode: is not a mode that glTF knows; taken as OPAQUE"});
}

TEST_CASE("gltf_fields: warnings: faults that repeat are one line, and no more than a hundred lines are kept") {
    Warnings warnings;
    for (int i = 0; i < 1000; ++i) warnings.add_repeated(element("nodes", static_cast<std::size_t>(i)), "is odd");
    for (int i = 0; i < 150; ++i) warnings.add("scene", std::to_string(i));
    warnings.add_repeated("nodes[0]", "is even"); // beyond the hundred
    warnings.add_repeated("nodes[2]", "is even");
    const Lines lines = warnings.take();
    REQUIRE(lines.size() == 101);
    CHECK(lines[0] == "nodes[0]: is odd (and 999 more like it)");
    CHECK(lines[99] == "scene: 98");
    CHECK(lines[100] == "and 52 more warnings");
}

TEST_SUITE_END();
