// SPDX-License-Identifier: MIT
#include "oracles/tree_checker.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "shared/types.h"

namespace boxwood::test {

namespace {

/// Last position of the left part of [first, last], first < last.
std::uint32_t split_of(const std::vector<std::uint64_t>& keys, std::uint32_t first, std::uint32_t last) {
    const bool by_key = keys[first] != keys[last];
    const std::uint64_t differing = by_key ? keys[first] ^ keys[last] : first ^ last;
    const std::uint64_t bit = std::bit_floor(differing);
    std::uint32_t low = first, high = last; // the bit is 0 at low and 1 at high
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        const std::uint64_t value = by_key ? keys[middle] : middle;
        (value & bit ? high : low) = middle;
    }
    return low;
}

struct Pending {
    std::uint32_t first, last, index, parent;
};

std::string at(const char* what, std::uint32_t node) { return std::string(what) + " at " + std::to_string(node); }

} // namespace

HostTopology to_host(Device& device, const Topology& topology) {
    return {download(device, topology.offsets), download(device, topology.order), download(device, topology.children),
            download(device, topology.parents), download(device, topology.far_ends)};
}

std::vector<cl_uint2> layout_children(const HostTopology& topology) {
    std::vector<cl_uint2> children = topology.children;
    for (std::uint32_t tree = 0; tree < topology.trees(); ++tree) {
        const std::uint32_t first = topology.offsets[tree];
        if (topology.offsets[tree + 1] - first == 1) children[first].s[0] = topology.root(tree);
    }
    return children;
}

Span span_of(const HostTopology& topology, std::uint32_t node) {
    const std::uint32_t count = topology.size();
    if (node >= count) return {node - count, node - count};
    const std::uint32_t other = topology.far_ends[node];
    return {std::min(node, other), std::max(node, other)};
}

namespace {

/// From the roots down; split_of(first, last) is the last position of the left part.
template <class SplitOf>
HostTopology build_down(const SplitOf& split_of, std::vector<std::uint32_t> order, std::vector<std::uint32_t> offsets) {
    const auto count = static_cast<std::uint32_t>(order.size());
    HostTopology result{std::move(offsets), std::move(order), {}, {}, {}};
    result.children.assign(count, cl_uint2{{BOXWOOD_NONE, BOXWOOD_NONE}});
    result.parents.assign(std::size_t{2} * count, BOXWOOD_NONE);
    for (std::uint32_t i = 0; i < count; ++i) result.far_ends.push_back(i);
    std::vector<Pending> pending;
    for (std::uint32_t tree = 0; tree < result.trees(); ++tree) {
        const std::uint32_t first = result.offsets[tree];
        pending.push_back({first, result.offsets[tree + 1] - 1, first, BOXWOOD_NONE});
        while (!pending.empty()) {
            const Pending node = pending.back();
            pending.pop_back();
            if (node.first == node.last) {
                result.parents[count + node.first] = node.parent;
                continue;
            }
            const std::uint32_t split = split_of(node.first, node.last);
            const std::uint32_t left = split == node.first ? count + split : split;
            const std::uint32_t right = split + 1 == node.last ? count + node.last : split + 1;
            result.children[node.index] = cl_uint2{{left, right}};
            result.parents[node.index] = node.parent;
            result.far_ends[node.index] = node.index == node.first ? node.last : node.first;
            pending.push_back({node.first, split, split, node.index});
            pending.push_back({split + 1, node.last, split + 1, node.index});
        }
    }
    return result;
}

} // namespace

HostTopology reference_topology(const std::vector<std::uint64_t>& keys, std::vector<std::uint32_t> order,
                                std::vector<std::uint32_t> offsets) {
    return build_down([&](std::uint32_t first, std::uint32_t last) { return split_of(keys, first, last); },
                      std::move(order), std::move(offsets));
}

HostTopology reference_topology_of_gaps(const std::vector<std::uint64_t>& gaps, std::vector<std::uint32_t> order,
                                        std::vector<std::uint32_t> offsets) {
    const auto largest = [&](std::uint32_t first, std::uint32_t last) {
        return static_cast<std::uint32_t>(std::max_element(gaps.begin() + first, gaps.begin() + last) - gaps.begin());
    };
    return build_down(largest, std::move(order), std::move(offsets));
}

