// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "render/camera.hpp"
#include "render/raster_agreement.hpp"
#include "support.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// At least 99.9 % of the pixels are the same; of small pictures up to two may differ. All that differ are on an edge.
void check_agreement(const Agreement& result) {
    CAPTURE(result.pixels);
    CAPTURE(result.different);
    CAPTURE(result.farthest);
    CHECK(result.different * 1000 <= std::max<std::size_t>(result.pixels, 2000));
    CHECK(result.off_edge == 0);
    CHECK(result.wrong == 0);
}

std::vector<BuildOptions> tree_options() {
    std::vector<BuildOptions> all;
    for (const Levels levels : {Levels::one, Levels::two})
        for (const Layout layout : {Layout::wide8, Layout::binary}) {
            BuildOptions options;
            options.levels = levels;
            options.layout = layout;
            all.push_back(options);
        }
    return all;
}

} // namespace

TEST_CASE("raster: the hits of rays, on every procedural scene and kind of tree") {
    // Two tiles and a part of one across and down.
    const std::uint32_t width = small_sizes() ? 20 : 150, height = small_sizes() ? 9 : 91;
    for (const ProceduralKind& kind : procedural_kinds()) {
        CAPTURE(kind.name);
        const Scene scene = make_procedural(kind.name, {small_sizes() ? 100u : 3000u, 5, 3});
        for (const BuildOptions& options : tree_options()) {
            const Camera& camera = scene.cameras.at(0);
            const BothHits both = both_hits(test_device(), scene, options, camera, width, height, {0.37f, -0.81f});
            const Agreement result = agreement(scene, camera, height, both);
            CHECK(result.hits > 0);
            check_agreement(result);
        }
    }
}

TEST_SUITE_END();
