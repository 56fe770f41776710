// SPDX-License-Identifier: MIT
// Top-down builds of what is degenerate, far apart, deep or cut strangely.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "build/topdown_boxes.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

TEST_CASE("topdown_extremes: equal, degenerate and huge boxes are halved or parted without an absolute size") {
    for (const float place : {0.0f, 1.0f, -1e18f, 1e-38f}) {
        CAPTURE(place);
        const Boxes forest{std::vector<Aabb>(100, {{place, place, place}, {place, place, place}}), {0, 100}, {}};
        check(forest, quality_options(1), quality_rules());
        check(forest, quality_options(4), quality_rules());
    }
    // About the same place, of all sizes: large nodes that no plane parts.
    Boxes nested{{}, {0, many()}, {}};
    for (std::uint32_t i = 0; i < many(); ++i) {
        const float half = std::ldexp(static_cast<float>(1 + i % 7), static_cast<int>(i % 100) - 50);
        nested.boxes.push_back({{-half, -half, -half}, {half, half, half}});
    }
    check(nested, quality_options(1), quality_rules());
    Boxes mixed = random_boxes({many() / 4}, Spread::cube, 23);
    mixed.boxes[5] = {{-1e17f, -1e17f, -1e17f}, {1e17f, 1e17f, 1e17f}};
    mixed.boxes[6] = {{1e17f, 1e17f, 1e17f}, {1e17f, 1e17f, 1e17f}};
    check(mixed, quality_options(1), quality_rules());
}

TEST_CASE("topdown_extremes: scaling by powers of two changes nothing") {
    const Boxes forest = random_boxes({many() / 2, 65}, Spread::sizes, 29);
    TopDownOptions paper;
    paper.bin_box = true;
    for (const TopDownOptions& options : {quality_options(1), quality_options(4), paper}) {
        const Result wanted = run(forest, options);
        for (const float factor : {0x1p-60f, 0x1p-7f, 0x1p60f}) {
            CAPTURE(factor);
            const Result result = run(scaled(forest, factor), options);
            CHECK(difference(result.topology, wanted.topology) == "");
            CHECK(result.leaves == wanted.leaves);
        }
    }
}

TEST_CASE("topdown_extremes: the deepest tree ends at max_levels and below it halves") {
    // Every box twice as far and as large as the one before: planes part off a few each time.
    Boxes forest;
    for (int i = 0; i < 120; ++i) {
        const float at = std::exp2(static_cast<float>(i) - 60.0f);
        forest.boxes.push_back({{at, at, at}, {1.5f * at, 1.5f * at, 1.5f * at}});
    }
    forest.offsets.push_back(120);
    TopDownOptions options = quality_options(1);
    check(forest, options, quality_rules());
    CHECK(reference_topdown(forest.boxes, {}, forest.offsets, options, quality_rules()).depth > 20);
    options.max_levels = 7;
    check(forest, options, quality_rules());
    CHECK(reference_topdown(forest.boxes, {}, forest.offsets, options, quality_rules()).depth <= 7 + 7);
    // Along one axis, over most of the numbers that a coordinate may be: two bins part off one box at a time.
    Boxes line;
    for (double at = 0x1p-120; at < 0x1p59; at *= 2.1) {
        const auto low = static_cast<float>(at);
        line.boxes.push_back({{low, 0, 0}, {1.5f * low, 0, 0}});
    }
    const auto count = static_cast<std::uint32_t>(line.boxes.size());
    line.offsets.push_back(count);
    options.bins = 2;
    for (const std::uint32_t levels : {100u, 1000u}) {
        options.max_levels = levels;
        check(line, options, quality_rules());
        const std::uint32_t depth = reference_topdown(line.boxes, {}, line.offsets, options, quality_rules()).depth;
        CHECK(depth == (levels == 100 ? 100 + std::bit_width(count - 101) : count - 1));
    }
}

TEST_CASE("topdown_extremes: centres far outside the node's box go to the bins at its ends") {
    Boxes forest = random_boxes({many() / 4}, Spread::cube, 37);
    Random random(38);
    for (std::size_t i = 0; i < 3 * forest.boxes.size(); ++i)
        forest.centres.push_back(std::ldexp(random.uniform(-1.0f, 1.0f), 40)); // bins beyond what integers hold
    TopDownOptions options = quality_options(1);
    options.bin_box = true;
    check(forest, options, quality_rules());
}

TEST_CASE("topdown_extremes: large nodes in slices so long that the next would begin beyond 2^32") {
    if (small_sizes()) return;
    const TuningScope scope({4, 16, 1u << 31, 16}); // nodes of more than 4096 primitives are large
    check(random_boxes({9000}, Spread::cube, 41), quality_options(1), quality_rules());
}

TEST_SUITE_END();
