// SPDX-License-Identifier: MIT
// Levels at the command line, where one of them would round a placement.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "cli/tool.hpp"

using namespace boxwood;
using namespace boxwood::test;
using Json = nlohmann::json;

TEST_SUITE_BEGIN("cli");

namespace {

/// A sphere of radius 1 at earth-centred coordinates, by a name of two lines.
void make_far(const Tool& tool) {
    Scene scene = make_procedural("sphere", {.triangles = 300});
    scene.cameras.clear();
    scene.meshes[0].name = "far\nball";
    scene.instances[0].transform[3] = {1335838.536f, -4659713.479f, 4131346.164f, 1};
    save_glb(tool.file("far.glb"), scene);
}

const std::string rounded =
    "one level moves vertices of instances[0] of meshes[0] \"far ball\" by up to 0.24 units, 12 % of its size";

} // namespace

TEST_CASE("levels: a placement that one level would round gets two, and info says why") {
    const Tool tool;
    make_far(tool);
    const Run built = tool.succeed("build far.glb -o far.bxw --report r.json");
    CHECK(built.err.empty());
    CHECK(built.out.find("two levels") != std::string::npos);
    CHECK(Json::parse(tool.contents("r.json"))["requirements"][0] == "two-levels");
    for (const std::string file : {"far.glb", "far.bxw"}) {
        const Json reason = Json::parse(tool.succeed("info " + file + " --json").out)["requirements"][0];
        CHECK(reason["word"] == "two-levels");
        CHECK(reason["because"].get<std::string>().starts_with("one level would move vertices of instances[0] of "));
    }
}

TEST_CASE("levels: one level that rounds a placement is warned of in one line, by every command") {
    const Tool tool;
    make_far(tool);
    const std::string size = " --resolution 8x8";
    const std::string warning = "boxwood: warning: far.glb: " + rounded + "; build with --levels two\n";
    for (const std::string command : {"build far.glb -o one.bxw", "analyze far.glb", "info far.glb --boxes b.glb"})
        CHECK(tool.succeed(command + " --levels one").err == warning);
    for (const std::string command :
         {"trace far.glb", "render far.glb -o x.exr --spp 1", "quality far.glb --bounds aabb"})
        CHECK(tool.succeed(command + size + " --levels one").err == warning);
    CHECK(tool.succeed("build far.glb -o two.bxw --levels two").err.empty());

    // The stored tree tells on itself; a report keeps what --quiet does not print.
    CHECK(tool.succeed("trace one.bxw" + size).err.find(rounded) != std::string::npos);
    CHECK(tool.succeed("trace two.bxw" + size).err.empty());
    CHECK(tool.succeed("trace one.bxw --quiet --report r.json" + size).err.empty());
    const Json report = Json::parse(tool.contents("r.json"));
    REQUIRE(report["scene"]["warnings"].size() == 1);
    CHECK(report["scene"]["warnings"][0].get<std::string>().find("build with --levels two") != std::string::npos);
}

TEST_CASE("levels: areas need one level, so that leaving them out is what a warning can ask for") {
    const Tool tool;
    make_far(tool);
    tool.write("areas.json", R"([{"kind": "plane", "point": [1335838, -4659713, 4131350], "direction": [0, 0, -1],
                                  "half_width": 4, "half_height": 4, "length": 20}])");
    CHECK(tool.succeed("build far.glb -o a.bxw --areas areas.json").err ==
          "boxwood: warning: far.glb: " + rounded + "; build without --areas, which needs one level\n");
}

TEST_SUITE_END();
