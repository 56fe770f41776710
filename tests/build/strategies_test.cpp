// SPDX-License-Identifier: MIT
// The strategies for influence areas: no plane that a node could have been split by is better, by chances in double
// precision.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "boxwood/analysis.hpp"
#include "boxwood/influence.hpp"
#include "boxwood/topdown.hpp"
#include "build/built_trees.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
const Aabb empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

Aabb hull(Aabb a, const Aabb& b) {
    for (int k = 0; k < 3; ++k) {
        a.min[k] = std::min(a.min[k], b.min[k]);
        a.max[k] = std::max(a.max[k], b.max[k]);
    }
    return a;
}

Aabb shared(Aabb a, const Aabb& b) {
    for (int k = 0; k < 3; ++k) {
        a.min[k] = std::max(a.min[k], b.min[k]);
        a.max[k] = std::min(a.max[k], b.max[k]);
        if (!(a.min[k] <= a.max[k])) return empty;
    }
    return a;
}

InfluenceArea oblique_plane() {
    return {.kind = AreaKind::plane,
            .origin = {6.0, 5.0, 7.0},
            .direction = {-1.0, -0.4, -0.7},
            .half_width = 5.0,
            .half_height = 3.0,
            .far = 30.0,
            .share = 0.5};
}

InfluenceArea near_point() {
    return {.kind = AreaKind::point,
            .origin = {0.0, 1.0, 9.0},
            .direction = {0.1, 0.0, -1.0},
            .half_width = 0.4,
            .half_height = 0.6,
            .near = 0.5,
            .far = 20.0,
            .share = 0.25};
}

/// Probabilities in double precision, by the analyser, of many boxes at once.
struct Probabilities {
    std::vector<InfluenceRecord> areas;
    AnalysisTree boxes; ///< The first is the root.
    std::vector<double> projected, expected;

    std::size_t add(const Aabb& box) {
        boxes.nodes.push_back({box, 0, BOXWOOD_NONE, 0, 0, 1});
        return boxes.nodes.size() - 1;
    }
    void measure() {
        // A chain: nodes are measured from their parents.
        for (std::uint32_t i = 1; i < boxes.nodes.size(); ++i) {
            boxes.nodes[i - 1].first_child = i;
            boxes.nodes[i - 1].children = 1;
        }
        const std::vector<NodeMeasures> surface = measure_nodes(boxes, {});
        projected.assign(boxes.nodes.size(), 0.0);
        expected = projected;
        double shares = 0.0;
        for (const InfluenceRecord& area : areas) {
            InfluenceRecord alone = area;
            alone.share = 1.0f;
            const std::vector<NodeMeasures> own = measure_nodes(boxes, std::vector{alone});
            for (std::size_t i = 0; i < own.size(); ++i) projected[i] += double(area.share) * own[i].probability_culled;
            shares += area.share;
        }
        for (std::size_t i = 0; i < expected.size(); ++i) {
            expected[i] = projected[i] + (1.0 - shares) * surface[i].surface;
            projected[i] /= shares;
        }
    }
};

/// A way to split one node: indices into Probabilities, and the counts.
struct Candidate {
    int axis;
    std::size_t left, right, shared;
    std::uint32_t left_count, right_count;
};

struct Case {
    TopDownOptions options;
    bool expected = false; ///< Probabilities by expected_measure, else by projected_measure.
    bool overlap = false;
    std::function<int(const Aabb&)> axis = {}; ///< The only axis to try, or none.
};

struct Node {
    std::uint32_t first, last;
    std::uint32_t middle; ///< First position of the right child.
};

