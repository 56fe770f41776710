// SPDX-License-Identifier: MIT
// boxwood study influence.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/tool.hpp"
#include "support.hpp"

using namespace boxwood::test;
using Json = nlohmann::json;

TEST_SUITE_BEGIN("cli");

namespace {

/// Two areas of the made scene, and one of a scene that is not there.
constexpr const char* three_areas = R"([
 {"scene": "Random100", "area": "plane", "orientation": "parallel", "kind": "plane", "point": [5, 5, -4],
  "direction": [0, 0, 1], "half_width": 5, "half_height": 5, "length": 20},
 {"scene": "Random100", "area": "point", "orientation": "45", "kind": "point", "eye": [-3, 5, -3],
  "direction": [1, 0, 1], "fov_x_degrees": 60, "fov_y_degrees": 90, "near": 1, "far": 20},
 {"scene": "Atlantis", "area": "point", "orientation": "45", "kind": "point", "eye": [-3, 5, -3],
  "direction": [1, 0, 1], "fov_x_degrees": 60, "fov_y_degrees": 90, "near": 1, "far": 20}])";

constexpr const char* head =
    "scene,area,orientation,builder,estimated_pah_cost,estimated_sah_cost,real_cost_local,more,"
    "overlap_level4,overlap_level4_culled\n";

const std::vector<std::string> builders{"SAH+LSPH", "PAH+SPFH", "PAH+LSPH", "SAH+SPFH",
                                        "sah-axes", "sah-best", "blend"};

Json study(const Tool& tool, const std::string& arguments) {
    tool.succeed("study influence " + arguments + " --quiet --report s.json");
    return Json::parse(tool.contents("s.json"));
}

} // namespace

TEST_CASE("study: every builder in every configuration, beside what was published") {
    const Tool tool;
    tool.write("areas.json", three_areas);
    tool.write("published.csv", std::string(head) + "Random100,plane,parallel,SAH+LSPH,21,19,20,x,0.4,0.5\r\n" +
                                    "Random100,plane,parallel,PAH+SPFH,13,22,10,x,0.1,0.2\r\n\n");
    const std::string rays = small_sizes() ? "100" : "10000";
    const Run run = tool.succeed("study influence --areas areas.json --scenes . --published published.csv --rays " +
                                 rays + " --parameters --report s.json");
    CHECK(run.err.empty());
    CHECK(run.out.find("Atlantis") != std::string::npos);
    CHECK(run.out.find("|0.500") != std::string::npos); // the published ratio, 10 / 20
    for (std::size_t start = 0; start < run.out.size();) {
        const std::size_t end = run.out.find('\n', start);
        CHECK(end - start <= 120);
        start = end + 1;
    }
    const Json report = Json::parse(tool.contents("s.json"));
    CHECK(report["left_out"] == Json{"Atlantis"});
    REQUIRE(report["configurations"].size() == 2);
    for (const Json& each : report["configurations"]) {
        CAPTURE(each["area"]);
        CHECK(each["scene"] == "Random100");
        CHECK(each["triangles"] > 50);
        for (const std::string& builder : builders) {
            CAPTURE(builder);
            const double cost = each["costs"][builder], estimate = each["trees"][builder]["estimated_pah_culled"];
            CHECK(each["costs_to_hit"][builder] <= cost);
            CHECK(each["costs_to_hit"][builder] > 0.0);
            // The rays meet boxes as often as their projections say: the mean of 10,000 costs strays by about 1 %.
            if (!small_sizes()) CHECK(std::abs(cost - estimate) < 0.05 * estimate);
            CHECK(each["trees"][builder]["overlap_culled"]["4"] <= 1.0);
        }
    }
    CHECK(report["configurations"][0]["published"] == Json{{"PAH+SPFH", 10.0}, {"SAH+LSPH", 20.0}});
    CHECK(report["published_geomean"]["PAH+SPFH"] == doctest::Approx(0.5));
    CHECK(report["published_better_in"]["PAH+SPFH"] == 1);
    CHECK(report["geomean"]["SAH+LSPH"] == doctest::Approx(1.0));
    for (const std::string& builder : builders) {
        const double a = report["configurations"][0]["costs"][builder],
                     b = report["configurations"][1]["costs"][builder],
                     base_a = report["configurations"][0]["costs"]["SAH+LSPH"],
                     base_b = report["configurations"][1]["costs"]["SAH+LSPH"];
        CHECK(report["geomean"][builder] == doctest::Approx(std::sqrt(a / base_a * b / base_b)));
        CHECK(report["groups"]["plane parallel"]["geomean"][builder] == doctest::Approx(a / base_a));
        CHECK(report["better_in"][builder] == (a < base_a) + (b < base_b));
        CHECK(report["worst"][builder] == doctest::Approx(std::max(a / base_a, b / base_b)));
    }
    CHECK(report["errors"]["plane"]["SAH+LSPH"]["published_pah"] == doctest::Approx(1.0 / 21));
    CHECK(report["parameters"].size() == 5);
}

