// SPDX-License-Identifier: MIT
// boxwood analyze.
#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/tool.hpp"

using namespace boxwood::test;
using Json = nlohmann::json;

TEST_SUITE_BEGIN("cli");

namespace {

/// Looks along -z at everything within 4 of the axis, and more than procedural scenes need behind.
constexpr const char* one_area =
    R"([{"kind": "plane", "point": [0, 0, 50], "direction": [0, 0, -1], "half_width": 4, "half_height": 4,)"
    R"( "length": 100}])";

/// A plane and a point area, whose rays begin within the unit cube of a random scene, and between them one beside
/// everything.
constexpr const char* three_areas = R"([
 {"kind": "plane", "point": [0.5, 0.5, 50], "direction": [0, 0, -1], "half_width": 0.3, "half_height": 0.3,
  "length": 100, "share": 0.5},
 {"kind": "plane", "point": [900, 0, 50], "direction": [0, 0, -1], "half_width": 1, "half_height": 1, "length": 100},
 {"kind": "point", "eye": [0.5, 0.5, 2], "direction": [0, 0, -1], "fov_x_degrees": 30, "fov_y_degrees": 20,
  "near": 1.25, "far": 100}])";

/// Of the last table: rows of how many triangles a leaf has, and how many leaves do.
int triangles_of_leaves(const std::string& out) {
    std::istringstream rows(out.substr(out.find("leaves\n", out.find("Sizes of leaves") + 16)));
    std::string head;
    std::getline(rows, head);
    int sum = 0;
    for (int size = 0, leaves = 0; rows >> size >> leaves;) sum += size * leaves;
    return sum;
}

Json analyze(const Tool& tool, const std::string& arguments) {
    tool.succeed("analyze " + arguments + " --quiet --report a.json");
    return Json::parse(tool.contents("a.json"));
}

} // namespace

TEST_CASE("analyze: a scene and its .bxw file have the same figures, which add up over levels and nodes") {
    const Tool tool;
    tool.write("areas.json", one_area);
    tool.succeed("scene random --triangles 300 -o random.glb");
    for (const std::string options : {"--layout binary", "--layout wide8", "--bounds obb-points"}) {
        CAPTURE(options);
        tool.succeed("build random.glb -o random.bxw " + options);
        const Json report = analyze(tool, "random.glb " + options + " --rays-of areas.json --nodes nodes.json");
        const Json stored = analyze(tool, "random.bxw --rays-of areas.json");
        CHECK(report["analysis"] == stored["analysis"]);
        REQUIRE(report["analysis"]["trees"].size() == 1);
        const Json& tree = report["analysis"]["trees"][0];
        CHECK(tree["primitives"] == 300);
        CHECK(tree["levels"].size() == tree["depth"].get<std::size_t>() + 1);
        for (const std::string key : {"sah", "pah", "pah_culled"}) {
            CAPTURE(key);
            double sum = 0.0;
            for (const Json& level : tree["levels"]) sum += level[key].get<double>();
            CHECK(sum == doctest::Approx(tree[key].get<double>()));
            CHECK(sum > 0.0);
        }
        CHECK(tree["pah_culled"] <= tree["pah"]);
        for (const std::string level : {"4", "7", "10", "15", "all"}) {
            CHECK(tree["overlap_to_level"][level]["culled"] > 0.0);
            CHECK(tree["overlap_to_level"][level]["all"] < 1.0);
        }
        // Per node: the cost once more, from its nodes.
        const Json nodes = Json::parse(tool.contents("nodes.json"))["trees"][0]["nodes"];
        CHECK(nodes.size() == tree["nodes"]);
        double sah = 0.0, pah = 0.0;
        for (const Json& node : nodes) {
            const double cost =
                node["children"] == 0 ? 1.2 * node["primitives"].get<double>() : node["children"].get<double>();
            sah += cost * node["surface"].get<double>();
            pah += cost * node["probability_culled"].get<double>();
        }
        CHECK(sah == doctest::Approx(tree["sah"].get<double>()));
        CHECK(pah == doctest::Approx(tree["pah_culled"].get<double>()));
        CHECK(nodes[0]["parent"].is_null());
    }
}

