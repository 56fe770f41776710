// SPDX-License-Identifier: MIT
// Files of a few bytes that ask for much, and scenes that show nothing.
#include "io/gltf_size.hpp"

#include <doctest/doctest.h>

#include "io/gltf_accessor.hpp"
#include "io/gltf_fixture.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

std::size_t implicit_accessor(GltfFixture& fixture, std::size_t count, int component = 5126,
                              const char* type = "VEC3") {
    return fixture.append("accessors", {{"componentType", component}, {"count", count}, {"type", type}});
}

/// What check_size says of the whole file on a machine of `memory` bytes.
std::string size_fault(const GltfFixture& fixture, std::uint64_t memory) {
    Warnings warnings;
    const std::vector<std::byte> bytes = fixture.bytes();
    const GltfDocument document = open_gltf(bytes, "test.glb", {}, warnings);
    try {
        check_size(document, place_nodes(document, warnings), std::vector<bool>(document.model.meshes.size(), true),
                   memory);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("gltf_size: indices without data are zeros, or their sparse values") {
    GltfFixture fixture = test::triangle_fixture();
    const std::size_t zeros = implicit_accessor(fixture, 3, 5125, "SCALAR");
    fixture.root["meshes"][0]["primitives"][0]["indices"] = zeros;
    CHECK(fixture.load().meshes.at(0).triangles == std::vector<glm::uvec3>{{0, 0, 0}});
    fixture.root["accessors"][zeros]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", fixture.view(std::vector<std::uint8_t>{0, 2})}, {"componentType", 5121}}},
        {"values", {{"bufferView", fixture.view(std::vector<std::uint32_t>{2, 1})}}}};
    const Scene scene = fixture.load();
    CHECK(scene.meshes.at(0).triangles == std::vector<glm::uvec3>{{2, 0, 1}});
    CHECK(scene.warnings.empty());
}

TEST_CASE("gltf_size: elements without data are bounded in all, before any is made") {
    GltfFixture fixture;
    fixture.append("nodes", {{"mesh", 0}});
    json primitives = json::array();
    for (std::size_t i = 0; i < 2000; ++i) // 25 GB of zeros
        primitives.push_back({{"attributes", {{"POSITION", implicit_accessor(fixture, largest_implicit_count)}}}});
    fixture.append("meshes", {{"primitives", primitives}});
    CHECK(fixture.fault() == "accessors");
    // Primitives of one accessor share their vertices.
    for (std::size_t i = 0; i < 2000; ++i) primitives[i]["attributes"]["POSITION"] = 0;
    fixture.root["meshes"][0]["primitives"] = primitives;
    CHECK(size_fault(fixture, std::uint64_t{1} << 40) == "no error");
    // Every kind of use counts.
    for (const char* attribute : {"NORMAL", "COLOR_0"}) {
        GltfFixture other = fixture;
        for (std::size_t i = 0; i < 16; ++i) other.root["meshes"][0]["primitives"][i]["attributes"][attribute] = i + 1;
        CHECK(other.fault() == "accessors");
    }
    GltfFixture indexed = fixture;
    const std::size_t indices = implicit_accessor(indexed, largest_implicit_count, 5125, "SCALAR");
    for (std::size_t i = 0; i < 16; ++i) indexed.root["meshes"][0]["primitives"][i]["indices"] = indices;
    CHECK(indexed.fault() == "accessors");
    GltfFixture placed = test::triangle_fixture();
    const std::size_t places = implicit_accessor(placed, largest_implicit_count);
    for (std::size_t i = 0; i < 17; ++i)
        placed.append(
            "nodes",
            {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    CHECK(placed.fault() == "accessors");
    // What no node shows is not made.
    fixture.root["nodes"] = json::array({json::object()});
    CHECK(fixture.load().meshes.empty());
}

TEST_CASE("gltf_size: parts of a file that are read many times over are bounded by the memory of the machine") {
    CHECK(host_memory() > 0);
    GltfFixture fixture = test::triangle_fixture();
    for (std::size_t i = 1; i < 1000; ++i)
        fixture.root["meshes"][0]["primitives"].push_back(fixture.root["meshes"][0]["primitives"][0]);
    // 36 bytes of vertices, which are shared, 12 for each triangle, and an instance.
    const std::uint64_t needed = 36 + 12 * 1000 + sizeof(Instance);
    CHECK(size_fault(fixture, needed) == "no error");
    CHECK(size_fault(fixture, needed - 1).find("asks for " + std::to_string(needed) + " bytes") != std::string::npos);

    GltfFixture placed = test::triangle_fixture();
    const std::size_t places = placed.accessor(placed.view(std::vector<float>(3 * 100)), 5126, 100, "VEC3");
    for (std::size_t i = 0; i < 10; ++i)
        placed.append("nodes",
                      {{"mesh", 0},
                       {"name", std::string(500, 'n')},
                       {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    CHECK(size_fault(placed, 1000 * (sizeof(Instance) + 500)) != "no error");
    CHECK(size_fault(placed, 1001 * (sizeof(Instance) + 500)) == "no error");

    GltfFixture pictures = test::triangle_fixture();
    for (std::size_t i = 0; i < 100; ++i)
        pictures.append("images",
                        {{"bufferView", pictures.append("bufferViews", {{"buffer", 0}, {"byteLength", 48}})}});
    CHECK(size_fault(pictures, 4800) != "no error");
    CHECK(size_fault(pictures, 4800 + 1000) == "no error");
}

TEST_CASE("gltf_size: what shows nothing is named") {
    const auto warnings = [](auto change) {
        GltfFixture fixture = test::triangle_fixture();
        change(fixture);
        return fixture.load().warnings;
    };
    using Lines = std::vector<std::string>;
    CHECK(warnings([](GltfFixture& f) {
              for (int i = 0; i < 3; ++i) f.root["meshes"].push_back(f.root["meshes"][0]);
          }) == Lines{"meshes[1]: is shown by no node of the scene, left out (and 2 more like it)"});
    CHECK(warnings([](GltfFixture& f) { f.root["meshes"][0].erase("primitives"); }) ==
          Lines{"meshes[0]: has no primitives"});
    CHECK(warnings([](GltfFixture& f) { f.root["accessors"][1]["count"] = 0; }) ==
          Lines{"meshes[0].primitives[0]: makes no triangle"});
    CHECK(warnings([](GltfFixture& f) { f.root["accessors"][1]["count"] = 2; }) ==
          Lines{"meshes[0].primitives[0]: makes no triangle"});
    CHECK(warnings([](GltfFixture& f) {
              f.root["accessors"][0]["count"] = 0;
              f.root["meshes"][0]["primitives"][0].erase("indices");
          }) == Lines{"meshes[0].primitives[0]: makes no triangle"});
    CHECK(warnings([](GltfFixture& f) {
              f.root["nodes"][0]["scale"] = {1e-20, 1e-20, 1e-20};
              f.root["nodes"][0]["translation"] = {1, 2, 3};
          })
              .at(0)
              .starts_with("scene: every instance is too small for floats so far from the origin"));
    // Positions that rounding put into one point, and into a line.
    for (const std::vector<float>& corners : {std::vector<float>{1e8f, 1e8f, 1e8f, 1e8f, 1e8f, 1e8f, 1e8f, 1e8f, 1e8f},
                                              std::vector<float>{1e3f, 0, 0, 1e3f, 1, 0, 1e3f, 1, 0}}) {
        GltfFixture fixture;
        fixture.show({{"attributes", {{"POSITION", fixture.positions(corners)}}}});
        CHECK(fixture.load().warnings == Lines{"meshes[0]: no triangle has an area, so that no ray meets it"});
    }
}

TEST_SUITE_END();
