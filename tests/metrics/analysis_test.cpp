// SPDX-License-Identifier: MIT
// The analyser against closed forms, against counting rays that meet boxes, and on stored trees of every layout.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "boxwood/analysis.hpp"
#include "boxwood/build.hpp"
#include "build/built_trees.hpp"
#include "influence/projection.hpp"
#include "oracles/reference_builder.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("metrics");

namespace {

using Corners = std::array<glm::dvec3, 8>;

InfluenceRecord record(bool point, const glm::dvec3& origin, glm::dvec3 forward, double half_width, double half_height,
                       double near, double far) {
    forward = glm::normalize(forward);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.1, 1.0, 0.05)));
    const glm::dvec3 up = glm::cross(right, forward);
    InfluenceRecord area{};
    for (int k = 0; k < 3; ++k) {
        area.origin[k] = static_cast<float>(origin[k]);
        area.right[k] = static_cast<float>(right[k]);
        area.up[k] = static_cast<float>(up[k]);
        area.forward[k] = static_cast<float>(forward[k]);
    }
    area.point = point;
    area.half_width = static_cast<float>(half_width);
    area.half_height = static_cast<float>(half_height);
    area.near = static_cast<float>(near);
    area.far = static_cast<float>(far);
    area.share = 0.5f;
    return area;
}

glm::dvec3 vector_of(const float* v) { return {v[0], v[1], v[2]}; }

/// A ray of the area through the place (x, y) in [-1, 1]^2 of its rectangle.
std::pair<glm::dvec3, glm::dvec3> ray_of(const InfluenceRecord& area, double x, double y) {
    const glm::dvec3 aside =
        vector_of(area.right) * (x * area.half_width) + vector_of(area.up) * (y * area.half_height);
    const glm::dvec3 forward = vector_of(area.forward), origin = vector_of(area.origin);
    if (!area.point) return {origin + aside, forward};
    const glm::dvec3 direction = forward + aside;
    return {origin + direction * double(area.near), direction};
}

bool meets(const std::pair<glm::dvec3, glm::dvec3>& ray, const Corners& box) {
    const glm::dmat3 to_unit = glm::inverse(glm::dmat3(box[1] - box[0], box[2] - box[0], box[4] - box[0]));
    const glm::dvec3 origin = to_unit * (ray.first - box[0]), direction = to_unit * ray.second;
    double first = 0.0, last = 1e300;
    for (int k = 0; k < 3; ++k) {
        const double a = -origin[k] / direction[k], b = (1.0 - origin[k]) / direction[k];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

Corners random_box(Random& random, bool oriented) {
    const auto vector = [&](float reach) {
        return glm::dvec3(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach));
    };
    const glm::dvec3 low = vector(3.0f), size = glm::abs(vector(2.0f));
    glm::dmat3 edges(0.0);
    for (int k = 0; k < 3; ++k) edges[k] = oriented ? vector(1.5f) : glm::dvec3(k == 0, k == 1, k == 2) * size[k];
    Corners corners;
    for (int i = 0; i < 8; ++i)
        corners[i] = low + double(i & 1) * edges[0] + double(i >> 1 & 1) * edges[1] + double(i >> 2) * edges[2];
    return corners;
}

/// What rays of the area, as many along each side of its rectangle, pay in all boxes that they meet.
double mean_cost(const AnalysisTree& tree, const InfluenceRecord& area, int side) {
    double sum = 0.0;
    for (const AnalysisNode& node : tree.nodes) {
        Corners corners;
        for (int i = 0; i < 8; ++i)
            for (int k = 0; k < 3; ++k) corners[i][k] = i >> k & 1 ? node.box.max[k] : node.box.min[k];
        int met = 0;
        for (int i = 0; i < side * side; ++i)
            met +=
                meets(ray_of(area, (2 * (i % side) + 1.0) / side - 1.0, (2 * (i / side) + 1.0) / side - 1.0), corners);
        sum += met * (node.children == 0 ? 1.2 * node.primitives : double(node.children));
    }
    return sum / (side * side);
}

/// A tree of a root and children with the given boxes.
AnalysisTree family(const std::vector<Aabb>& children) {
    AnalysisTree tree;
    tree.nodes.push_back({children[0], 0, BOXWOOD_NONE, 1, std::uint32_t(children.size()), 0});
    for (const Aabb& box : children) {
        AnalysisNode& root = tree.nodes[0];
        for (int k = 0; k < 3; ++k) {
            root.box.min[k] = std::min(root.box.min[k], box.min[k]);
            root.box.max[k] = std::max(root.box.max[k], box.max[k]);
        }
        root.primitives += 3;
        tree.nodes.push_back({box, 1, 0, 0, 0, 3});
    }
    return tree;
}

} // namespace

