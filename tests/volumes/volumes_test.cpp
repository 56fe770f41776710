// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "boxwood/volumes.hpp"
#include "build/trees.hpp"
#include "oracles/tree_checker.hpp"
#include "shared/types.h"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("volumes");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<Aabb> random_boxes(std::size_t count, std::uint64_t salt) {
    Random random(salt);
    std::vector<Aabb> boxes(count);
    for (Aabb& box : boxes) {
        for (int k = 0; k < 3; ++k) {
            box.min[k] = random.uniform(-100.0f, 1.0f);
            box.max[k] = box.min[k] + random.uniform(0.0f, 3.0f);
        }
    }
    return boxes;
}

bool equal(const Aabb& a, const Aabb& b) {
    return std::equal(a.min, a.min + 3, b.min) && std::equal(a.max, a.max + 3, b.max);
}

bool encloses(const Aabb& outer, const Aabb& inner) {
    for (int k = 0; k < 3; ++k)
        if (!(double(outer.min[k]) <= double(inner.min[k]) && double(inner.max[k]) <= double(outer.max[k])))
            return false;
    return true;
}

/// The hull of the primitives below `node`, one by one.
Aabb hull_below(const HostTopology& t, std::uint32_t node, const std::vector<Aabb>& boxes) {
    Aabb hull{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    const Span span = span_of(t, node);
    for (std::uint32_t i = span.first; i <= span.last; ++i) {
        for (int k = 0; k < 3; ++k) {
            hull.min[k] = std::min(hull.min[k], boxes[t.order[i]].min[k]);
            hull.max[k] = std::max(hull.max[k], boxes[t.order[i]].max[k]);
        }
    }
    return hull;
}

struct Built {
    HostTopology topology;
    std::vector<Aabb> volumes;
};

Built build(const std::vector<Aabb>& boxes, const std::vector<std::uint32_t>& offsets) {
    Device& device = test_device();
    const BinaryTrees trees = lbvh_trees(device, upload(device, boxes, "boxes"), offsets, MortonBits::bits30);
    return {to_host(device, trees.topology), download(device, trees.volumes)};
}

void check(const std::vector<Aabb>& boxes, const std::vector<std::uint32_t>& offsets) {
    const Built built = build(boxes, offsets);
    const HostTopology& t = built.topology;
    REQUIRE(built.volumes.size() == 2 * boxes.size());
    const Aabb empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    std::size_t wrong = 0, outside = 0;
    for (std::uint32_t node = 0; node < 2 * t.size(); ++node) {
        const bool unused = std::find(offsets.begin() + 1, offsets.end(), node + 1) != offsets.end();
        const Aabb expected = node < t.size() && unused ? empty : hull_below(t, node, boxes);
        if (!equal(built.volumes[node], expected)) ++wrong;
    }
    for (std::uint32_t i = 0; i < t.size(); ++i)
        for (std::uint32_t node = t.size() + i; node != BOXWOOD_NONE; node = t.parents[node])
            if (!encloses(built.volumes[node], boxes[t.order[i]])) ++outside;
    CHECK(wrong == 0);
    CHECK(outside == 0);
}

} // namespace

TEST_CASE("volumes: each node's box is the exact hull of what lies below, unused slots are empty") {
    // Around a slice of 256, and one, two and three primitives.
    for (const std::uint32_t count : {1u, 2u, 3u, 255u, 256u, 257u, 3001u}) {
        CAPTURE(count);
        check(random_boxes(count, count), {0, count});
    }
    check(random_boxes(1500, 1), {0, 1, 2, 700, 701, 956, 957, 1499, 1500});
    check(std::vector<Aabb>(1000, Aabb{{1, 2, 3}, {1, 2, 3}}), {0, 1000});
}

TEST_CASE("volumes: every tuning gives the same bytes") {
    Device& device = test_device();
    const std::vector<Aabb> boxes = random_boxes(5003, 2);
    const Buffer<Aabb> buffer = upload(device, boxes, "boxes");
    for (const std::vector<std::uint32_t>& offsets :
         {std::vector<std::uint32_t>{0, 5003}, std::vector<std::uint32_t>{0, 1, 300, 301, 2000, 5002, 5003}}) {
        const BinaryTrees trees = lbvh_trees(device, buffer, offsets, MortonBits::bits30);
        const std::vector<Aabb> expected = download(device, trees.volumes);
        for (const Tuning& tuning : tunings()) {
            CAPTURE(tuning.group_size);
            const TuningScope scope(tuning);
            CHECK(same_bits(download(device, aabb_volumes(device, trees.topology, buffer)), expected));
        }
    }
}