/// Every plane between bins of the centres' box, as cl/build/split.h has them.
std::vector<Candidate> candidates_of(const std::vector<Aabb>& below, const Case& which, Probabilities& probabilities) {
    std::vector<Candidate> candidates;
    Aabb box = empty;
    for (const Aabb& each : below) box = hull(box, each);
    const int bins = static_cast<int>(
        std::min<std::size_t>(which.options.bins, 4 + below.size() / which.options.primitives_per_bin));
    for (int axis = 0; axis < 3; ++axis) {
        if (which.axis && which.axis(box) != axis) continue;
        float low = infinity, high = -infinity;
        const auto centre = [&](const Aabb& b) { return 0.5f * b.min[axis] + 0.5f * b.max[axis]; };
        for (const Aabb& each : below) {
            low = std::min(low, centre(each));
            high = std::max(high, centre(each));
        }
        const float scale = static_cast<float>(bins) / (high - low);
        for (int plane = 1; plane < bins; ++plane) {
            Aabb left = empty, right = empty;
            std::uint32_t left_count = 0;
            for (const Aabb& each : below) {
                const bool goes_left = std::min(static_cast<int>((centre(each) - low) * scale), bins - 1) < plane;
                left_count += goes_left ? 1 : 0;
                (goes_left ? left : right) = hull(goes_left ? left : right, each);
            }
            const auto right_count = static_cast<std::uint32_t>(below.size()) - left_count;
            if (left_count == 0 || right_count == 0) continue;
            const Aabb both = shared(left, right);
            const std::size_t none = std::numeric_limits<std::size_t>::max();
            candidates.push_back({axis, probabilities.add(left), probabilities.add(right),
                                  both.min[0] <= both.max[0] ? probabilities.add(both) : none, left_count,
                                  right_count});
        }
    }
    return candidates;
}

double cost_of(const Candidate& c, const Case& which, const Probabilities& probabilities) {
    const std::vector<double>& probability = which.expected ? probabilities.expected : probabilities.projected;
    double cost = probability[c.left] * c.left_count + probability[c.right] * c.right_count;
    if (which.overlap && c.shared < probability.size())
        cost += 0.25 * probability[c.shared] * std::min(c.left_count, c.right_count);
    return cost;
}

/// Nodes of a tree whose split is dearer than another by more than roundings, or is none of the planes.
int poor_splits(const Case& which, std::uint64_t salt) {
    Device& device = test_device();
    const Mesh mesh = random_mesh(small_sizes() ? 40 : 300, 3.0f, 0.4f, salt);
    std::vector<Aabb> boxes;
    for (const glm::uvec3& triangle : mesh.triangles) boxes.push_back(box_of(mesh, triangle));
    const auto count = static_cast<std::uint32_t>(boxes.size());
    const std::vector<InfluenceRecord> areas = influence_records(std::vector{oblique_plane(), near_point()});
    const TopDownTree tree =
        topdown(device, upload(device, boxes, "boxes"), {}, upload(device, std::vector{0u, count}, "offsets"),
                upload(device, areas, "areas"), upload(device, std::vector{0u, 2u}, "area starts"), which.options);
    const HostTopology topology = to_host(device, tree.topology);

    int poor = 0;
    for (std::uint32_t node = 0; node + 1 < count; ++node) {
        const Span span = span_of(topology, node);
        std::vector<Aabb> below;
        for (std::uint32_t i = span.first; i <= span.last; ++i) below.push_back(boxes[topology.order[i]]);
        if (below.size() < 3) continue;
        Probabilities probabilities{areas, {}, {}, {}};
        Aabb root = empty;
        for (const Aabb& box : boxes) root = hull(root, box);
        probabilities.add(root);
        const std::vector<Candidate> candidates = candidates_of(below, which, probabilities);
        probabilities.measure();
        const std::uint32_t left_count = span_of(topology, topology.children[node].s[0]).last + 1 - span.first;
        double least = infinity, own = infinity;
        for (const Candidate& candidate : candidates) {
            const double cost = cost_of(candidate, which, probabilities);
            least = std::min(least, cost);
            // The plane that was taken, or another with as many on the left, which then must be as good.
            if (candidate.left_count == left_count) own = std::min(own, cost);
        }
        if (!(own <= least * (1.0 + 1e-4))) ++poor; // probabilities are good to 1e-5, see projected_area.h
    }
    return poor;
}

/// One tree of a forest as if it were alone.
HostTopology tree_of(const HostTopology& all, std::uint32_t which) {
    const std::uint32_t first = all.offsets[which], size = all.offsets[which + 1] - first;
    const auto moved = [&](std::uint32_t node) {
        if (node == BOXWOOD_NONE) return node;
        return node < all.size() ? node - first : node - all.size() - first + size;
    };
    HostTopology tree{{0, size}, {}, {}, {}, {}};
    for (std::uint32_t i = first; i < first + size; ++i) {
        tree.order.push_back(all.order[i] - first);
        tree.children.push_back(cl_uint2{{moved(all.children[i].s[0]), moved(all.children[i].s[1])}});
        tree.parents.push_back(moved(all.parents[i]));
        tree.far_ends.push_back(all.far_ends[i] - first);
    }
    for (std::uint32_t i = first; i < first + size; ++i) tree.parents.push_back(moved(all.parents[all.size() + i]));
    return tree;
}

