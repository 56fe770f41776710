// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "boxwood/morton.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

constexpr MortonBits both[] = {MortonBits::bits30, MortonBits::bits63};

/// x, y, z bit by bit, x highest.
std::uint64_t interleave(const std::uint64_t (&cells)[3], int axis_bits) {
    std::uint64_t key = 0;
    for (int bit = axis_bits - 1; bit >= 0; --bit)
        for (const std::uint64_t cell : cells) key = key << 1 | (cell >> bit & 1);
    return key;
}

std::uint64_t deinterleave(std::uint64_t key, int axis, int axis_bits) {
    std::uint64_t cell = 0;
    for (int bit = axis_bits - 1; bit >= 0; --bit) cell = cell << 1 | (key >> (3 * bit + 2 - axis) & 1);
    return cell;
}

struct Keys {
    std::vector<std::uint64_t> keys;
    std::vector<std::uint32_t> order;
};

template <class Key>
Keys run(const std::vector<Aabb>& boxes, const std::vector<std::uint32_t>& offsets, const std::vector<Aabb>& bounds,
         KeyFormat format) {
    Device& device = test_device();
    Guarded<Key> keys(device, boxes.size());
    Guarded<std::uint32_t> order(device, boxes.size());
    morton_keys(device, upload(device, boxes, "boxes"), upload(device, offsets, "offsets"),
                upload(device, bounds, "bounds"), format, keys.view(), order.view());
    CHECK(keys.intact());
    CHECK(order.intact());
    const std::vector<Key> values = keys.values();
    return {{values.begin(), values.end()}, order.values()};
}

Keys run_one(const std::vector<Aabb>& boxes, const Aabb& bounds, MortonBits bits) {
    const std::vector<std::uint32_t> offsets{0, static_cast<std::uint32_t>(boxes.size())};
    const KeyFormat format = key_format(bits, 1);
    return bits == MortonBits::bits30 ? run<std::uint32_t>(boxes, offsets, {bounds}, format)
                                      : run<std::uint64_t>(boxes, offsets, {bounds}, format);
}

Aabb hull(const std::vector<Aabb>& boxes) {
    Aabb all = boxes[0];
    for (const Aabb& box : boxes) {
        for (int k = 0; k < 3; ++k) {
            all.min[k] = std::min(all.min[k], box.min[k]);
            all.max[k] = std::max(all.max[k], box.max[k]);
        }
    }
    return all;
}

std::vector<Aabb> random_boxes(std::size_t count, float low, float high, std::uint64_t salt) {
    Random random(salt);
    std::vector<Aabb> boxes(count);
    for (Aabb& box : boxes) {
        for (int k = 0; k < 3; ++k) {
            const float a = random.uniform(low, high), b = random.uniform(low, high);
            box.min[k] = std::min(a, b);
            box.max[k] = std::max(a, b);
        }
    }
    return boxes;
}

/// The cube [low, low + 2^exponent], and boxes whose centres are the middles of random cells: exact in float.
struct Lattice {
    std::vector<Aabb> boxes;
    std::vector<std::uint64_t> keys;
    Aabb bounds;
};

Lattice lattice(int axis_bits, float low, std::uint64_t salt) {
    Random random(salt);
    const std::uint32_t cells = 1u << axis_bits;
    const float width = 1.0f / static_cast<float>(cells);
    Lattice result{{}, {}, {{low, low, low}, {low + 1, low + 1, low + 1}}};
    for (int i = 0; i < 700; ++i) {
        std::uint64_t cell[3];
        Aabb box;
        for (int k = 0; k < 3; ++k) {
            cell[k] = i == 0 ? 0 : i == 1 ? cells - 1 : random.below(cells);
            const float centre = low + (static_cast<float>(cell[k]) + 0.5f) * width;
            box.min[k] = centre - 0.25f * static_cast<float>(i % 3);
            box.max[k] = centre + 0.25f * static_cast<float>(i % 3);
        }
        result.boxes.push_back(box);
        result.keys.push_back(interleave(cell, axis_bits));
    }
    return result;
}

} // namespace

TEST_CASE("morton: the middle of every cell has the cell's code") {
    for (const MortonBits bits : both) {
        const int axis_bits = static_cast<int>(bits) / 3;
        for (const float low : {0.0f, -0.5f, -1.0f}) {
            CAPTURE(axis_bits);
            CAPTURE(low);
            const Lattice cells = lattice(axis_bits, low, 1);
            const Keys got = run_one(cells.boxes, cells.bounds, bits);
            CHECK(got.keys == cells.keys);
            std::vector<std::uint32_t> identity(cells.boxes.size());
            std::iota(identity.begin(), identity.end(), 0u);
            CHECK(got.order == identity);
        }
    }
}