TEST_CASE("analysis: projection: its share of the rectangle is the share of rays that meet the box, and likewise of "
          "two boxes") {
    Random random(31);
    const int side = small_sizes() ? 40 : 300, cases = small_sizes() ? 6 : 60;
    for (int i = 0; i < cases; ++i) {
        CAPTURE(i);
        const bool point = i & 1, oriented = i & 2;
        const glm::dvec3 origin(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
        const glm::dvec3 forward = i % 5 == 0 ? glm::dvec3(0, 0, 1) : -origin; // along an axis, or through the middle
        const InfluenceRecord area =
            record(point, origin, forward, random.uniform(0.3f, 3), random.uniform(0.3f, 3), point ? 0.7 : 0.0, 10.0);
        const Corners a = random_box(random, oriented), b = random_box(random, oriented);
        int in_a = 0, in_both = 0;
        for (int x = 0; x < side; ++x) {
            for (int y = 0; y < side; ++y) {
                const auto ray = ray_of(area, (2 * x + 1.0) / side - 1.0, (2 * y + 1.0) / side - 1.0);
                const bool hit = meets(ray, a);
                in_a += hit;
                in_both += hit && meets(ray, b);
            }
        }
        // A grid of s^2 places misjudges the area of a convex outline of length l <= 8 by at most about l / s of 4.
        const double tolerance = 3.0 / side, all = double(side) * side;
        const Polygon shadow_a = projection(area, a), shadow_b = projection(area, b);
        const Polygon culled_a = clip_to_rectangle(shadow_a), culled_b = clip_to_rectangle(shadow_b);
        CHECK(std::abs(culled_a.area() / 4 - in_a / all) < tolerance);
        CHECK(std::abs(intersection(culled_a, culled_b).area() / 4 - in_both / all) < tolerance);
        CHECK(intersection(shadow_a, shadow_b).area() == doctest::Approx(intersection(shadow_b, shadow_a).area()));
        // What is not culled is what a rectangle sees that is large enough to cull nothing.
        InfluenceRecord wide = area;
        wide.half_width *= 64.0f;
        wide.half_height *= 64.0f;
        CHECK(clip_to_rectangle(projection(wide, a)).area() * 4096.0 == doctest::Approx(shadow_a.area()).epsilon(1e-6));
    }
}

TEST_CASE("analysis: two boxes side by side, by hand") {
    // From the front, that is along -z: unit squares at [0,1] and [0.5,1.5] of a rectangle [-2,2]^2, so 1/16 of it
    // each.
    const AnalysisTree tree = family({{{0, 0, 0}, {1, 1, 1}}, {{0.5f, 0, 3}, {1.5f, 1, 4}}});
    InfluenceRecord area = record(false, {0, 0, 10}, {0, 0, -1}, 2, 2, 0, 20);
    const float right[3] = {1, 0, 0}, up[3] = {0, 1, 0};
    std::copy(right, right + 3, area.right);
    std::copy(up, up + 3, area.up);
    std::vector<NodeMeasures> measures = measure_nodes(tree, std::span(&area, 1));
    REQUIRE(measures.size() == 3);
    CHECK(measures[0].probability == doctest::Approx(1.5 / 16));
    CHECK(measures[1].probability == doctest::Approx(1.0 / 16));
    CHECK(measures[0].overlap == doctest::Approx(0.5 / 16));
    CHECK(measures[0].smaller == doctest::Approx(1.0 / 16));
    const double root = 2 * (1.5 * 1 + 1 * 4 + 4 * 1.5), child = 6;
    CHECK(measures[1].surface == doctest::Approx(child / root));
    Analysis result = analysis_of(tree, measures);
    CHECK(result.all.sah == doctest::Approx(2.0 + 2 * 3 * 1.2 * child / root));
    CHECK(result.all.pah == doctest::Approx(2.0 * 1.5 / 16 + 2 * 3 * 1.2 / 16));
    CHECK(result.all.pah_culled == doctest::Approx(result.all.pah));
    CHECK(result.down_to(4).overlap_ratio() == doctest::Approx(0.5));
    CHECK(result.leaves_by_size == std::vector<std::uint64_t>{0, 0, 0, 2});
    CHECK(result.levels[1].nodes == 2);
    CHECK(result.down_to(0).overlap == 0.0);
    CHECK(result.primitives == 6);
    CHECK(result.depth() == 1);

    // Only a quarter of each box is in the rectangle's upper right half unit; nothing of what is behind it counts.
    area.origin[0] = -1.25f;
    measures = measure_nodes(tree, std::span(&area, 1)); // sees x in [-3.25, 0.75]
    CHECK(measures[1].probability_culled == doctest::Approx(0.75 / 16));
    CHECK(measures[2].probability_culled == doctest::Approx(0.25 / 16));
    CHECK(measures[0].overlap_culled == doctest::Approx(0.25 / 16));
    CHECK(measures[1].probability == doctest::Approx(1.0 / 16));
    area.origin[2] = 2.0f;
    measures = measure_nodes(tree, std::span(&area, 1));
    CHECK(measures[2].probability == 0.0);
    CHECK(measures[1].probability == doctest::Approx(1.0 / 16));
    // Several areas count by their shares.
    InfluenceRecord both[2] = {area, area};
    both[1].origin[2] = 10.0f;
    both[1].share = 0.125f;
    CHECK(measure_nodes(tree, both)[2].probability == doctest::Approx(0.2 / 16));
    CHECK(measure_nodes(tree, {})[2].probability == 0.0);
    both[0].share = both[1].share = 0.0f; // none has a share: alike
    CHECK(measure_nodes(tree, both)[2].probability == doctest::Approx(0.5 / 16));
}

TEST_CASE("analysis: figures are free of scale, bit for bit, and finite for boxes and rectangles of no extent") {
    const std::vector<Aabb> boxes{{{0, 0, 0}, {1, 1, 1}}, {{0.5f, 0, 3}, {1.5f, 1, 4}}, {{-1, 2, 5}, {3, 2, 5}}};
    const InfluenceRecord areas[] = {record(false, {0, 0, 9}, {0.1, 0, -1}, 2, 1, 0, 20),
                                     record(true, {1, 0.5, 2}, {0.2, 0.1, 1}, 0.5, 1, 0.25, 20)};
    const auto measured = [&](float scale) {
        AnalysisTree tree = family(boxes);
        for (AnalysisNode& node : tree.nodes)
            for (int k = 0; k < 3; ++k) node.box.min[k] *= scale, node.box.max[k] *= scale;
        std::vector<InfluenceRecord> scaled(std::begin(areas), std::end(areas));
        for (InfluenceRecord& area : scaled) {
            for (float& x : area.origin) x *= scale;
            area.near *= scale, area.far *= scale;
            if (area.point == 0) area.half_width *= scale, area.half_height *= scale;
        }
        return measure_nodes(tree, scaled);
    };
    const std::vector<NodeMeasures> plain = measured(1.0f);
    for (const NodeMeasures& node : plain)
        for (const double figure :
             {node.surface, node.probability, node.probability_culled, node.overlap, node.smaller})
            CHECK(std::isfinite(figure));
    CHECK(plain[3].surface == 0.0); // a line
    CHECK(plain[3].probability == 0.0);
    for (const float scale : {0x1p55f, 0x1p-55f, 0x1p-120f}) {
        CAPTURE(scale);
        const std::vector<NodeMeasures> other = measured(scale);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            CHECK(other[i].surface == plain[i].surface);
            CHECK(other[i].probability == plain[i].probability);
            CHECK(other[i].probability_culled == plain[i].probability_culled);
            CHECK(other[i].overlap == plain[i].overlap);
            CHECK(other[i].smaller_culled == plain[i].smaller_culled);
        }
    }
    // A tree all of whose boxes are one point: every node counts as met.
    for (const NodeMeasures& node : measure_nodes(family({{{1, 1, 1}, {1, 1, 1}}}), areas)) CHECK(node.surface == 1.0);
}

