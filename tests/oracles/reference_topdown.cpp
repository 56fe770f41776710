// SPDX-License-Identifier: MIT
#include "oracles/reference_topdown.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "shared/types.h"

namespace boxwood::test {

namespace {

using List = std::vector<std::uint32_t>;
constexpr float infinity = std::numeric_limits<float>::infinity();

Aabb empty_box() { return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}; }

void grow(Aabb& box, const Aabb& by) {
    for (int k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], by.min[k]);
        box.max[k] = std::max(box.max[k], by.max[k]);
    }
}

std::array<float, 3> extents(const Aabb& box) {
    return {box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]};
}

float half_surface(const std::array<float, 3>& e, float unit) {
    const float x = e[0] / unit, y = e[1] / unit, z = e[2] / unit;
    return x * y + y * z + z * x;
}

/// A way to part a node.
struct Cut {
    float cost;
    std::size_t larger;
    float probabilities;
    List left, right;
};

struct Recursion {
    const std::vector<Aabb>& boxes;
    const std::vector<float>& centres;
    const TopDownOptions& options;
    const ReferenceRules& rules;
    ReferenceTree& result;
    Aabb root = empty_box();

    float centre(std::uint32_t i, int axis) const {
        return centres.empty() ? 0.5f * boxes[i].min[axis] + 0.5f * boxes[i].max[axis] : centres[3 * i + axis];
    }
    Aabb box_of(const List& list) const {
        Aabb box = empty_box();
        for (const std::uint32_t i : list) grow(box, boxes[i]);
        return box;
    }

    /// The bin of every primitive along an axis; nothing for an axis without extent.
    std::vector<std::uint32_t> bins_of(const List& list, int axis, std::uint32_t count) const {
        float low = infinity, high = -infinity;
        for (const std::uint32_t i : list) {
            low = std::min(low, options.bin_box ? boxes[i].min[axis] : centre(i, axis));
            high = std::max(high, options.bin_box ? boxes[i].max[axis] : centre(i, axis));
        }
        const float extent = high - low;
        if (!(extent > 0.0f)) return {};
        const float zoom = extent < 0x1p-90f ? 0x1p90f : 1.0f;
        const float scale = static_cast<float>(count) / (extent * zoom);
        std::vector<std::uint32_t> found;
        for (const std::uint32_t i : list) {
            const float place = (centre(i, axis) - low) * zoom * scale;
            found.push_back(static_cast<std::uint32_t>(std::clamp(place, 0.0f, static_cast<float>(count - 1))));
        }
        return found;
    }

    void try_axis(const List& list, int axis, bool fallback, std::optional<Cut>& best) const {
        const std::uint32_t few = 4 + static_cast<std::uint32_t>(list.size()) / options.primitives_per_bin;
        const std::uint32_t count = options.bin_box ? options.bins : std::min(options.bins, few);
        const std::vector<std::uint32_t> bin = bins_of(list, axis, count);
        if (bin.empty()) return;
        const auto& measure = fallback ? rules.fallback_measure : rules.measure;
        for (std::uint32_t plane = 1; plane < count; ++plane) {
            Cut cut{};
            for (std::size_t i = 0; i < list.size(); ++i) (bin[i] < plane ? cut.left : cut.right).push_back(list[i]);
            if (cut.left.empty() || cut.right.empty()) continue;
            const float left = measure(root, box_of(cut.left)), right = measure(root, box_of(cut.right));
            cut.cost = left * rounded(cut.left.size()) + right * rounded(cut.right.size());
            cut.larger = std::max(cut.left.size(), cut.right.size());
            cut.probabilities = left + right;
            if (!best || cut.cost < best->cost || (cut.cost == best->cost && cut.larger < best->larger))
                best = std::move(cut);
        }
    }

    /// Of four leaves or fewer, as many as those leaves can hold.
    float rounded(std::size_t size) const {
        const std::size_t block = options.block_size;
        const std::size_t leaves = size / block + (size % block != 0 ? 1 : 0);
        return static_cast<float>(leaves <= 4 ? leaves * block : size);
    }