TEST_CASE("morton: the cell of any centre, to the rounding of floats") {
    const std::vector<Aabb> boxes = random_boxes(5000, -3.0f, 5.0f, 2);
    const Aabb bounds = hull(boxes);
    double side = 0.0;
    for (int k = 0; k < 3; ++k) side = std::max(side, double(bounds.max[k]) - bounds.min[k]);
    for (const MortonBits bits : both) {
        const int axis_bits = static_cast<int>(bits) / 3;
        // Centre, difference, quotient and product each round once, by 2^-24 of at most the side.
        const double rounding = 4.0 * std::ldexp(1.0, axis_bits - 24);
        const Keys got = run_one(boxes, bounds, bits);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const double centre = 0.5 * (double(boxes[i].min[axis]) + boxes[i].max[axis]);
                const double place = std::ldexp((centre - bounds.min[axis]) / side, axis_bits);
                const auto cell = double(deinterleave(got.keys[i], axis, axis_bits));
                if (place < cell - rounding || place > cell + 1.0 + rounding) ++wrong;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("morton: the upper corner stays inside the last cell, a point and a plane in the first") {
    for (const MortonBits bits : both) {
        const int axis_bits = static_cast<int>(bits) / 3;
        const std::uint64_t most = (std::uint64_t(1) << (3 * axis_bits)) - 1;
        const Aabb corner{{3, 3, 3}, {3, 3, 3}}, cube{{1, 1, 1}, {3, 3, 3}};
        CHECK(run_one({corner}, cube, bits).keys[0] == most);

        const std::vector<Aabb> points(300, corner);
        CHECK(run_one(points, corner, bits).keys == std::vector<std::uint64_t>(300, 0));

        std::vector<Aabb> plane = random_boxes(300, -1.0f, 1.0f, 3);
        for (Aabb& box : plane) box.min[1] = box.max[1] = 0.75f;
        const Keys flat = run_one(plane, hull(plane), bits);
        bool spread = false;
        for (const std::uint64_t key : flat.keys) {
            CHECK(deinterleave(key, 1, axis_bits) == 0);
            spread = spread || deinterleave(key, 0, axis_bits) > 0;
        }
        CHECK(spread);
    }
}

TEST_CASE("morton: scaled by a power of two, the same bits") {
    const std::vector<Aabb> boxes = random_boxes(1000, -1.0f, 1.0f, 4);
    for (const MortonBits bits : both) {
        const Keys expected = run_one(boxes, hull(boxes), bits);
        // -110: a cell is 2^-130, of which the reciprocal is no float. 60: the largest coordinate.
        for (const int k : {-110, -40, -39, -7, -1, 1, 8, 33, 40, 60}) {
            CAPTURE(k);
            std::vector<Aabb> scaled = boxes;
            for (Aabb& box : scaled) {
                for (float& x : box.min) x = std::ldexp(x, k);
                for (float& x : box.max) x = std::ldexp(x, k);
            }
            CHECK(run_one(scaled, hull(scaled), bits).keys == expected.keys);
        }
    }
}

TEST_CASE("morton: subnormal coordinates keep their order") {
    std::vector<Aabb> points;
    for (int i = 1; i <= 100; ++i) {
        const float x = std::ldexp(static_cast<float>(i), -149);
        points.push_back({{x, 0, 0}, {x, 0, 0}});
    }
    for (const MortonBits bits : both) {
        const Keys got = run_one(points, hull(points), bits);
        CHECK(std::is_sorted(got.keys.begin(), got.keys.end()));
    }
}

TEST_CASE("morton: in a forest each tree has its own cube, and stands above the code") {
    std::vector<std::uint32_t> offsets{0};
    std::vector<Aabb> boxes, bounds;
    std::vector<std::uint64_t> expected;
    const std::uint32_t sizes[] = {1, 700, 1, 2, 255, 256, 257, 3, 1};
    for (const MortonBits bits : both) {
        offsets = {0}, boxes.clear(), bounds.clear(), expected.clear();
        const KeyFormat format = key_format(bits, std::size(sizes));
        for (std::size_t tree = 0; tree < std::size(sizes); ++tree) {
            const Lattice own = lattice(format.code_bits / 3, -static_cast<float>(tree % 2), 10 + tree);
            bounds.push_back(own.bounds);
            for (std::uint32_t i = 0; i < sizes[tree]; ++i) {
                boxes.push_back(own.boxes[i]);
                expected.push_back(own.keys[i] | std::uint64_t(tree) << format.code_bits);
            }
            offsets.push_back(static_cast<std::uint32_t>(boxes.size()));
        }
        CHECK(run<std::uint64_t>(boxes, offsets, bounds, format).keys == expected);
        if (bits == MortonBits::bits63) continue;
        for (const Tuning& tuning : tunings()) {
            const TuningScope scope(tuning);
            CHECK(run<std::uint64_t>(boxes, offsets, bounds, format).keys == expected);
        }
    }
}

TEST_CASE("morton: key_format gives each axis what the trees leave of 64 bits") {
    const auto same = [](KeyFormat format, int code_bits, int key_bits) {
        return format.code_bits == code_bits && format.key_bits == key_bits;
    };
    constexpr std::size_t one = 1;
    CHECK(same(key_format(MortonBits::bits30, 1), 30, 30));
    CHECK(same(key_format(MortonBits::bits30, 2), 30, 31));
    CHECK(same(key_format(MortonBits::bits30, 3), 30, 32));
    CHECK(same(key_format(MortonBits::bits30, 4), 30, 32));
    CHECK(same(key_format(MortonBits::bits30, 5), 30, 33));
    CHECK(same(key_format(MortonBits::bits30, one << 30), 30, 60));
    CHECK(same(key_format(MortonBits::bits30, one << 34), 30, 64));
    CHECK(same(key_format(MortonBits::bits30, (one << 34) + 1), 27, 62));
    CHECK(same(key_format(MortonBits::bits63, 1), 63, 63));
    CHECK(same(key_format(MortonBits::bits63, 2), 63, 64));
    CHECK(same(key_format(MortonBits::bits63, 3), 60, 62));
    CHECK(same(key_format(MortonBits::bits63, 16), 60, 64));
    CHECK(same(key_format(MortonBits::bits63, 17), 57, 62));
    CHECK(same(key_format(MortonBits::bits63, 1000), 54, 64));
    CHECK(same(key_format(MortonBits::bits63, 1000000), 42, 62));
}