TEST_CASE("analysis: stored trees of every layout hold every triangle once, in nested boxes of the stated depth") {
    Device& device = test_device();
    const std::uint32_t triangles = small_sizes() ? 40 : 500;
    const Scene scene = scene_of({test::random_mesh(triangles, 3, 1, 32), test::random_mesh(1, 3, 1, 33)});
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        for (const Levels levels : {Levels::one, Levels::two}) {
            for (const Bounds bounds : {Bounds::aabb, Bounds::obb_points}) {
                if (layout == Layout::wide8 && bounds != Bounds::aabb) continue;
                CAPTURE(name(layout));
                CAPTURE(name(levels));
                CAPTURE(name(bounds));
                BuildOptions options;
                options.layout = layout;
                options.levels = levels;
                options.bounds.kind = bounds;
                const TreeImage image = download(device, build(device, scene, options));
                const std::vector<AnalysisTree> trees = analysis_trees(image, scene);
                REQUIRE(trees.size() == (levels == Levels::one ? 1 : 3));
                const AnalysisTree& main = trees[levels == Levels::one ? 0 : 1];
                CHECK(main.nodes[0].primitives == triangles + (levels == Levels::one ? 1 : 0));
                const Analysis result = analysis_of(main, measure_nodes(main, {}));
                CHECK(result.depth() == image.bottom_depth);
                CHECK(result.primitives == main.nodes[0].primitives);
                if (layout == Layout::binary) CHECK(result.all.nodes == 2 * result.primitives - 1);
                // A function of the caller's: nodes whose box reaches out of their parent's, and edges to wrong
                // parents.
                const auto outside = [&](const NodeView& node, std::size_t& sum) {
                    for (std::uint32_t i = 0; i < node.children(); ++i) {
                        const NodeView child = node.child(i);
                        if (child.parent().index != node.index || child.level() != node.level() + 1) ++sum;
                        for (int k = 0; k < 3; ++k)
                            if (bounds == Bounds::aabb &&
                                (child.box().min[k] < node.box().min[k] || child.box().max[k] > node.box().max[k]))
                                ++sum;
                    }
                };
                CHECK(analyze(main, std::size_t{0}, outside, [](std::size_t sum) { return sum; }) == 0);
                CHECK((bounds == Bounds::aabb) == main.corners.empty());
            }
        }
    }
    CHECK(analysis_trees(TreeImage{}, Scene{}).empty());
}

