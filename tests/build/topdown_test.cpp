// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <limits>

#include "boxwood/error.hpp"
#include "boxwood/topdown.hpp"
#include "build/builder.hpp"
#include "build/topdown_boxes.hpp"
#include "build/trees.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

constexpr const char* width_source = "inline float width(const Distribution* d, Box box) {\n"
                                     "    return extent_of(box).x / extent_of(d->root).x;\n"
                                     "}\n";
float width(const Aabb& root, const Aabb& box) { return (box.max[0] - box.min[0]) / (root.max[0] - root.min[0]); }

} // namespace

TEST_CASE("topdown: the surface area heuristic splits as recursion does, large and small nodes alike") {
    for (const Tuning& tuning : tunings()) {
        CAPTURE(tuning.work_items);
        const TuningScope scope(tuning);
        for (const Spread spread : {Spread::cube, Spread::plane, Spread::line, Spread::places, Spread::sizes}) {
            CAPTURE(static_cast<int>(spread));
            // Around the 64 primitives above which the shortest slices make nodes large, and many levels above them.
            for (const std::uint32_t count : {1u, 2u, 3u, 4u, 5u, 63u, 64u, 65u, 129u, many()}) {
                CAPTURE(count);
                check(random_boxes({count}, spread, count), quality_options(1), quality_rules());
            }
            check(random_boxes({many() / 3}, spread, 5), quality_options(4), quality_rules());
        }
    }
}

TEST_CASE("topdown: forests, with trees that are large, small, and of one primitive") {
    for (const Tuning& tuning : tunings()) {
        CAPTURE(tuning.work_items);
        const TuningScope scope(tuning);
        const Boxes forest = random_boxes({1, many() / 4, 1, 2, 64, 65, 3, many() / 6, 1}, Spread::sizes, 9);
        check(forest, quality_options(1), quality_rules());
        check(forest, quality_options(4), quality_rules());
    }
    check(random_boxes({1, 1, 1}, Spread::cube, 9), quality_options(1), quality_rules());
    check({}, quality_options(1), quality_rules());
}

TEST_CASE("topdown: primitives by centres of their own") {
    Boxes forest = random_boxes({many() / 2, 70, 2}, Spread::cube, 11);
    Random random(12);
    for (std::size_t i = 0; i < 3 * forest.boxes.size(); ++i) forest.centres.push_back(random.uniform(-2.0f, 2.0f));
    TopDownOptions options = quality_options(1);
    check(forest, options, quality_rules());
    options.bin_box = true; // centres lie outside: the bins at the ends take them
    check(forest, options, quality_rules());
}

TEST_CASE("topdown: axes, thresholds and the fallback as in figure 9") {
    const Boxes forest = random_boxes({many() / 4, 66}, Spread::sizes, 13);
    for (const float quality : {0.0f, 0.4f, 0.7f, 1.0f}) {
        for (const float acceptable : {0.0f, 1.1f, 1.3f}) {
            for (const float excellent : {0.0f, 0.9f, 1.2f}) {
                CAPTURE(quality);
                CAPTURE(acceptable);
                CAPTURE(excellent);
                TopDownOptions options;
                options.bins = 16;
                options.bin_box = true;
                options.split_plane_quality = quality;
                options.acceptable_children = acceptable;
                options.excellent_children = excellent;
                options.max_leaf_primitives = 2;
                options.max_non_fallback_levels = acceptable > 1.0f ? 100 : 4;
                check(forest, options, reference_rules());
            }
        }
    }
}

TEST_CASE("topdown: axes in turn, and a fallback with a measure and axes of its own") {
    const Boxes forest = random_boxes({many() / 4, 66}, Spread::sizes, 14);
    const auto in_turn = [](const Aabb&, std::uint32_t level) {
        std::array<float, 3> quality{};
        quality[level % 3] = 1.0f;
        return quality;
    };
    TopDownOptions options;
    options.source = width_source;
    options.fallback_measure = "width";
    ReferenceRules rules = reference_rules();
    rules.fallback_measure = width;
    for (const bool fallback : {false, true}) {
        (fallback ? options.fallback_axes : options.axes) = "round_robin_axes";
        (fallback ? rules.fallback_axes : rules.axes) = in_turn;
        check(forest, options, rules);
        const Result result = run(forest, options);
        CHECK(result.fallbacks > 0);
        CHECK(result.fallbacks < result.splits);
    }
}

TEST_CASE("topdown: the fewest bins, the most, and numbers between") {
    for (const std::uint32_t bins : {2u, 3u, 33u, 64u}) {
        CAPTURE(bins);
        TopDownOptions options = quality_options(1);
        options.bins = bins;
        options.bin_box = bins % 2 == 0;
        options.primitives_per_bin = bins == 33 ? 1 : 16;
        check(random_boxes({many() / 4}, Spread::sizes, bins), options, quality_rules());
    }
}

