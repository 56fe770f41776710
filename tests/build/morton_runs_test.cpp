// SPDX-License-Identifier: MIT
// Codes within long runs of equal codes, against codes in double precision. All centres are multiples of powers of two
// in cubes whose sides are powers of two, so that every code is exact in float too.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/glm.hpp>

#include "boxwood/radix_sort.hpp"
#include "build/lbvh.hpp"
#include "build/morton_runs.hpp"
#include "oracles/tree_checker.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

/// Boxes of several trees, each within the unit cube, which the first codes are relative to.
struct Boxes {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> offsets{0};

    void close_tree() { offsets.push_back(static_cast<std::uint32_t>(boxes.size())); }
    /// A box around a centre; `half` its half width.
    void add(glm::dvec3 centre, double half = 0.0) {
        Aabb box;
        for (int k = 0; k < 3; ++k) {
            box.min[k] = static_cast<float>(centre[k] - half);
            box.max[k] = static_cast<float>(centre[k] + half);
        }
        boxes.push_back(box);
    }
    /// `count` centres on a lattice of 1/1024 of the side, two of them the cube's corners.
    void add_cluster(Random& random, glm::dvec3 low, double side, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::dvec3 cell(random.below(1024), random.below(1024), random.below(1024));
            const glm::dvec3 place = i == 0 ? glm::dvec3(0.0) : i == 1 ? glm::dvec3(1024.0) : cell;
            add(low + place * (side / 1024), i % 3 == 0 ? 0.0 : side / 1024);
        }
    }
};

constexpr double cell = 0x1p-10;

/// What runs look like: none, one below the length that counts, of that length, longer; without extent; nested.
Boxes clustered(Random& random, std::uint32_t scale) {
    Boxes b;
    b.add_cluster(random, glm::dvec3(0.0), 1.0, 40 * scale);
    for (std::uint32_t i = 0; i < long_run - 1; ++i)
        b.add(glm::dvec3(5, 5, 5) * cell + glm::dvec3(0.5 * cell * (i % 2)));
    b.add_cluster(random, glm::dvec3(7, 300, 90) * cell, 0.5 * cell, long_run);
    b.add_cluster(random, glm::dvec3(8, 300, 90) * cell, 0.25 * cell, 30 * scale);
    b.close_tree();
    b.add({0.25, 0.5, 0.75});
    b.close_tree();
    for (std::uint32_t i = 0; i < 25; ++i) b.add(glm::dvec3(0.5), 0.125 * (i % 3)); // nothing parts these
    b.close_tree();
    // Each in the first cell of the one before; the last is of coincident centres.
    double side = 1.0;
    for (std::uint32_t depth = 0; depth < 4; ++depth) {
        b.add_cluster(random, glm::dvec3(0.0), side, 20 * scale);
        side *= 0.5 * cell;
    }
    for (std::uint32_t i = 0; i < 3 * long_run; ++i) b.add(glm::dvec3(0.0));
    b.close_tree();
    return b;
}

/// x, y, z bit by bit, x highest.
std::uint64_t interleave(const glm::dvec3& place, int axis_bits) {
    std::uint64_t code = 0;
    const double most = std::ldexp(1.0, axis_bits) - 1;
    for (int bit = axis_bits - 1; bit >= 0; --bit)
        for (int k = 0; k < 3; ++k)
            code = code << 1 | (static_cast<std::uint64_t>(std::min(std::floor(place[k]), most)) >> bit & 1);
    return code;
}

/// Sorts primitives from the definition, run by run and depth first, and notes the gaps.
struct Reference {
    const std::vector<Aabb>& boxes;
    std::vector<std::uint32_t> order{};
    std::vector<std::uint64_t> gaps{};

    glm::dvec3 centre(std::uint32_t primitive) const {
        const Aabb& b = boxes[primitive];
        return 0.5 * (glm::dvec3(b.min[0], b.min[1], b.min[2]) + glm::dvec3(b.max[0], b.max[1], b.max[2]));
    }

    /// Puts `primitives`, in the order so far, at the end of `order`, by codes in the cube at `low`.
    void sort(std::vector<std::uint32_t> primitives, glm::dvec3 low, double side, int axis_bits, std::uint64_t round) {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> coded;
        for (const std::uint32_t p : primitives)
            coded.emplace_back(interleave((centre(p) - low) * (std::ldexp(1.0, axis_bits) / side), axis_bits), p);
        const auto by_code = [](const auto& a, const auto& b) { return a.first < b.first; };
        std::stable_sort(coded.begin(), coded.end(), by_code);
        const bool parted = coded.front().first != coded.back().first;
        for (std::size_t i = 0, end; i < coded.size(); i = end) {
            for (end = i; end < coded.size() && coded[end].first == coded[i].first;) ++end;
            std::vector<std::uint32_t> run;
            for (std::size_t k = i; k < end; ++k) run.push_back(coded[k].second);
            place_run(std::move(run), parted || round == 0, round);
            if (end < coded.size())
                gaps.back() = 1000 * (100 - round) + std::bit_width(coded[end].first ^ coded[i].first);
        }
    }

    void place_run(std::vector<std::uint32_t> run, bool again, std::uint64_t round) {
        if (run.size() >= long_run && again) {
            glm::dvec3 low = centre(run[0]), high = low;
            for (const std::uint32_t p : run) {
                low = glm::min(low, centre(p));
                high = glm::max(high, centre(p));
            }
            const glm::dvec3 extent = high - low;
            const double side = std::max({extent.x, extent.y, extent.z});
            if (side > 0.0) return sort(std::move(run), low, side, 10, round + 1);
        }
        for (const std::uint32_t p : run) {
            const auto position = static_cast<std::uint32_t>(order.size());
            order.push_back(p);
            gaps.push_back(static_cast<std::uint64_t>(std::bit_width(position ^ (position + 1))));
        }
    }
};

