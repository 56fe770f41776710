// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "boxwood/error.hpp"
#include "boxwood/influence.hpp"
#include "io/influence.hpp"
#include "io/samples.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("io");

namespace {

const std::string plane =
    R"({"kind": "plane", "point": [1, 2, 3], "direction": [0, 0, -2], "half_width": 4, "half_height": 5, "length": 6,)"
    R"( "rays": 9})";
const std::string point =
    R"({"kind": "point", "eye": [1, 2, 3], "direction": [1, 0, 0], "fov_x_degrees": 90, "fov_y_degrees": 60,)"
    R"( "near": 0.5, "far": 8})";

/// `text` with the first `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// That the list, whose area 1 this is, is refused, naming it and `what`.
void check_refused(const std::string& area, const std::string& what) {
    INFO(area);
    try {
        read_areas("[" + plane + ", " + area + "]", "file.json");
        FAIL("was read");
    } catch (const InputError& error) {
        CHECK(error.file == "file.json");
        CHECK(error.where == "area 1");
        CHECK(std::string(error.what()).find(what) != std::string::npos);
    }
}

} // namespace

TEST_CASE("influence: a list of influence areas is read") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "areas.json";
    std::ofstream(file) << "[" << plane << ", " << with(point, "}", R"(, "tolerance_degrees": 3, "share": 0.25})")
                        << "]";
    const std::vector<InfluenceArea> areas = load_areas(file);
    REQUIRE(areas.size() == 2);
    CHECK(areas[0].kind == AreaKind::plane);
    CHECK(areas[0].origin == glm::dvec3(1, 2, 3));
    CHECK(areas[0].direction == glm::dvec3(0, 0, -2));
    CHECK(areas[0].half_width == 4);
    CHECK(areas[0].half_height == 5);
    CHECK(areas[0].near == 0);
    CHECK(areas[0].far == 6);
    CHECK(areas[0].tolerance_degrees == 0.5);
    CHECK(!areas[0].share);
    CHECK(areas[1].kind == AreaKind::point);
    CHECK(areas[1].half_width == doctest::Approx(1).epsilon(1e-15));
    CHECK(areas[1].half_height == doctest::Approx(std::sqrt(1.0 / 3)).epsilon(1e-15));
    CHECK(areas[1].near == 0.5);
    CHECK(areas[1].far == 8);
    CHECK(areas[1].tolerance_degrees == 3);
    CHECK(areas[1].share == 0.25);
    CHECK(read_areas("[]", "file.json").empty());
}

TEST_CASE("influence: influence areas that cannot be are refused by their index") {
    check_refused("7", "not a JSON object");
    check_refused("{}", "kind is missing");
    check_refused(with(plane, "\"plane\"", "\"plain\""), "kind");
    check_refused(with(plane, "\"plane\"", "1"), "kind");
    check_refused(with(plane, "\"plane\"", "\"point\""), "eye is missing");
    check_refused(with(plane, "[1, 2, 3]", "[1, 2]"), "point is not a list of three numbers");
    check_refused(with(plane, "[1, 2, 3]", "[1, 2, null]"), "point is not a list of three numbers");
    check_refused(with(plane, "[1, 2, 3]", "[1, 2, 1e30]"), "origin");
    check_refused(with(plane, "[0, 0, -2]", "[0, 0, 0]"), "direction is 0");
    check_refused(with(plane, "\"half_width\": 4", "\"half_width\": 0"), "extent");
    check_refused(with(plane, "\"half_width\": 4", "\"half_width\": \"4\""), "half_width is not a number");
    check_refused(with(plane, "\"half_height\": 5", "\"half_height\": -1"), "extent");
    check_refused(with(plane, "\"half_height\": 5", "\"half_height\": 1e-30"), "extent");
    check_refused(with(plane, "\"half_height\": 5", "\"half_height\": 1e30"), "extent");
    check_refused(with(plane, "\"length\": 6", "\"length\": 0"), "how far");
    check_refused(with(plane, "\"length\": 6", "\"width\": 6"), "length is missing");
    for (const char* degrees : {"0", "180", "-10", "181", "1e300", "1e-300", "179.9999999999"})
        for (const char* key : {"\"fov_x_degrees\": 90", "\"fov_y_degrees\": 60"})
            check_refused(with(point, key, std::string(key).substr(0, 17) + degrees), "180 degrees");
    check_refused(with(point, "\"near\": 0.5", "\"near\": 0"), "near is not above 0");
    check_refused(with(point, "\"near\": 0.5", "\"near\": -1"), "near is not above 0");
    check_refused(with(point, "\"near\": 0.5", "\"near\": 8"), "near is not below far");
    check_refused(with(point, "\"near\": 0.5", "\"near\": 7.9999999999"), "near is not below far"); // the same float
    check_refused(with(point, "\"far\": 8", "\"far\": 0.25"), "near is not below far");
    check_refused(with(plane, "}", ", \"share\": 1.5}"), "share");
    check_refused(with(plane, "}", ", \"share\": -0.5}"), "share");
    check_refused(with(plane, "}", ", \"share\": true}"), "share is not a number");
    check_refused(with(plane, "}", ", \"tolerance_degrees\": 91}"), "tolerance");
    check_refused(with(plane, "}", ", \"tolerance_degrees\": -1}"), "tolerance");
}

TEST_CASE("influence: files that are no list of influence areas are refused") {
    for (const std::string text :
         {"", "{}", "null", "[", "[1e999]", "[NaN]", "\xff", "[{}", "[{\"kind\": \"plane\",}]"})
        CHECK_THROWS_AS(read_areas(text, "file.json"), InputError);
    CHECK_THROWS_AS(read_areas(std::string(small_sizes() ? 1000 : 1000000, '['), "file.json"), InputError);
    const std::size_t depth = small_sizes() ? 1000 : 1000000;
    CHECK_THROWS_AS(read_areas(std::string(depth, '[') + std::string(depth, ']'), "file.json"), InputError);
    const TemporaryFolder folder;
    CHECK_THROWS_AS(load_areas(folder.path() / "missing.json"), InputError);
    CHECK_THROWS_AS(load_areas(folder.path()), InputError);
    std::string list = "[" + plane;
    for (std::size_t i = 1; i <= most_areas; ++i) list += "," + plane;
    CHECK_THROWS_AS(read_areas(list + "]", "file.json"), CapacityError);
    CHECK(read_areas(list.substr(0, list.size() - plane.size() - 1) + "]", "file.json").size() == most_areas);
}

TEST_CASE("influence: the areas of the paper's experiments are read") {
    const auto file = scenes_folder().parent_path() / "influence" / "areas.json";
    if (scenes_folder().empty() || !std::filesystem::exists(file)) {
        MESSAGE("skipped: no influence/areas.json beside BOXWOOD_SCENES");
        return;
    }
    const std::vector<InfluenceArea> areas = load_areas(file);
    REQUIRE(areas.size() == 64);
    std::size_t points = 0;
    for (const InfluenceArea& area : areas) points += area.kind == AreaKind::point;
    CHECK(points == 32);
    CHECK(areas[1].origin == glm::dvec3(7.5, 2.9, -7.5));
    CHECK(areas[4].near == 1);
    CHECK(influence_records(areas).size() == 64);
}

TEST_SUITE_END();