TEST_CASE("analysis: local trees hold the triangles of their areas, and cost what the areas' own rays pay in them") {
    Device& device = test_device();
    const Scene scene = scene_of({test::random_mesh(small_sizes() ? 60 : 600, 3, 1, 35)});
    InfluenceArea plane, point;
    plane.origin = {0, 0, 4};
    plane.half_width = 1.5;
    plane.far = 4;
    plane.share = 0.25;
    point.kind = AreaKind::point;
    point.origin = {0.5, 0, 0}; // within the boxes: what lies before near must not count
    point.direction = {-1, 0.25, 0};
    point.near = 0.75;
    point.far = 6;
    BuildOptions options;
    options.areas = {plane, point};
    const std::vector<InfluenceRecord> records = influence_records(options.areas);
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        CAPTURE(name(layout));
        options.layout = layout;
        BuildReport report;
        const TreeImage image = download(device, build(device, scene, options, &report));
        const std::vector<InfluenceRecord> stored = stored_areas(image);
        const std::vector<AnalysisTree> trees = analysis_trees(image, scene);
        REQUIRE(stored.size() == 2);
        REQUIRE(trees.size() == 3);
        CHECK(trees[0].nodes[0].primitives == scene.triangle_count());
        for (std::size_t i = 0; i < 2; ++i) {
            CAPTURE(i);
            CHECK(std::memcmp(&stored[i], &records[i], sizeof stored[i]) == 0);
            const AnalysisTree& tree = trees[i + 1];
            CHECK(tree.name == "local tree " + std::to_string(i));
            CHECK(tree.nodes[0].primitives == report.areas[i].triangles);
            CHECK(report.areas[i].triangles < scene.triangle_count());
            const Analysis result = analysis_of(tree, measure_nodes(tree, std::span(&stored[i], 1)));
            // A few hundred boxes, each seen by about a tenth of the rays: the sum strays by a few in a thousand.
            const double paid = mean_cost(tree, records[i], small_sizes() ? 8 : 60);
            CHECK(std::abs(result.all.pah_culled - paid) < (small_sizes() ? 0.3 : 0.03) * paid);
        }
    }
}

