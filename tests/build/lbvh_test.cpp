// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "boxwood/lbvh.hpp"
#include "oracles/tree_checker.hpp"
#include "shared/types.h"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

constexpr KeyFormat one_tree_30{30, 30};
constexpr KeyFormat one_tree_63{63, 63};

std::vector<std::uint32_t> identity(std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

/// Sorted keys of a forest: `codes` sorted within each tree, below the tree's index.
struct Input {
    std::vector<std::uint64_t> keys;
    std::vector<std::uint32_t> offsets;
    KeyFormat format = one_tree_30;
};

Input one_tree(std::vector<std::uint64_t> keys, KeyFormat format) {
    std::sort(keys.begin(), keys.end());
    const auto count = static_cast<std::uint32_t>(keys.size());
    return {std::move(keys), {0, count}, format};
}

/// `distinct` different codes: few give many duplicates.
std::vector<std::uint64_t> random_codes(std::size_t count, int bits, std::uint64_t distinct, std::uint64_t salt) {
    Random random(salt);
    std::vector<std::uint64_t> codes(count);
    for (std::uint64_t& code : codes) {
        code = random.bits() >> (64 - bits);
        if (distinct > 0) code = (code % distinct) * 0x9e3779b1u & ((1u << 30) - 1u);
    }
    return codes;
}

Input forest(const std::vector<std::uint32_t>& sizes, std::uint64_t distinct, std::uint64_t salt) {
    Input input;
    input.format = key_format(MortonBits::bits30, sizes.size());
    input.offsets = {0};
    for (std::size_t tree = 0; tree < sizes.size(); ++tree) {
        std::vector<std::uint64_t> codes = random_codes(sizes[tree], 30, distinct, salt + tree);
        std::sort(codes.begin(), codes.end());
        for (const std::uint64_t code : codes)
            input.keys.push_back(code | static_cast<std::uint64_t>(tree) << input.format.code_bits);
        input.offsets.push_back(static_cast<std::uint32_t>(input.keys.size()));
    }
    return input;
}

template <class Key>
HostTopology run(const Input& input) {
    Device& device = test_device();
    const std::vector<Key> keys(input.keys.begin(), input.keys.end());
    const Buffer<Key> buffer = upload(device, keys, "keys");
    return to_host(device, lbvh(device, buffer, input.format, upload(device, identity(keys.size()), "order"),
                                upload(device, input.offsets, "offsets")));
}

/// Node by node against the builder from the top, and by the promises one by one.
template <class Key>
void check(const Input& input) {
    const HostTopology topology = run<Key>(input);
    CHECK(difference(topology, reference_topology(input.keys, identity(input.keys.size()), input.offsets)) == "");
    CHECK(broken_promise(topology, input.keys) == "");
}

std::vector<std::uint32_t> words(const std::vector<cl_uint2>& pairs) {
    std::vector<std::uint32_t> result;
    for (const cl_uint2& pair : pairs) result.insert(result.end(), {pair.s[0], pair.s[1]});
    return result;
}

} // namespace

TEST_CASE("lbvh: the eight keys of Karras 2012, figure 3") {
    const Input input = one_tree({0b00001, 0b00010, 0b00100, 0b00101, 0b10011, 0b11000, 0b11001, 0b11110}, one_tree_30);
    const HostTopology t = run<std::uint32_t>(input);
    constexpr std::uint32_t none = BOXWOOD_NONE, leaf = 8; // leaf i is node 8 + i
    CHECK(words(t.children) == std::vector<std::uint32_t>{3, 4, leaf + 0, leaf + 1, leaf + 2, leaf + 3, 1, 2, leaf + 4,
                                                          5, 6, leaf + 7, leaf + 5, leaf + 6, none, none});
    CHECK(t.far_ends == std::vector<std::uint32_t>{7, 0, 3, 0, 7, 7, 5, 7});
    CHECK(t.parents == std::vector<std::uint32_t>{none, 3, 3, 0, 0, 4, 5, none, 1, 1, 2, 2, 4, 6, 6, 5});
    CHECK(t.order == identity(8));
}