std::string difference(const HostTopology& a, const HostTopology& b) {
    if (a.offsets != b.offsets || a.order != b.order) return "offsets or order";
    if (a.children.size() != b.children.size() || a.parents.size() != b.parents.size()) return "sizes";
    for (std::uint32_t i = 0; i < a.size(); ++i) {
        if (a.children[i].s[0] != b.children[i].s[0] || a.children[i].s[1] != b.children[i].s[1])
            return at("children", i);
        if (a.far_ends[i] != b.far_ends[i]) return at("far_ends", i);
    }
    for (std::uint32_t i = 0; i < a.parents.size(); ++i)
        if (a.parents[i] != b.parents[i]) return at("parents", i);
    return "";
}

namespace {

std::string check_order(const HostTopology& t) {
    std::vector<bool> seen(t.size());
    for (std::uint32_t tree = 0; tree < t.trees(); ++tree) {
        for (std::uint32_t i = t.offsets[tree]; i < t.offsets[tree + 1]; ++i) {
            const std::uint32_t primitive = t.order[i];
            if (primitive < t.offsets[tree] || primitive >= t.offsets[tree + 1]) return at("primitive of another", i);
            if (seen[primitive]) return at("primitive twice", i);
            seen[primitive] = true;
        }
    }
    return "";
}

/// The two parts of one inner node.
std::string check_parts(const HostTopology& t, const std::vector<std::uint64_t>& keys, std::uint32_t node) {
    const std::uint32_t left = t.children[node].s[0], right = t.children[node].s[1];
    const std::uint32_t nodes = 2 * t.size();
    if (left >= nodes || right >= nodes || left == right) return at("child out of range", node);
    if (t.parents[left] != node || t.parents[right] != node) return at("child with another parent", node);
    const Span whole = span_of(t, node), a = span_of(t, left), b = span_of(t, right);
    if (a.first != whole.first || b.last != whole.last || a.last + 1 != b.first) return at("parts", node);
    if (left < t.size() && left != a.last) return at("index of left child", node);
    if (right < t.size() && right != b.first) return at("index of right child", node);
    const bool by_key = keys[whole.first] != keys[whole.last];
    const std::uint64_t bit = std::bit_floor(by_key ? keys[whole.first] ^ keys[whole.last] : whole.first ^ whole.last);
    const std::uint64_t below = by_key ? keys[a.last] : a.last, above = by_key ? keys[b.first] : b.first;
    if ((below & bit) != 0 || (above & bit) == 0) return at("parted at another bit", node);
    return "";
}

} // namespace

std::string broken_promise(const HostTopology& t, const std::vector<std::uint64_t>& keys) {
    const std::uint32_t count = t.size();
    if (t.children.size() != count || t.far_ends.size() != count || t.parents.size() != 2 * keys.size())
        return "sizes of the arrays";
    if (std::string wrong = check_order(t); !wrong.empty()) return wrong;
    // Every node but the roots has one parent that has it as a child; so with the right number of inner nodes, and
    // ranges that only shrink, each tree is one tree.
    for (std::uint32_t tree = 0; tree < t.trees(); ++tree) {
        const std::uint32_t first = t.offsets[tree], last = t.offsets[tree + 1] - 1, root = t.root(tree);
        if (t.parents[root] != BOXWOOD_NONE) return at("parent of a root", root);
        const Span whole = span_of(t, root);
        if (whole.first != first || whole.last != last) return at("range of a root", root);
        for (std::uint32_t node = first; node < last; ++node)
            if (std::string wrong = check_parts(t, keys, node); !wrong.empty()) return wrong;
        for (std::uint32_t i = first; i <= last; ++i) {
            for (const std::uint32_t node : {i, count + i}) {
                const bool unused = node == last;
                if (node == root || unused) continue;
                const std::uint32_t parent = t.parents[node];
                if (parent >= count) return at("no parent", node);
                if (t.children[parent].s[0] != node && t.children[parent].s[1] != node) return at("orphan", node);
            }
        }
        if (t.children[last].s[0] != BOXWOOD_NONE || t.children[last].s[1] != BOXWOOD_NONE ||
            t.parents[last] != BOXWOOD_NONE || t.far_ends[last] != last)
            return at("unused slot", last);
    }
    return "";
}

} // namespace boxwood::test