TopDownOptions all_splits() {
    TopDownOptions options;
    options.axes = "all_axes";
    options.stop = "never";
    return options;
}

} // namespace

TEST_CASE("strategies: splits by projected and by expected probabilities, with and without overlap") {
    for (const bool overlap : {false, true}) {
        Case which{.options = all_splits(), .overlap = overlap};
        which.options.cost = overlap ? "overlap_cost" : "measured_cost";
        which.options.measure = "projected_measure";
        CHECK(poor_splits(which, 1) == 0);
        which.expected = true;
        which.options.measure = "expected_measure";
        CHECK(poor_splits(which, 2) == 0);
    }
}

TEST_CASE("strategies: planes that the rays see edge-on come first") {
    Case which{.options = all_splits()};
    which.options.measure = "projected_measure";
    which.options.axes = "facing_axes";
    which.options.split_plane_quality = 0.0f;
    which.options.excellent_children = 1e30f; // what the first axis gives is good
    const InfluenceArea plane = oblique_plane(), point = near_point();
    which.axis = [&](const Aabb& box) {
        glm::dvec3 facing(0.0);
        for (const InfluenceArea& area : {plane, point}) {
            glm::dvec3 way = area.direction;
            if (area.kind == AreaKind::point)
                for (int k = 0; k < 3; ++k) way[k] = 0.5 * (double(box.min[k]) + box.max[k]) - area.origin[k];
            const glm::dvec3 size = glm::abs(way);
            facing += *area.share * size / (size.x + size.y + size.z);
        }
        int best = 0;
        for (int k = 1; k < 3; ++k)
            if (facing[k] < facing[best]) best = k;
        return best;
    };
    CHECK(poor_splits(which, 3) == 0);
}

TEST_CASE("strategies: each tree of a forest is that of its own rays") {
    Device& device = test_device();
    const std::uint32_t large = small_sizes() ? 70 : 400; // above and below the 64 primitives of large nodes
    const std::vector<std::uint32_t> sizes{large, 1, large, 40, large}, starts{0, 0, 2, 4, 4, 5};
    InfluenceArea other = oblique_plane();
    other.direction = {0.2, -1.0, 0.1};
    other.share = 0.125;
    const std::vector<InfluenceRecord> two = influence_records(std::vector{oblique_plane(), near_point()});
    const std::vector<InfluenceRecord> one = influence_records(std::vector{other});
    const std::vector<InfluenceRecord> areas{two[0], one[0], two[0], two[1], one[0]};
    TopDownOptions options = all_splits();
    options.measure = "expected_measure";
    options.cost = "overlap_cost";
    options.axes = "facing_axes";
    const auto built = [&](const std::vector<Aabb>& boxes, const std::vector<std::uint32_t>& offsets,
                           const std::vector<InfluenceRecord>& rays, const std::vector<std::uint32_t>& ray_starts) {
        return to_host(device, topdown(device, upload(device, boxes, "boxes"), {}, upload(device, offsets, "offsets"),
                                       upload(device, rays, "areas"), upload(device, ray_starts, "starts"), options)
                                   .topology);
    };
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> offsets{0};
    for (const std::uint32_t size : sizes) { // the same triangles in each
        const Mesh mesh = random_mesh(size, 3.0f, 0.4f, 5);
        for (const glm::uvec3& triangle : mesh.triangles) boxes.push_back(box_of(mesh, triangle));
        offsets.push_back(static_cast<std::uint32_t>(boxes.size()));
    }
    const HostTopology all = built(boxes, offsets, areas, starts);
    for (std::uint32_t t = 0; t < sizes.size(); ++t) {
        CAPTURE(t);
        const HostTopology alone =
            built({boxes.begin() + offsets[t], boxes.begin() + offsets[t + 1]}, {0, sizes[t]},
                  {areas.begin() + starts[t], areas.begin() + starts[t + 1]}, {0, starts[t + 1] - starts[t]});
        CHECK(difference(tree_of(all, t), alone) == "");
    }
    CHECK(difference(tree_of(all, 0), tree_of(all, 2)) != "");
    CHECK(difference(tree_of(all, 2), tree_of(all, 4)) != "");
}

TEST_SUITE_END();