HostTopology reference(const Boxes& b, int axis_bits) {
    Reference sorted{b.boxes};
    for (std::size_t tree = 0; tree + 1 < b.offsets.size(); ++tree) {
        std::vector<std::uint32_t> primitives(b.offsets[tree + 1] - b.offsets[tree]);
        std::iota(primitives.begin(), primitives.end(), b.offsets[tree]);
        sorted.sort(std::move(primitives), glm::dvec3(0.0), 1.0, axis_bits, 0);
    }
    return reference_topology_of_gaps(sorted.gaps, std::move(sorted.order), b.offsets);
}

/// The trees of the device. `untouched` is set when no run was parted.
template <class Key>
HostTopology run(const Boxes& b, KeyFormat format, bool* untouched = nullptr) {
    Device& device = test_device();
    const Buffer<Aabb> boxes = upload(device, b.boxes, "boxes");
    Buffer<std::uint32_t> offsets = upload(device, b.offsets, "offsets");
    const std::vector<Aabb> unit(b.offsets.size() - 1, {{0, 0, 0}, {1, 1, 1}});
    Guarded<Key> keys(device, b.boxes.size());
    Guarded<std::uint32_t> guarded(device, b.boxes.size());
    morton_keys(device, boxes, offsets, upload(device, unit, "bounds"), format, keys.view(), guarded.view());
    radix_sort(device, keys.view(), guarded.view(), 0, format.key_bits);
    Buffer<Gap> gaps = key_gaps<Key>(device, keys.view(), format, unit.size());
    const std::vector<std::uint32_t> order_before = guarded.values();
    const std::vector<Gap> gaps_before = download(device, gaps);
    partition_long_runs<Key>(device, boxes, keys.view(), format, offsets, guarded.view(), gaps);
    CHECK(guarded.intact());
    if (untouched) *untouched = guarded.values() == order_before && download(device, gaps) == gaps_before;
    Buffer<std::uint32_t> order = upload(device, guarded.values(), "order");
    return to_host(device, radix_trees(device, gaps, std::move(order), std::move(offsets)));
}

Boxes one_tree(Boxes b, std::size_t tree) {
    const auto begin = b.boxes.begin() + b.offsets[tree], end = b.boxes.begin() + b.offsets[tree + 1];
    return {{begin, end}, {0, b.offsets[tree + 1] - b.offsets[tree]}};
}

} // namespace

TEST_CASE("morton_runs: codes of their own, in every tree of a forest, at every tuning") {
    Random random(1);
    const Boxes forest = clustered(random, small_sizes() ? 1 : 10);
    std::vector<Tuning> cuts = tunings();
    cuts.push_back({1, 1000, 1}); // slices shorter than a long run
    for (const MortonBits bits : {MortonBits::bits30, MortonBits::bits63}) {
        const KeyFormat format = key_format(bits, forest.offsets.size() - 1);
        const HostTopology expected = reference(forest, format.code_bits / 3);
        for (const Tuning& tuning : cuts) {
            CAPTURE(tuning.group_size);
            CAPTURE(tuning.work_items);
            const TuningScope scope(tuning);
            bool untouched = true;
            CHECK(difference(run<std::uint64_t>(forest, format, &untouched), expected) == "");
            CHECK(!untouched);
        }
    }
}

TEST_CASE("morton_runs: each tree by itself, with short keys") {
    Random random(2);
    const Boxes forest = clustered(random, small_sizes() ? 1 : 10);
    const KeyFormat format = key_format(MortonBits::bits30, 1);
    for (std::size_t tree = 0; tree + 1 < forest.offsets.size(); ++tree) {
        CAPTURE(tree);
        const Boxes alone = one_tree(forest, tree);
        CHECK(difference(run<std::uint32_t>(alone, format), reference(alone, 10)) == "");
    }
}

TEST_CASE("morton_runs: order and gaps are left alone where no run is long, or nothing parts it") {
    const KeyFormat format = key_format(MortonBits::bits30, 1);
    const std::uint32_t few[] = {0, 1, 2, long_run - 1, long_run, 4 * long_run};
    for (const std::uint32_t count : few) {
        CAPTURE(count);
        Boxes same, apart;
        for (std::uint32_t i = 0; i < count; ++i) {
            same.add(glm::dvec3(0.5), 0.25 * (i % 2));
            // As many as may share a cell, cell by cell.
            apart.add(glm::dvec3(i / (long_run - 1) * cell + i % (long_run - 1) * 0x1p-14));
        }
        for (Boxes* boxes : {&same, &apart}) {
            boxes->close_tree();
            bool untouched = false;
            const HostTopology topology = run<std::uint32_t>(*boxes, format, &untouched);
            CHECK(untouched);
            if (count > 0) CHECK(difference(topology, reference(*boxes, 10)) == "");
        }
    }
}

TEST_CASE("morton_runs: denormal centres end") {
    // Their halves round, so that codes may not part what differs.
    Boxes b;
    for (std::uint32_t i = 0; i < 40; ++i) b.add(glm::dvec3(0x1p-149 * (3 + i % 2), 0x1p-149 * (i % 5), 0.0));
    b.add(glm::dvec3(1.0));
    b.close_tree();
    const HostTopology topology = run<std::uint32_t>(b, key_format(MortonBits::bits30, 1));
    std::vector<std::uint32_t> order = topology.order;
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < order.size(); ++i) CHECK(order[i] == i);
}