TEST_CASE("study: seeds decide the scene and the rays, and nothing else does") {
    const Tool tool;
    tool.write("areas.json", three_areas);
    const Json first = study(tool, "--areas areas.json --scenes . --rays 200 --seed 3");
    CHECK(study(tool, "--areas areas.json --scenes . --rays 200 --seed 3")["configurations"] ==
          first["configurations"]);
    CHECK(study(tool, "--areas areas.json --scenes . --rays 200 --seed 4")["configurations"] !=
          first["configurations"]);
    CHECK(first["published_geomean"].empty());

    // Seeds 1 and 3: not the same rays but for the first, by which a mean of 20,000 would move by less than 0.01 %.
    tool.succeed("scene random --triangles 200 -o pah_Some.glb");
    tool.write("some.json", R"([{"scene": "Some", "orientation": "parallel", "kind": "plane", "point": [0.5, 0.5, 9],
        "direction": [0, 0, -1], "half_width": 0.5, "half_height": 0.5, "length": 20}])");
    const auto cost = [&](const std::string& seed) {
        return study(tool, "--areas some.json --scenes . --rays 20000 --seed " +
                               seed)["configurations"][0]["costs"]["SAH+LSPH"]
            .get<double>();
    };
    const double one = cost("1");
    CHECK(std::abs(cost("3") - one) > 3e-4 * one);
}

TEST_CASE("study: an area without triangles costs nothing") {
    const Tool tool;
    tool.write("areas.json", R"([{"scene": "Random100", "orientation": "away", "kind": "plane", "point": [5, 5, -4],
        "direction": [0, 0, -1], "half_width": 5, "half_height": 5, "length": 20}])");
    const Json report = study(tool, "--areas areas.json --scenes . --rays 10");
    CHECK(report["configurations"][0]["triangles"] == 0);
    CHECK(report["configurations"][0]["costs"].empty());
    CHECK(report["geomean"].empty());
    CHECK(report["groups"]["all"]["configurations"] == 1);
    CHECK(report["errors"]["plane"]["blend"] == Json::object());
    const Run run = tool.succeed("study influence --areas areas.json --scenes . --rays 10 --profile");
    CHECK(run.out.find("1.000") == std::string::npos); // a ratio of nothing
    CHECK(run.out.find("launches") != std::string::npos);
}