TEST_CASE("analysis: a topology down to marked leaves, and its SAH cost in one plain sum") {
    Device& device = test_device();
    const BuiltTrees empty = build_trees_of(device, Scene{});
    CHECK(analysis_tree(device, empty.trees.topology, empty.trees.volumes).nodes.empty());
    const BuiltTrees half = build_trees_of(device, scene_of({test::random_mesh(3, 3, 1, 34), Mesh{}}));
    CHECK(analysis_tree(device, half.trees.topology, half.trees.volumes, {}, 0).nodes.size() == 5);
    CHECK(analysis_tree(device, half.trees.topology, half.trees.volumes, {}, 1).nodes.empty());
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{small_sizes() ? 50u : 1000u}}) {
        CAPTURE(count);
        const BuiltTrees built = build_trees_of(device, scene_of({test::random_mesh(count, 3, 1, 34)}));
        const HostTopology& topology = built.topology;
        std::vector<std::uint32_t> marks(count);
        for (std::uint32_t i = 0; i + 1 < count; ++i) {
            const Span span = span_of(topology, i);
            marks[i] = span.last - span.first < 3;
        }
        const auto area = [&](std::uint32_t node) {
            const Aabb& box = built.volumes[node];
            const double x = double(box.max[0]) - box.min[0], y = double(box.max[1]) - box.min[1],
                         z = double(box.max[2]) - box.min[2];
            return x * y + y * z + z * x;
        };
        double sah = 0.0;
        std::uint64_t nodes = 0;
        std::vector<std::uint32_t> stack{topology.root(0)};
        while (!stack.empty()) {
            const std::uint32_t node = stack.back();
            stack.pop_back();
            ++nodes;
            const Span span = span_of(topology, node);
            const bool leaf = node >= count || marks[node];
            sah += area(node) / area(topology.root(0)) * (leaf ? 1.2 * (span.last - span.first + 1) : 2.0);
            if (!leaf)
                stack.insert(stack.end(), std::begin(topology.children[node].s), std::end(topology.children[node].s));
        }
        const AnalysisTree tree =
            analysis_tree(device, built.trees.topology, built.trees.volumes, upload(device, marks, "leaves").view());
        const Analysis result = analysis_of(tree, measure_nodes(tree, {}));
        CHECK(result.all.nodes == nodes);
        CHECK(result.primitives == count);
        CHECK(result.all.sah == doctest::Approx(sah));
        CHECK(result.leaves_by_size.size() <= 4);
    }
}

TEST_SUITE_END();
