// SPDX-License-Identifier: MIT
// Influence areas and builders at the command line.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.hpp"
#include "support.hpp"

using namespace boxwood::test;
using Json = nlohmann::json;

TEST_SUITE_BEGIN("cli");

namespace {

constexpr const char* plane = R"([{"kind": "plane", "point": [0, 0, 0.99], "direction": [0, 0, -1],
                                  "half_width": 1, "half_height": 1, "length": 2}])";

Json report_of(const Tool& tool, const std::string& arguments) {
    tool.succeed(arguments + " --quiet --report r.json");
    return Json::parse(tool.contents("r.json"));
}

} // namespace

TEST_CASE("areas: a file, those of lights, those of a probe; the same answers by all") {
    const Tool tool;
    tool.succeed("scene cornell -o cornell.glb --quiet");
    tool.write("areas.json", plane);
    const std::string trace = "trace cornell.glb --rays shadow --resolution 64x64";
    const Json without = report_of(tool, trace);
    for (const std::string areas : {"areas.json", "lights", "probe", "none"}) {
        for (const std::string builder : {"lbvh", "sah", "pah", "blend"}) {
            if (areas == "none" && (builder == "pah" || builder == "blend")) continue;
            CAPTURE(areas);
            CAPTURE(builder);
            const Json report = report_of(tool, trace + " --builder " + builder + " --areas " + areas);
            CHECK(report["trace"]["checksum"] == without["trace"]["checksum"]);
        }
    }
}

TEST_CASE("areas: a tree with local trees is stored with them") {
    const Tool tool;
    tool.succeed("scene cornell -o cornell.glb --quiet");
    tool.write("areas.json", plane);
    const Json report = report_of(tool, "build cornell.glb -o a.bxw --builder pah --areas areas.json");
    CHECK(report["options"]["builder"] == "pah");
    CHECK(report["areas"]["kept"] == 1);
    CHECK(report["areas"]["triangles"][0] > 0);
    CHECK(report["areas"]["local_tree_bytes"] > 0);
    const std::string rays = " --rays shadow --resolution 64x64";
    const Json stored = report_of(tool, "trace a.bxw" + rays);
    CHECK(stored["trace"]["checksum"] == report_of(tool, "trace cornell.glb" + rays)["trace"]["checksum"]);
    CHECK(stored["areas"]["kept"] == 1);
    CHECK(stored["areas"]["local_tree_bytes"] == report["areas"]["local_tree_bytes"]);
    CHECK(Json::parse(tool.succeed("info a.bxw --json").out)["tree"]["areas"] == 1);
    CHECK(tool.succeed("info a.bxw").out.find("1 with local trees of ") != std::string::npos);
}

TEST_CASE("areas: where there are none, the summary says so, and by what the tree was built") {
    const Tool tool;
    tool.succeed("scene random --triangles 50 -o random.glb --quiet"); // no lights
    tool.write("none.json", "[]");
    for (const std::string areas : {"lights", "none.json"}) {
        const std::string out = tool.succeed("build random.glb -o a.bxw --builder pah --areas " + areas).out;
        CHECK(out.find("built by sah") != std::string::npos);
        CHECK(out.find("no influence area by --areas " + areas) != std::string::npos);
    }
}

TEST_CASE("areas: what does not go together, and files that are none") {
    const Tool tool;
    tool.succeed("scene cornell -o cornell.glb --quiet");
    tool.write("areas.json", plane);
    tool.write("flat.json", R"([{"kind": "plane", "point": [0, 0, 0], "direction": [0, 0, -1],
                                  "half_width": 0, "half_height": 1, "length": 2}])");
    const auto build = [&](const std::string& options) {
        return tool.run("build cornell.glb -o a.bxw --quiet " + options);
    };
    CHECK(build("--builder pah").code == 2);
    CHECK(build("--builder blend").code == 2);
    CHECK(build("--areas areas.json --levels two").code == 2);
    CHECK(build("--areas areas.json --bounds obb-points").code == 2);
    CHECK(build("--area-index kd").code == 2);
    CHECK(build("--area-index kd --areas areas.json --builder blend").code == 2); // no local trees to find
    CHECK(build("--morton 63 --builder sah").code == 2);
    CHECK(build("--areas ''").code == 2);
    CHECK(build("--areas missing.json").code == 3);
    const Run flat = build("--areas flat.json");
    CHECK(flat.code == 3);
    CHECK(flat.err.find("area 0") != std::string::npos);
    CHECK(!std::filesystem::exists(tool.file("a.bxw")));
}

TEST_SUITE_END();