TEST_CASE("topdown: leaves by every threshold, at every size of node") {
    for (const Tuning& tuning : tunings()) {
        const TuningScope scope(tuning);
        const Boxes forest = random_boxes({many() / 4, 2}, Spread::cube, 17);
        const auto with = [&](auto set) {
            TopDownOptions options;
            set(options);
            check(forest, options, reference_rules());
        };
        with([](TopDownOptions& o) { o.max_leaf_primitives = 100; });
        with([](TopDownOptions& o) { o.max_leaf_primitives = 1u << 30; });
        with([](TopDownOptions& o) { o.max_leaf_cost = 0.3f; });
        with([](TopDownOptions& o) { o.max_leaf_area = 0.05f; });
        with([](TopDownOptions& o) { o.max_leaf_hit_probability = 0.2f; });
        with([](TopDownOptions& o) { o.max_leaf_hit_probability = 2.0f; });
        with([](TopDownOptions& o) { o.max_levels = 1; });
        with([](TopDownOptions& o) { o.max_levels = 5; });
    }
}

TEST_CASE("topdown: halves in the middle of the longest axis") {
    TopDownOptions options = topdown_options(Builder::midpoint, 1);
    ReferenceRules rules = reference_rules();
    rules.thresholds = false;
    check(random_boxes({many() / 2}, Spread::sizes, 19), options, rules);
    check(random_boxes({many() / 2}, Spread::places, 19), options, rules);
}

TEST_CASE("topdown: strategies in OpenCL of one's own") {
    TopDownOptions options = quality_options(1);
    options.source =
        std::string(width_source) +
        "inline float squares(const Distribution* d, const Pair* pair) {\n"
        "    return pair->left_probability * pair->left_count + 2.0f * pair->right_probability * pair->right_count;\n"
        "}\n"
        "inline void last_axis(const Distribution* d, Box node, uint level, float quality[3]) {\n"
        "    quality[0] = 0.0f; quality[1] = 0.5f; quality[2] = 1.0f;\n"
        "}\n"
        "inline bool at_seven(const Distribution* d, const Thresholds* t, const NodeState* s) {\n"
        "    return s->count <= 7;\n"
        "}\n";
    options.measure = "width";
    options.axes = "last_axis";
    options.stop = "at_seven";
    ReferenceRules rules = quality_rules();
    rules.measure = width;
    rules.axes = [](const Aabb&, std::uint32_t) { return std::array<float, 3>{0.0f, 0.5f, 1.0f}; };
    rules.thresholds = true;
    const Boxes forest = random_boxes({many() / 4}, Spread::sizes, 31);
    const Result result = run(forest, options);
    TopDownOptions same = options;
    same.max_leaf_primitives = 7;
    const ReferenceTree wanted = reference_topdown(forest.boxes, {}, forest.offsets, same, rules);
    CHECK(difference(result.topology, wanted.topology) == "");
    CHECK(result.leaves == wanted.leaves);
    options.cost = "squares"; // another program of the same names
    CHECK(difference(run(forest, options).topology, wanted.topology) != "");

    options.source += "this is no OpenCL";
    CHECK_THROWS_AS(run(forest, options), ProgramError);
    options.source = "";
    CHECK_THROWS_AS(run(forest, options), ProgramError); // names without functions
}

TEST_CASE("topdown: options out of range are refused by name") {
    const Boxes forest = random_boxes({3}, Spread::cube, 1);
    const auto refuse = [&](auto set) {
        TopDownOptions options;
        set(options);
        CHECK_THROWS_AS(run(forest, options), InputError);
    };
    refuse([](TopDownOptions& o) { o.bins = 1; });
    refuse([](TopDownOptions& o) { o.bins = 65; });
    refuse([](TopDownOptions& o) { o.primitives_per_bin = 0; });
    refuse([](TopDownOptions& o) { o.primitives_per_bin = 1001; });
    refuse([](TopDownOptions& o) { o.block_size = 2; });
    refuse([](TopDownOptions& o) { o.max_levels = 0; });
    refuse([](TopDownOptions& o) { o.max_levels = 1001; });
    refuse([](TopDownOptions& o) { o.split_plane_quality = std::numeric_limits<float>::quiet_NaN(); });
    refuse([](TopDownOptions& o) { o.max_leaf_cost = -1.0f; });
    refuse([](TopDownOptions& o) { o.measure = "a b"; });
    refuse([](TopDownOptions& o) { o.axes = ""; });
}

TEST_SUITE_END();