    static std::array<int, 3> by_quality(const std::array<float, 3>& quality) {
        std::array<int, 3> order{0, 1, 2};
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return quality[a] > quality[b]; });
        return order;
    }

    /// The paper's figure 9.
    std::optional<Cut> choose(const List& list, std::uint32_t level) {
        const Aabb box = box_of(list);
        std::optional<Cut> best;
        std::uint64_t tried = 0;
        bool fallback = level >= options.max_non_fallback_levels;
        if (!fallback) {
            const float probability = rules.measure(root, box);
            const auto quality = rules.axes(box, level);
            for (const int axis : by_quality(quality)) {
                const float ratio = best && probability > 0.0f ? best->probabilities / probability : infinity;
                if (ratio <= options.excellent_children) break;
                if (quality[axis] < options.split_plane_quality) {
                    fallback = ratio >= options.acceptable_children;
                    break;
                }
                try_axis(list, axis, false, best);
                ++tried;
            }
            if (!best) fallback = true;
        }
        if (fallback) {
            std::optional<Cut> other;
            for (const int axis : by_quality(rules.fallback_axes(box, level))) {
                if (other) break;
                try_axis(list, axis, true, other);
                ++tried;
            }
            if (other) best = other;
        }
        if (!best) return best; // no plane parts them
        ++result.splits;
        result.axes_tried += tried;
        result.fallbacks += fallback ? 1 : 0;
        return best;
    }

    bool stops(const List& list, std::uint32_t level) const {
        if (list.size() <= options.block_size || level >= options.max_levels) return true;
        if (!rules.thresholds) return false;
        const float probability = rules.measure(root, box_of(list));
        return list.size() <= options.max_leaf_primitives ||
               probability * static_cast<float>(list.size()) < options.max_leaf_cost ||
               probability < options.max_leaf_area * rules.measure(root, root) ||
               probability < options.max_leaf_hit_probability;
    }

    void build(const List& list, std::uint32_t first, std::uint32_t parent, bool is_left, std::uint32_t level,
               bool in_leaf) {
        HostTopology& t = result.topology;
        const auto size = static_cast<std::uint32_t>(list.size());
        result.depth = std::max(result.depth, level);
        if (size == 1) {
            t.order[first] = list[0];
            t.parents[t.size() + first] = parent;
            return;
        }
        const std::uint32_t index = is_left ? first + size - 1 : first;
        std::optional<Cut> cut;
        if (!in_leaf && !stops(list, level)) cut = choose(list, level);
        const bool leaf = !cut;
        if (leaf) {
            cut.emplace();
            cut->left.assign(list.begin(), list.begin() + size / 2);
            cut->right.assign(list.begin() + size / 2, list.end());
        }
        const std::uint32_t middle = first + static_cast<std::uint32_t>(cut->left.size());
        result.leaves[index] = leaf ? 1 : 0;
        t.parents[index] = parent;
        t.far_ends[index] = is_left ? first : first + size - 1;
        t.children[index].s[0] = cut->left.size() == 1 ? t.size() + first : middle - 1;
        t.children[index].s[1] = cut->right.size() == 1 ? t.size() + middle : middle;
        build(cut->left, first, index, true, level + 1, leaf);
        build(cut->right, middle, index, false, level + 1, leaf);
    }
};

} // namespace

float reference_surface(const Aabb& root, const Aabb& box) {
    const auto whole = extents(root);
    const float unit = std::max({whole[0], whole[1], whole[2]});
    const float all = half_surface(whole, unit);
    return all > 0.0f ? half_surface(extents(box), unit) / all : 1.0f;
}

std::array<float, 3> reference_longest(const Aabb& box, std::uint32_t) {
    const auto e = extents(box);
    const float longest = std::max({e[0], e[1], e[2]});
    if (!(longest > 0.0f)) return {1.0f, 1.0f, 1.0f};
    return {e[0] / longest, e[1] / longest, e[2] / longest};
}

std::array<float, 3> reference_all(const Aabb&, std::uint32_t) { return {1.0f, 1.0f, 1.0f}; }

ReferenceRules reference_rules() {
    return {reference_surface, reference_surface, reference_longest, reference_longest};
}

ReferenceTree reference_topdown(const std::vector<Aabb>& boxes, const std::vector<float>& centres,
                                const std::vector<std::uint32_t>& offsets, const TopDownOptions& options,
                                const ReferenceRules& rules) {
    ReferenceTree result;
    HostTopology& t = result.topology;
    const auto count = static_cast<std::uint32_t>(boxes.size());
    t.offsets = offsets;
    t.order.resize(count);
    t.children.assign(count, cl_uint2{{BOXWOOD_NONE, BOXWOOD_NONE}});
    t.parents.assign(2 * boxes.size(), BOXWOOD_NONE);
    t.far_ends.resize(count);
    std::iota(t.far_ends.begin(), t.far_ends.end(), 0u);
    result.leaves.assign(count, 0);
    for (std::uint32_t tree = 0; tree + 1 < offsets.size(); ++tree) {
        List list(offsets[tree + 1] - offsets[tree]);
        std::iota(list.begin(), list.end(), offsets[tree]);
        Recursion recursion{boxes, centres, options, rules, result};
        recursion.root = recursion.box_of(list);
        recursion.build(list, offsets[tree], BOXWOOD_NONE, false, 0, false);
    }
    return result;
}

} // namespace boxwood::test