TEST_CASE("lbvh: the checker sees what is broken") {
    const Input input = one_tree(random_codes(50, 30, 0, 1), one_tree_30);
    const HostTopology good = reference_topology(input.keys, identity(50), input.offsets);
    REQUIRE(broken_promise(good, input.keys) == "");
    HostTopology bad = good;
    std::swap(bad.order[3], bad.order[4]);
    CHECK(broken_promise(bad, input.keys) == ""); // any permutation will do
    bad.order[3] = bad.order[4];
    CHECK(broken_promise(bad, input.keys) != "");
    bad = good;
    std::swap(bad.children[0].s[0], bad.children[0].s[1]);
    CHECK(broken_promise(bad, input.keys) != "");
    bad = good;
    bad.parents[60] = bad.parents[70];
    CHECK(broken_promise(bad, input.keys) != "");
    bad = good;
    bad.far_ends[good.children[0].s[0]] += 1;
    CHECK(broken_promise(bad, input.keys) != "");
    bad = good;
    bad.far_ends[49] = 0;
    CHECK(broken_promise(bad, input.keys) != "");
    const auto other = one_tree(random_codes(50, 30, 0, 2), one_tree_30).keys; // right for its own keys only
    CHECK(broken_promise(good, other) != "");
}

TEST_CASE("lbvh: no primitive, one, two and three, equal and not") {
    check<std::uint32_t>({{}, {0}, one_tree_30});
    for (const std::size_t count : {1u, 2u, 3u}) {
        CAPTURE(count);
        check<std::uint32_t>(one_tree(random_codes(count, 30, 0, count), one_tree_30));
        check<std::uint32_t>(one_tree(std::vector<std::uint64_t>(count, 5), one_tree_30));
        check<std::uint64_t>(one_tree(random_codes(count, 63, 0, count), one_tree_63));
    }
}

TEST_CASE("lbvh: every tuning gives the same tree, also at the boundaries of slices") {
    const std::uint32_t several = small_sizes() ? 601 : 3001;
    const std::vector<Tuning> cuts{test_device().tuning(), {3, 7, 5}, {64, 4096, 1}, {1, 5, 8}, {1, 1, 1}};
    for (const Tuning& tuning : cuts) {
        CAPTURE(tuning.group_size);
        CAPTURE(tuning.work_items);
        const TuningScope scope(tuning);
        // Around one and several slices of 5, 8 and 256, where trees of one, two and no node fall on either side.
        for (const std::size_t count : {4u, 5u, 6u, 8u, 9u, 15u, 16u, 17u, 40u, 41u, 255u, 256u, 257u,
                                        small_sizes() ? 300u : 513u, small_sizes() ? 513u : 4099u}) {
            CAPTURE(count);
            check<std::uint32_t>(one_tree(random_codes(count, 30, 0, count), one_tree_30));
            check<std::uint32_t>(one_tree(random_codes(count, 30, count / 4 + 1, count), one_tree_30));
        }
        check<std::uint64_t>(one_tree(random_codes(several, 63, 0, 9), one_tree_63));
        check<std::uint64_t>(one_tree(random_codes(several, 63, 100, 9), one_tree_63));
        check<std::uint64_t>(forest({1, 1, 2, 1, 3, 700, 1, 5, 300, 1}, 0, 1));
        check<std::uint64_t>(forest({256, 256, 1, 255, 257}, 40, 2));
    }
}

TEST_CASE("lbvh: equal keys are split by position") {
    for (const std::size_t count : {64u, 1000u, 1000000u}) {
        if (count > 1000 && small_sizes()) continue;
        CAPTURE(count);
        check<std::uint32_t>(one_tree(std::vector<std::uint64_t>(count, 0x2aaaaaaa), one_tree_30));
    }
    check<std::uint64_t>(one_tree(std::vector<std::uint64_t>(1000, 1), one_tree_63));
}

TEST_CASE("lbvh: the deepest tree, one key to each bit") {
    std::vector<std::uint64_t> keys{0};
    for (int bit = 0; bit < 63; ++bit) keys.push_back(std::uint64_t(1) << bit);
    check<std::uint64_t>(one_tree(keys, one_tree_63));
    // And 500 equal keys at its bottom.
    keys.insert(keys.end(), 500, 0);
    check<std::uint64_t>(one_tree(keys, one_tree_63));
}

TEST_CASE("lbvh: forests of trees of one primitive, and of many") {
    check<std::uint64_t>(forest(std::vector<std::uint32_t>(1000, 1), 0, 3));
    check<std::uint64_t>(forest({1, 5000}, 0, 4));
    check<std::uint64_t>(forest({5000, 1}, 0, 5));
    std::vector<std::uint32_t> sizes;
    Random random(6);
    for (int tree = 0; tree < 300; ++tree) sizes.push_back(1 + random.below(40));
    check<std::uint64_t>(forest(sizes, 0, 7));
    check<std::uint64_t>(forest(sizes, 3, 8));
    check<std::uint64_t>(forest(sizes, 1, 9)); // all keys of a tree are equal
}

TEST_CASE("lbvh: a large random tree") {
    const std::size_t count = small_sizes() ? 5000 : 300007;
    check<std::uint32_t>(one_tree(random_codes(count, 30, 0, 11), one_tree_30));
}