TEST_CASE("analyze: a tree is judged by the areas that it was built with, also once it is stored") {
    const Tool tool;
    tool.write("areas.json", three_areas);
    tool.succeed("scene random --triangles 300 -o random.glb");
    for (const std::string layout : {"binary", "wide8"}) {
        CAPTURE(layout);
        const std::string options = " --builder pah --layout " + layout + " --areas areas.json";
        const Json report = analyze(tool, "random.glb --nodes nodes.json" + options);
        const Json& built = report["analysis"]["trees"];
        // The second area holds nothing.
        CHECK(report["analysis"]["areas"] == 2);
        CHECK(report["areas"]["kept"] == 2);
        REQUIRE(built.size() == 3);
        CHECK(built[0]["name"] == "tree");
        CHECK(built[0]["primitives"] == 300);
        CHECK(built[1]["name"] == "local tree 0");
        CHECK(built[1]["primitives"] == report["areas"]["triangles"][0]);
        CHECK(built[2]["primitives"] == report["areas"]["triangles"][2]);
        const Json nodes = Json::parse(tool.contents("nodes.json"))["trees"];
        REQUIRE(nodes.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            CAPTURE(i);
            CHECK(built[i]["pah_culled"] > 0.0);
            CHECK(built[i]["overlap_to_level"].size() == 5);
            CHECK(nodes[i]["nodes"].size() == built[i]["nodes"]);
            double pah = 0.0;
            for (const Json& node : nodes[i]["nodes"])
                pah +=
                    node["probability_culled"].get<double>() *
                    (node["children"] == 0 ? 1.2 * node["primitives"].get<double>() : node["children"].get<double>());
            CHECK(pah == doctest::Approx(built[i]["pah_culled"].get<double>()));
        }
        tool.succeed("build random.glb -o random.bxw" + options);
        CHECK(analyze(tool, "random.bxw")["analysis"] == report["analysis"]);
        // Rays of others judge the first tree, and the local ones stay with their own.
        tool.write("other.json", one_area);
        const Json other = analyze(tool, "random.bxw --rays-of other.json")["analysis"]["trees"];
        CHECK(other[0]["pah_culled"] != built[0]["pah_culled"]);
        CHECK(other[1] == built[1]);
        CHECK(other[2] == built[2]);
        // Leaves are those of the first tree, whose triangles local trees have again.
        const std::string out = tool.succeed("analyze random.bxw").out;
        CHECK(out.find("local tree 1") != std::string::npos);
        CHECK(triangles_of_leaves(out) == 300);
    }
    // One tree for all rays is judged by the areas as they were given, and stores none.
    const Json blend = analyze(tool, "random.glb --builder blend --areas areas.json")["analysis"];
    CHECK(blend["areas"] == 3);
    CHECK(blend["trees"].size() == 1);
    CHECK(blend["trees"][0]["pah_culled"] > 0.0);
}

TEST_CASE("analyze: two levels, tables, an empty scene, and wrong usage") {
    const Tool tool;
    tool.write("areas.json", one_area);
    tool.succeed("scene forest --instances 20 -o forest.glb");
    const Run run = tool.succeed("analyze forest.glb --levels two --rays-of areas.json --report a.json");
    CHECK(run.out.find("top level") != std::string::npos);
    CHECK(run.err.empty());
    const Json trees = Json::parse(tool.contents("a.json"))["analysis"]["trees"];
    CHECK(trees.size() > 1);
    CHECK(trees[0]["primitives"] == 20);
    CHECK(trees[0].contains("pah"));
    CHECK_FALSE(trees[1].contains("pah")); // in object space, where the area is not
    tool.write("empty.gltf", R"({"asset":{"version":"2.0"},"scenes":[{}],"scene":0})");
    CHECK(analyze(tool, "empty.gltf --rays-of areas.json")["analysis"]["trees"].empty());
    tool.succeed("analyze empty.gltf");
    CHECK(tool.run("analyze missing.glb").code == 3);
    CHECK(tool.run("analyze empty.gltf --rays-of missing.json").code == 3);
    CHECK(tool.run("analyze empty.gltf --nodes nowhere/n.json").code == 1);
    CHECK(tool.run("analyze").code == 2);
    CHECK(tool.run("analyze empty.gltf --nodes n.json --report n.json").code == 2);
}

TEST_SUITE_END();
