// SPDX-License-Identifier: MIT
// Levels of scenes whose placements round.
#include "boxwood/requirements.hpp"

#include <doctest/doctest.h>

#include "boxwood/procedural.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

/// A sphere of radius 1 with its centre at `centre`.
Scene sphere_at(glm::vec3 centre) {
    Scene scene = make_procedural("sphere", {.triangles = 300});
    scene.meshes[0].name = "ball";
    scene.instances[0].transform[3] = glm::vec4(centre, 1.0f);
    return scene;
}

const glm::vec3 earth_centred(1335838.536, -4659713.479, 4131346.164);

Levels levels_of(const Scene& scene, const BuildOptions& options = {}) {
    const Tree tree = build(test_device(), scene, options);
    CHECK(requirements(scene, options).two_levels == (tree.levels() == Levels::two));
    return tree.levels();
}

} // namespace

TEST_CASE("requirements: two levels where one would round a placement, and the reason") {
    const Scene far = sphere_at(earth_centred);
    CHECK(levels_of(far) == Levels::two);
    CHECK(levels_of(far, {.levels = Levels::one}) == Levels::one);
    REQUIRE_FALSE(reasons(far, {}).empty());
    CHECK(reasons(far, {})[0].word == "two-levels");
    CHECK(reasons(far, {})[0].because ==
          "one level would move vertices of instances[0] of meshes[0] \"ball\" by up to 0.24 units, 12 % of its size");
    CHECK(reasons(far, {.levels = Levels::two})[0].because == "the options ask for two levels");
    CHECK(levels_of(sphere_at({300, -20, 4})) == Levels::one);

    // One of several suffices.
    Scene several = sphere_at({});
    several.meshes.push_back(several.meshes[0]);
    several.instances.push_back({"", 1, far.instances[0].transform});
    CHECK(levels_of(several) == Levels::two);
    CHECK(reasons(several, {})[0].because.find("instances[1] of meshes[1]") != std::string::npos);
}

TEST_CASE("requirements: one level for large coordinates that need no rounding") {
    Scene baked = sphere_at({});
    for (glm::vec3& position : baked.meshes[0].positions) position += earth_centred;
    CHECK(levels_of(baked) == Levels::one);
    Scene doubled = sphere_at({});
    doubled.instances[0].transform = glm::mat4(0x1p30f);
    doubled.instances[0].transform[3] = {0, 0, 0, 1};
    CHECK(levels_of(doubled) == Levels::one);
}

TEST_CASE("requirements: influence areas keep one level, whatever it rounds") {
    const InfluenceArea area{.origin = glm::dvec3(earth_centred) + glm::dvec3(0, 0, 4),
                             .half_width = 2,
                             .half_height = 2,
                             .far = 8,
                             .share = 0.5};
    CHECK(levels_of(sphere_at(earth_centred), {.areas = {area}}) == Levels::one);
}

TEST_SUITE_END();
