// SPDX-License-Identifier: MIT
// The area that a ray searches first.
#include <doctest/doctest.h>

#include <algorithm>

#include "boxwood/influence.hpp"
#include "build/local_trees.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

TEST_CASE("area_lookup: of the areas that hold the origin and that the ray follows the one it leaves last") {
    // Boxes along z from 0 to 1, 3, 2 and 3, the last two shifted; one along x; a frustum from the eye (0, 0, -1) to z
    // = 9.
    std::vector<InfluenceArea> areas(6);
    const double far[] = {1, 3, 2, 3, 3};
    for (int i = 0; i < 5; ++i) {
        areas[i].direction = {0, 0, 1};
        areas[i].far = far[i];
    }
    areas[2].origin.x = 1.5;
    areas[3].origin.x = 0.5;
    areas[4].origin = {-4, 0, 0.5};
    areas[4].direction = {1, 0, 0};
    areas[4].far = 9;
    areas[5].kind = AreaKind::point;
    areas[5].origin = {0, 0, -1};
    areas[5].direction = {0, 0, 1};
    areas[5].half_width = areas[5].half_height = 0.125;
    areas[5].near = 0.5;
    areas[5].far = 10;
    std::vector<LocalArea> local;
    for (const InfluenceRecord& record : influence_records(areas)) local.push_back(local_area(record));
    struct Case {
        float origin[3], direction[3], t_min;
        std::uint32_t found;
        double exit; ///< What it would be without rounding.
    };
    const std::vector<Case> cases{
        {{0.25f, 0.5f, 0.5f}, {0, 0, 1}, 0, 1, 2.5}, // 0, 1 and 3 hold it; 1 and 3 end where it is left last: the first
        {{0.25f, 0.5f, 0.5f}, {0, 0, 0.5f}, 0, 1, 5},              // in units of the direction
        {{1.25f, 0.5f, 0.5f}, {0, 0, 1}, 0, 3, 2.5},               // 2 and 3
        {{2.25f, 0.5f, 0.5f}, {0, 0, 1}, 0, 2, 1.5},               // 2 alone
        {{0.25f, 0.5f, 0.5f}, {0, 0, -1}, 0, 0, 0.5},              // backwards: all end at z = 0
        {{0.25f, 0.5f, 0.5f}, {1, 0, 0}, 0, 4, 4.75},              // the one along x
        {{0.25f, 0.5f, 0.5f}, {1, 0, 1}, 0, BOXWOOD_NONE, 0},      // along none
        {{0.25f, 0.5f, 0.5f}, {0, 0, 1}, 2.5f, BOXWOOD_NONE, 2.5}, // left before it begins
        {{0, 0, -0.875f}, {0, 0, 1}, 0, 5, 9.875},                 // between the eye and near
        {{0, 0, -1}, {0.0625f, 0, 1}, 0, 5, 10},                   // from the eye
        {{9, 9, 9}, {0, 0, 1}, 0, BOXWOOD_NONE, 0},                // in none
        {{1, 0.5f, 0.5f}, {0, 0, 1}, 0, 3, 2.5},                   // on a face of 0 and 1, which it might leave at once
    };
    std::vector<float> origins, directions, starts;
    for (const Case& c : cases) {
        origins.insert(origins.end(), c.origin, c.origin + 3);
        directions.insert(directions.end(), c.direction, c.direction + 3);
        starts.push_back(c.t_min);
    }
    Device& device = test_device();
    for (const AreaIndexKind kind : {AreaIndexKind::list, AreaIndexKind::octree, AreaIndexKind::kd}) {
        CAPTURE(std::string(name(kind)));
        const AreaIndex index = build_area_index(local, kind);
        const Guarded<std::uint32_t> found(device, cases.size());
        const Guarded<float> exits(device, cases.size());
        launch(device, {"traverse/area_lookup_test.cl", "find_area_test"}, "find area", cases.size(),
               upload(device, local, "areas"), upload(device, index.nodes, "nodes"),
               upload(device, index.items, "items"), upload(device, origins, "origins"),
               upload(device, directions, "directions"), upload(device, starts, "starts"), found.view(), exits.view(),
               static_cast<std::uint32_t>(cases.size()));
        CHECK(found.intact());
        CHECK(exits.intact());
        for (std::size_t i = 0; i < cases.size(); ++i) {
            INFO("case " << i);
            CHECK(found.values()[i] == cases[i].found);
            CHECK(double(exits.values()[i]) <= std::max(cases[i].exit, double(cases[i].t_min)));
            CHECK(exits.values()[i] == doctest::Approx(cases[i].exit).epsilon(1e-4));
        }
    }
}

TEST_SUITE_END();