TEST_CASE("study: bad input is named by file and line") {
    const Tool tool;
    tool.write("areas.json", three_areas);
    const std::string begin = "study influence --areas areas.json --scenes . --rays 10 --published ";
    const auto complaint = [&](const std::string& csv) {
        tool.write("p.csv", csv);
        const Run run = tool.run(begin + "p.csv");
        CHECK(run.code == 3);
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
        return run.err;
    };
    CHECK(complaint("scene,area\n").find("line 1") != std::string::npos);
    CHECK(complaint(std::string(head) + "Random100,plane,parallel,SAH+LSPH,21,19,20,x,0.4,0.5\na,b\n").find("line 3") !=
          std::string::npos);
    CHECK(complaint(std::string(head) + "Random100,plane,parallel,SAH+LSPH,21,19,many,x,0.4,0.5\n").find("many") !=
          std::string::npos);
    const std::string row = "Random100,plane,parallel,SAH+LSPH,21,19,20,x,0.4,0.5\n";
    CHECK(complaint(head + row + "\r\n" + row).find("line 4: has SAH+LSPH of Random100 plane parallel again") !=
          std::string::npos);
    CHECK(complaint("scene,scene," + std::string(head)).find("names column scene twice") != std::string::npos);
    CHECK(complaint(std::string(head) + "Random100,plane,aslant,SAH+LSPH,21,19,20,x,0.4,0.5\n").find("p.csv: ") !=
          std::string::npos); // no such configuration
    CHECK(complaint("").find("line 1") != std::string::npos);
    CHECK(tool.run(begin + ".").code == 3);
    CHECK(tool.run("study influence --areas areas.json --scenes nowhere").code == 3);
    tool.write("atlantis.json", R"([{"scene": "Atlantis", "orientation": "45", "kind": "plane", "point": [5, 5, -4],
        "direction": [0, 0, -1], "half_width": 5, "half_height": 5, "length": 20}])");
    CHECK(tool.run("study influence --areas atlantis.json --scenes .").code == 3); // nothing to study
    CHECK(tool.run(begin + "missing.csv").code == 3);
    CHECK(tool.run("study influence --areas missing.json --scenes .").code == 3);
    tool.write("nameless.json", R"([{"kind": "plane", "point": [5, 5, -4], "direction": [0, 0, -1], "half_width": 5,
        "half_height": 5, "length": 20}])");
    const Run nameless = tool.run("study influence --areas nameless.json --scenes .");
    CHECK(nameless.code == 3);
    CHECK(nameless.err.find("area 0") != std::string::npos);
    CHECK(tool.run("study influence --scenes .").code == 2);
    CHECK(tool.run("study").code == 2);
    CHECK(tool.run("study influence --areas areas.json --scenes . --seed -1").code == 2);
    const Run rays = tool.run("study influence --areas areas.json --scenes . --rays 0");
    CHECK(rays.code == 2);
    CHECK(rays.err.find("see boxwood study influence --help") != std::string::npos);
}

TEST_CASE("study: on a scene of the paper the estimates hold, and the base costs what it cost there") {
    if (scenes_folder().empty() || !std::filesystem::exists(scenes_folder() / "pah_MonkeyModel.glb")) {
        MESSAGE("skipped: pah_MonkeyModel.glb needs BOXWOOD_SCENES");
        return;
    }
    const Tool tool;
    tool.write("areas.json", R"([
 {"scene": "Suzanne", "orientation": "parallel", "kind": "plane", "point": [0, 0, 2], "direction": [0, 0, -1],
  "half_width": 0.9, "half_height": 0.9, "length": 10},
 {"scene": "Suzanne", "orientation": "parallel", "kind": "point", "eye": [0, 0, 4], "direction": [0, 0, -1],
  "fov_x_degrees": 30, "fov_y_degrees": 30, "far": 10, "near": 2}])");
    const Json report = study(tool, "--areas areas.json --scenes " + scenes_folder().string());
    for (const std::string& builder : builders) {
        CAPTURE(builder);
        CHECK(report["errors"]["plane"][builder]["pah_culled"] < 0.02);
        CHECK(report["errors"]["point"][builder]["pah_culled"] < 0.06);
    }
    // 45.96 and 48.89 there, by a builder of its own bins and a thousand rays.
    CHECK(report["configurations"][0]["costs"]["SAH+LSPH"] == doctest::Approx(45.96).epsilon(0.15));
    CHECK(report["configurations"][1]["costs"]["SAH+LSPH"] == doctest::Approx(48.89).epsilon(0.15));
    CHECK(report["geomean"]["sah-axes"] < 1.0);
}

TEST_SUITE_END();
