// SPDX-License-Identifier: MIT
// One tree for the rays that will come.
#include <doctest/doctest.h>

#include "boxwood/analysis.hpp"
#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/procedural.hpp"
#include "build/built_trees.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

InfluenceArea along_z(double share) {
    return {.kind = AreaKind::plane,
            .origin = {0.0, 0.0, 12.0},
            .direction = {0.0, 0.0, -1.0},
            .half_width = 6.0,
            .half_height = 6.0,
            .far = 24.0,
            .share = share};
}

TreeImage built(const Scene& scene, Builder builder, std::vector<InfluenceArea> areas) {
    const BuildOptions options{.layout = Layout::binary, .builder = builder, .areas = std::move(areas)};
    TreeImage image = download(test_device(), build(test_device(), scene, options));
    validate(image, scene, "blend");
    return image;
}

/// What an image costs the rays of an area, and those from everywhere.
LevelFigures analysed(const TreeImage& image, const Scene& scene, const InfluenceArea& area) {
    const AnalysisTree tree = analysis_trees(image, scene).at(0);
    return analysis_of(tree, measure_nodes(tree, influence_records(std::vector{area}))).all;
}

} // namespace

TEST_CASE("blend: the tree gives up what the rays that come do not need") {
    const Scene scene = scene_of({random_mesh(small_sizes() ? 60 : 2000, 5.0f, 0.7f, 7)});
    const InfluenceArea all = along_z(1.0), some = along_z(0.5);
    const LevelFigures sah = analysed(built(scene, Builder::sah, {}), scene, all);
    const LevelFigures known = analysed(built(scene, Builder::blend, {all}), scene, all);
    const LevelFigures mixed = analysed(built(scene, Builder::blend, {some}), scene, all);
    CHECK(known.pah_culled < 0.9 * sah.pah_culled);
    CHECK(known.pah_culled <= mixed.pah_culled);
    CHECK(mixed.pah_culled < sah.pah_culled);
    CHECK(mixed.sah < known.sah); // rays from everywhere pay less where the tree knows that they come
}

TEST_CASE("blend: no area, no share of the areas") {
    const Scene scene = scene_of({random_mesh(small_sizes() ? 60 : 2000, 5.0f, 0.7f, 8)});
    CHECK_THROWS_AS(built(scene, Builder::blend, {}), InputError);
    // An area that no ray follows changes nothing.
    const TreeImage none = built(scene, Builder::blend, {along_z(0.0)});
    InfluenceArea turned = along_z(0.0);
    turned.direction = {1.0, 0.5, 0.25};
    CHECK(same_trees(none, built(scene, Builder::blend, {turned})));
    CHECK(none.areas.empty());
}

TEST_SUITE_END();
