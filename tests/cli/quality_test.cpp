// SPDX-License-Identifier: MIT
// boxwood quality and boxwood info --boxes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/tool.hpp"

using namespace boxwood::test;
using Json = nlohmann::json;

TEST_SUITE_BEGIN("cli");

namespace {

using Names = std::vector<std::string>;

Json quality(const Tool& tool, const std::string& arguments) {
    tool.succeed("quality " + arguments + " --resolution 32x16 --quiet --report q.json");
    return Json::parse(tool.contents("q.json"));
}

Names keys_of(const Json& object) {
    Names keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

/// The JSON of a binary glTF file.
Json gltf_json(const Tool& tool, const std::string& name) {
    const std::string bytes = tool.contents(name);
    std::uint32_t length = 0;
    REQUIRE(bytes.size() > 20);
    std::memcpy(&length, bytes.data() + 12, 4);
    return Json::parse(bytes.substr(20, length));
}

} // namespace

TEST_CASE("quality: every kind has every figure, in JSON and in the tables") {
    const Tool tool;
    tool.succeed("scene random --triangles 300 -o random.glb");
    const Run run = tool.succeed("quality random.glb --resolution 32x16 --report q.json");
    CHECK(run.err.empty());
    const Json report = Json::parse(tool.contents("q.json"));
    const Names kinds{"aabb",       "obb-boxes",      "obb-cascade", "obb-moments", "obb-moments-corners",
                      "obb-points", "obb-quaternion", "obb-refined"};
    CHECK(keys_of(report["kinds"]) == kinds);
    for (const std::string& kind : kinds) {
        CAPTURE(kind);
        CHECK(run.out.find('\n' + kind) != std::string::npos);
        const Json& json = report["kinds"][kind];
        for (const std::string key :
             {"sum_volume", "sum_area", "volume_ratio", "area_ratio", "sah", "end_point_overlap", "nodes",
              "volumes_per_ray", "primitives_per_ray", "mrays_per_s", "peak_device_bytes"}) {
            CAPTURE(key);
            CHECK(json[key] > 0.0);
        }
        CHECK(json["volume_ratio"] <= 1.0); // a node keeps its AABB where that is smaller
        CHECK(json["obb_smaller_fraction"] <= 1.0);
        CHECK(json["bottom"]["sum_volume"] == json["sum_volume"]);
        CHECK(json["top"]["sum_volume"] == 0.0);
        CHECK(json["primary"]["rays"] == 512);
        CHECK(json["volumes_per_ray"] == json["bounce"]["volumes_per_ray"]);
        CHECK(json["near"]["rays"] == 512); // each leaves a triangle
        CHECK(json["near"]["volumes_per_ray"] > 0.0);
        CHECK(json["near"]["primitives_per_ray"] > 0.0);
        for (const std::string pass : {"bounds", "morton", "sort", "hierarchy", "aabb_volumes", "collapse", "total"}) {
            CAPTURE(pass);
            CHECK(json["passes_ms"][pass] > 0.0);
        }
        CHECK((json["passes_ms"]["volumes"] > 0.0) == (kind != "aabb"));
        CHECK((json["fit_ratio"] > 0.0) == (kind != "aabb"));
        CHECK(json["nodes"] == report["kinds"]["aabb"]["nodes"]);
    }
    CHECK(report["kinds"]["aabb"]["volume_ratio"] == 1.0);
    CHECK(report["kinds"]["aabb"]["obb_smaller_fraction"] == 0.0);
    CHECK_FALSE(report.contains("levels"));
    // Fit for a terminal of 120 columns.
    for (std::size_t start = 0; start < run.out.size();) {
        const std::size_t end = run.out.find('\n', start);
        CHECK(end - start <= 120);
        start = end + 1;
    }
}

TEST_CASE("quality: kinds and levels as asked for") {
    const Tool tool;
    tool.succeed("scene forest --instances 20 -o forest.glb");
    const Json some = quality(tool, "forest.glb --bounds obb-moments,obb-boxes --extents corners --measure area");
    CHECK(keys_of(some["kinds"]) == Names{"aabb", "obb-boxes", "obb-moments-corners"});
    CHECK(some["options"]["measure"] == "area");
    CHECK(some["requirements"] == Json{"two-levels", "statistics"});
    // Several meshes, levels by need: both are built and set side by side.
    const Json &one = some["levels"]["one"]["aabb"], &two = some["levels"]["two"]["aabb"];
    CHECK(two["all"]["sum_volume"] == some["kinds"]["aabb"]["sum_volume"]);
    CHECK(two["top"]["sum_volume"] > 0.0);
    CHECK(one["top"]["sum_volume"] == 0.0);
    CHECK(one["all"]["sum_area"] > two["bottom"]["sum_area"]);
    const Json single = quality(tool, "forest.glb --bounds aabb --levels one");
    CHECK(keys_of(single["kinds"]) == Names{"aabb"});
    CHECK_FALSE(single.contains("levels"));
    CHECK(single["kinds"]["aabb"]["sum_volume"] == one["all"]["sum_volume"]);
    // A .bxw file is as good as its scene.
    tool.succeed("build forest.glb -o forest.bxw");
    CHECK(quality(tool, "forest.bxw --bounds aabb --levels one")["kinds"]["aabb"]["sah"] ==
          single["kinds"]["aabb"]["sah"]);
}

TEST_CASE("quality: on slender geometry off the axes oriented boxes halve the volumes that a bounce ray tests") {
    const Tool tool;
    for (const std::string kind : {"hair", "planks"}) { // at their default sizes; counts, so the same on every machine
        CAPTURE(kind);
        tool.succeed("scene " + kind + " -o slender.glb");
        tool.succeed("quality slender.glb --bounds obb-points --resolution 96x96 --quiet --report q.json");
        const Json kinds = Json::parse(tool.contents("q.json"))["kinds"];
        const double aabb = kinds["aabb"]["volumes_per_ray"], oriented = kinds["obb-points"]["volumes_per_ray"];
        CHECK(2.0 * oriented <= aabb);
        CHECK(kinds["obb-points"]["end_point_overlap"] < kinds["aabb"]["end_point_overlap"]);
    }
}

TEST_CASE("quality: an empty scene, and wrong usage") {
    const Tool tool;
    tool.write("empty.gltf", R"({"asset":{"version":"2.0"},"scenes":[{}],"scene":0})");
    const Json empty = quality(tool, "empty.gltf");
    CHECK(empty["kinds"]["obb-points"]["volume_ratio"] == 1.0);
    CHECK(empty["kinds"]["obb-points"]["bounce"]["rays"] == 0);
    CHECK(empty["kinds"]["obb-points"]["near"]["rays"] == 0);
    const Run unknown = tool.run("quality empty.gltf --bounds obb-points,sphere");
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("obb-quaternion") != std::string::npos);
    CHECK(std::count(unknown.err.begin(), unknown.err.end(), '\n') == 1);
    CHECK(tool.run("quality missing.glb").code == 3);
    CHECK(tool.run("quality empty.gltf --report nowhere/q.json").code == 1);
}

