// SPDX-License-Identifier: MIT
// Pictures of meshes whose placement one level would round.
#include "boxwood/rounding.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "boxwood/procedural.hpp"
#include "render/both_hits.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// A sphere of radius 5 at `centre`, seen from 30 away.
BothHits hits_of_sphere(glm::vec3 centre, Levels levels) {
    Scene scene = make_procedural("sphere", {.triangles = 4000});
    for (glm::vec3& position : scene.meshes[0].positions) position *= 5.0f;
    scene.instances[0].transform[3] = glm::vec4(centre, 1.0f);
    Camera camera;
    camera.vertical_fov = 0.5f;
    camera.to_world[3] = glm::vec4(centre + glm::vec3(0, 0, 30), 1.0f);
    return both_hits(test_device(), scene, {.levels = levels}, camera, 64, 64);
}

struct Difference {
    std::size_t pixels = 0; ///< That one shows and the other does not.
    float depth = 0.0f;     ///< The largest, where both show something.
};

Difference difference(const std::vector<Hit>& a, const std::vector<Hit>& b) {
    Difference result;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool shown = a[i].primitive != BOXWOOD_NONE;
        if (shown != (b[i].primitive != BOXWOOD_NONE))
            ++result.pixels;
        else if (shown)
            result.depth = std::max(result.depth, std::abs(a[i].t - b[i].t));
    }
    return result;
}

} // namespace

TEST_CASE("rounding: a mesh at earth-centred coordinates looks as it does at the origin, by rays and by raster") {
    // In float, so that the camera is as far from the mesh in both.
    const glm::vec3 earth_centred(1335838.536, -4659713.479, 4131346.164);
    const BothHits near = hits_of_sphere({}, Levels::automatic);
    const BothHits far = hits_of_sphere(earth_centred, Levels::automatic);
    for (const auto& [a, b] : {std::pair{&near.traced, &far.traced}, {&near.drawn, &far.drawn}}) {
        CHECK(difference(*a, *b).pixels == 0);
        CHECK(difference(*a, *b).depth <= 1e-3f);
    }
    // What the default spares.
    const BothHits rounded = hits_of_sphere(earth_centred, Levels::one);
    CHECK(difference(near.traced, rounded.traced).pixels > 20);
    CHECK(difference(near.drawn, rounded.drawn).pixels > 20);
}

TEST_SUITE_END();
