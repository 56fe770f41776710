// SPDX-License-Identifier: MIT
// What scripts rely on: report keys, and equal results from a scene and from its .bxw file.
#include <doctest/doctest.h>

#include <algorithm>

#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "cli/tool.hpp"

using namespace boxwood::test;
using Json = nlohmann::json;

TEST_SUITE_BEGIN("cli");

namespace {

using Names = std::vector<std::string>;

Json report(const Tool& tool, const std::string& name) { return Json::parse(tool.contents(name)); }

void check_keys(const Json& object, const Names& keys) {
    for (const std::string& key : keys) {
        CAPTURE(key);
        CHECK(object.contains(key));
    }
}

void check_base(const Json& json) {
    check_keys(json, {"boxwood", "device", "scene", "options", "requirements", "passes_ms", "compile_ms",
                      "peak_device_bytes", "quality"});
    check_keys(json["device"],
               {"platform", "name", "driver", "language", "denormals", "correctly_rounded_divide_sqrt"});
    check_keys(json["scene"], {"meshes", "instances", "triangles", "vertices", "dropped_triangles"});
    CHECK(json["peak_device_bytes"] > 0);
}

} // namespace

namespace {

bool has_word(const Json& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

TEST_CASE("report: the keys of every command") {
    const Tool tool;
    make_forest(tool);
    tool.succeed("build forest.glb -o forest.bxw --report build.json");
    const Json build = report(tool, "build.json");
    check_base(build);
    check_keys(build["passes_ms"],
               {"bounds", "morton", "sort", "hierarchy", "volumes", "collapse", "top_level", "total"});
    check_keys(build["quality"],
               {"sah", "sum_volume", "sum_area", "obb_smaller_fraction", "max_depth", "nodes", "bottom", "top"});
    CHECK(build["requirements"] == Json{"two-levels"});
    CHECK(build["options"] == Json{{"levels", "auto"},
                                   {"layout", "wide8"},
                                   {"bounds", "aabb"},
                                   {"extents", "exact"},
                                   {"measure", "volume"},
                                   {"builder", "lbvh"},
                                   {"morton", 30}});
    CHECK(build["quality"]["sah"] > 0.0);

    for (const std::string file : {"forest.glb", "forest.bxw"}) {
        CAPTURE(file);
        tool.succeed("trace " + file + " --resolution 32x16 --report trace.json");
        const Json trace = report(tool, "trace.json");
        check_base(trace);
        check_keys(trace["trace"], {"rays", "hits", "mrays_per_s", "nodes_per_ray", "primitives_per_ray"});
        CHECK(trace["trace"]["rays"] == 512);
        CHECK(trace["trace"]["hits"] > 0);
        CHECK(trace["trace"]["nodes_per_ray"] > 0.0);
        CHECK(trace["requirements"] == Json{"two-levels", "statistics"});

        tool.succeed("render " + file + " -o x.exr --resolution 32x16 --spp 2 --aov cost,depth --report render.json");
        const Json render = report(tool, "render.json");
        check_base(render);
        CHECK(render["options"]["aovs"] == Json{"depth", "cost"});
        CHECK(has_word(render["requirements"], "two-levels"));
        CHECK(has_word(render["requirements"], "statistics"));
        CHECK(has_word(render["requirements"], "materials"));
        CHECK_FALSE(has_word(render["requirements"], "textures"));
        check_keys(render["render"], {"image", "preview", "ms", "samples", "resumed_samples", "samples_per_s",
                                      "rejected_samples", "interrupted", "stages_ms", "trace_share"});
        CHECK(render["render"]["samples"] == 2);
        CHECK(render["render"]["rejected_samples"] == 0);
        CHECK(render["render"]["trace_share"] > 0.0);
    }
    tool.succeed("render forest.glb -o x.exr --resolution 32x16 --spp 1 --levels one --report render.json");
    CHECK(has_word(report(tool, "render.json")["requirements"], "instance-lookup"));
    CHECK_FALSE(has_word(report(tool, "render.json")["requirements"], "statistics"));

    tool.succeed(
        "build forest.glb -o forest.bxw --bounds obb-moments --extents corners --measure area --report b.json");
    CHECK(report(tool, "b.json")["options"] == Json{{"levels", "auto"},
                                                    {"layout", "binary"},
                                                    {"bounds", "obb-moments"},
                                                    {"extents", "corners"},
                                                    {"measure", "area"},
                                                    {"builder", "lbvh"},
                                                    {"morton", 30}});
    CHECK(report(tool, "b.json")["requirements"] == Json{"two-levels", "oriented-boxes"});
    tool.succeed("trace forest.bxw --resolution 32x16 --report trace.json");
    const Json stored = report(tool, "trace.json");
    CHECK(stored["options"]["bounds"] == "obb-moments");
    CHECK(stored["requirements"] == Json{"two-levels", "oriented-boxes", "statistics"});
    CHECK(stored["quality"]["nodes"] == report(tool, "b.json")["quality"]["nodes"]);
}

TEST_CASE("report: info as JSON, for a scene and its .bxw file") {
    const Tool tool;
    make_forest(tool);
    tool.succeed("build forest.glb -o forest.bxw --layout binary");
    Json scene = Json::parse(tool.succeed("info forest.glb --json").out);
    Json file = Json::parse(tool.succeed("info forest.bxw --json").out);
    CHECK_FALSE(scene.contains("tree"));
    CHECK(file["tree"]["layout"] == "binary");
    CHECK(file["tree"]["levels"] == "two");
    CHECK(file["tree"]["bounds"] == "aabb");
    scene["scene"].erase("file");
    file["scene"].erase("file");
    CHECK(scene["scene"] == file["scene"]);
    CHECK(scene["cameras"] == file["cameras"]);
    CHECK(scene["requirements"] == file["requirements"]);
    CHECK(scene["requirements"][0]["word"] == "two-levels");
    CHECK(scene["requirements"][1]["word"] == "transforms");
    CHECK(scene["requirements"][2]["because"] == "materials[0] \"soil\" and materials[1] \"bark\" are in use");

    tool.succeed("scene materials --triangles 100 -o m.glb");
    const Json materials = Json::parse(tool.succeed("info m.glb --json").out);
    CHECK(materials["scene"]["materials"] == 14);
    CHECK(materials["scene"]["lights"] == 1);
    CHECK(materials["emitting_triangles"] == 2);
    CHECK(materials["images"] == Json::parse(R"([{"name": "chequer", "width": 64, "height": 64}])"));
    const std::string text = tool.succeed("info m.glb").out;
    for (const char* line :
         {"\"chequer\", 64 x 64", "1 punctual, 2 emitting", "emission: materials[13] \"lamp\" emits light"})
        CHECK(text.find(line) != std::string::npos);
}

TEST_CASE("report: a scene and its .bxw file give the same hits and the same picture") {
    const Tool tool;
    make_forest(tool);
    // Each kind of tree with one kind of rays.
    const std::pair<std::string, std::string> kinds[] = {{"--layout wide8 --levels two", "primary"},
                                                         {"--layout binary --levels one", "diffuse"},
                                                         {"--layout wide8 --levels one --morton 63", "shadow"},
                                                         {"--bounds obb-points", "near"}};
    for (const auto& kind : kinds) {
        const std::string &options = kind.first, &rays = kind.second;
        CAPTURE(options);
        tool.succeed("build forest.glb -o forest.bxw " + options);
        const std::string trace = " --resolution 64x64 --seed 5 --rays " + rays;
        tool.succeed("trace forest.glb --report a.json " + options + trace);
        tool.succeed("trace forest.bxw --report b.json" + trace);
        const Json from_scene = report(tool, "a.json")["trace"], from_file = report(tool, "b.json")["trace"];
        for (const std::string key : {"checksum", "rays", "hits", "nodes_per_ray", "primitives_per_ray"})
            CHECK(from_scene[key] == from_file[key]);
        CHECK(from_scene["hits"] > 0);
        if (rays == "primary") CHECK(from_scene["rays"] == 4096);
        tool.succeed("render forest.glb -o a.exr --spp 1 --aov depth,cost --resolution 64x64 " + options);
        tool.succeed("render forest.bxw -o b.exr --spp 1 --aov depth,cost --resolution 64x64");
        CHECK(tool.contents("a.exr") == tool.contents("b.exr"));
        CHECK(tool.contents("a.png") == tool.contents("b.png"));
        CHECK(tool.contents("a.exr").starts_with("\x76\x2f\x31\x01"));
        CHECK(tool.contents("a.png").starts_with("\x89PNG"));
    }
}

TEST_CASE("report: near rays leave the scene's triangles wherever the camera looks") {
    const Tool tool;
    make_forest(tool);
    const std::string trace = "trace forest.glb --resolution 40x30 --rays near --report ";
    tool.succeed(trace + "a.json");
    tool.succeed(trace + "b.json --eye 1000,1000,1000 --target 2000,1000,1000");
    tool.succeed(trace + "c.json --seed 2");
    const Json a = report(tool, "a.json"), b = report(tool, "b.json"), c = report(tool, "c.json");
    CHECK(a["trace"]["rays"] == 1200);
    CHECK(a["trace"]["checksum"] == b["trace"]["checksum"]);
    CHECK(a["trace"]["nodes_per_ray"] == b["trace"]["nodes_per_ray"]);
    CHECK(a["trace"]["checksum"] != c["trace"]["checksum"]);
    CHECK(c["options"]["seed"] == 2);
}

TEST_CASE("report: an empty scene builds, traces and renders") {
    const Tool tool;
    tool.write("empty.gltf", R"({"asset":{"version":"2.0"},"scenes":[{}],"scene":0})");
    for (const std::string levels : {"one", "two"}) {
        tool.succeed("build empty.gltf -o empty.bxw --report build.json --levels " + levels);
        CHECK(report(tool, "build.json")["scene"]["triangles"] == 0);
        tool.succeed("trace empty.bxw --rays diffuse --resolution 8x8 --report trace.json");
        CHECK(report(tool, "trace.json")["trace"]["rays"] == 0);
        tool.succeed("render empty.bxw -o empty.exr --resolution 8x8 --spp 2");
        CHECK_FALSE(tool.contents("empty.png").empty());
    }
}