TEST_CASE("quality: info: the boxes of a tree as lines, from a scene and from its .bxw file") {
    const Tool tool;
    tool.succeed("scene forest --instances 20 -o forest.glb");
    tool.succeed("build forest.glb -o forest.bxw --layout binary");
    for (const std::string from : {"forest.glb --layout binary", "forest.bxw", "forest.glb --bounds obb-points"}) {
        CAPTURE(from);
        tool.succeed("info " + from + " --boxes boxes.glb --depth 1-2");
        const Json json = gltf_json(tool, "boxes.glb");
        REQUIRE(json["meshes"].size() == 5); // the top level, the ground and three trees
        for (const Json& mesh : json["meshes"]) CHECK(mesh["primitives"][0]["mode"] == 1);
        // Two children of a root and their four; the ground has two triangles only.
        CHECK(json["accessors"][0]["count"] == 8 * 6);
        CHECK(json["accessors"][1]["count"] == 24 * 6);
        CHECK(json["nodes"].size() == 1 + 20 + 1); // and the camera
    }
    CHECK(tool.succeed("info forest.bxw --boxes boxes.glb --depth 3").out.find("depths 3 to 3") != std::string::npos);
    for (const std::string wrong :
         {"--depth 1-2", "--boxes x.glb --depth 3-1", "--boxes x.glb --depth -1", "--boxes x.glb --depth 1-2-3",
          "--boxes x.gltf", "--boxes x.glb --bounds obb-points --layout wide8", "--bounds obb-points"}) {
        CAPTURE(wrong);
        CHECK(tool.run("info forest.glb " + wrong).code == 2);
    }
    CHECK(tool.run("info forest.bxw --boxes x.glb --levels one").code == 2);

    tool.write("areas.json", R"([{"kind": "plane", "point": [0, 9, 0], "direction": [0, -1, 0], "half_width": 5,
                                 "half_height": 5, "length": 9}])");
    tool.succeed("build forest.glb -o areas.bxw --areas areas.json");
    for (const std::string from : {"forest.glb --areas areas.json", "areas.bxw"}) {
        CHECK(tool.succeed("info " + from + " --boxes boxes.glb").out.find(", and 1 area ") != std::string::npos);
        const Json meshes = gltf_json(tool, "boxes.glb")["meshes"];
        CHECK(meshes[meshes.size() - 1]["name"] == "area 0");
    }
    CHECK(tool.run("info forest.bxw --boxes x.glb --areas areas.json").code == 2);
    tool.write("areas.json", "[{}]");
    CHECK(tool.run("info forest.glb --boxes x.glb --areas areas.json").code == 3);
    CHECK(tool.files() == Names{"areas.bxw", "areas.json", "boxes.glb", "forest.bxw", "forest.glb"});
}

TEST_SUITE_END();
