// SPDX-License-Identifier: MIT
#include "render/light_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

namespace boxwood {

namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 middle(const LightBounds& light) { return 0.5 * (light.low + light.high); }

/// The narrowest cone about both, or all directions. Axes need not differ.
void unite_cones(const LightBounds& a, const LightBounds& b, LightBounds& both) {
    const LightBounds &wide = a.spread >= b.spread ? a : b, &narrow = a.spread >= b.spread ? b : a;
    const double between = std::acos(std::clamp(glm::dot(wide.axis, narrow.axis), -1.0, 1.0));
    both.axis = wide.axis;
    both.spread = wide.spread;
    if (between + narrow.spread <= wide.spread) return;
    both.spread = 0.5 * (wide.spread + between + narrow.spread);
    const glm::dvec3 across = glm::cross(wide.axis, narrow.axis);
    if (both.spread >= pi || !(glm::length(across) > 0.0)) {
        both.spread = pi;
        return;
    }
    // Turned from the wide axis towards the other.
    const double turn = both.spread - wide.spread;
    const glm::dvec3 side = glm::normalize(glm::cross(across, wide.axis));
    both.axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) * side);
}

LightBounds unite(const LightBounds& a, const LightBounds& b) {
    LightBounds both;
    both.distant = a.distant && b.distant;
    both.low = glm::min(a.low, b.low);
    both.high = glm::max(a.high, b.high);
    both.strength = a.strength + b.strength;
    if (!(b.strength > 0.0) || !(a.strength > 0.0)) {
        // What gives no light shines nowhere.
        const LightBounds& lit = a.strength > 0.0 ? a : b;
        both.axis = lit.axis;
        both.spread = lit.spread;
    } else {
        unite_cones(a, b, both);
    }
    return both;
}

/// What splits are judged by: strength, size, and how far axes differ, by their weighted mean.
struct Sum {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()}, axes{0.0};
    double strength = 0.0;
    std::size_t count = 0;

    void add(const Sum& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
        axes += other.axes;
        strength += other.strength;
        count += other.count;
    }

    /// The orientation measure of the paper for lights that shine by the cosine is pi for one direction and 4 pi for
    /// all; between them by the length of the mean axis, which needs no cone for each bin.
    double cost() const {
        if (!(strength > 0.0)) return 0.0;
        const glm::dvec3 size = high - low;
        return strength * glm::dot(size, size) * (4.0 - 3.0 * std::min(glm::length(axes) / strength, 1.0));
    }
};

Sum sum_of(const LightBounds& light) {
    // Of a cone of directions, what is left of its axis: all of it for a single one, nothing for all.
    const double along = 0.5 * (1.0 + std::cos(light.spread));
    return {light.low, light.high, light.strength * along * light.axis, light.strength, 1};
}

class Builder {
public:
    explicit Builder(const std::vector<LightBounds>& lights)
        : lights_(lights), order_(lights.size()), nodes_(2 * lights.size() - 1) {
        std::iota(order_.begin(), order_.end(), 0u);
    }

    std::vector<LightNode> build() {
        add(order_, 0, 0);
        return std::move(nodes_);
    }

private:
    using Range = std::span<std::uint32_t>;

    /// The node over `range`, stored with its parent's index; returns its index and bounds.
    std::pair<std::uint32_t, LightBounds> add(Range range, std::uint32_t parent, int depth) {
        const bool leaf = range.size() == 1;
        const std::uint32_t index = leaf ? static_cast<std::uint32_t>(lights_.size() - 1) + range[0] : next_++;
        LightBounds bounds;
        std::uint32_t children[2] = {index, index};
        if (leaf) {
            bounds = lights_[range[0]];
        } else {
            const std::size_t left = split(range, depth);
            const auto first = add(range.first(left), index, depth + 1);
            const auto second = add(range.subspan(left), index, depth + 1);
            children[0] = first.first;
            children[1] = second.first;
            bounds = unite(first.second, second.second);
        }
        nodes_[index] = record(bounds, children, parent);
        return {index, bounds};
    }

    static LightNode record(const LightBounds& bounds, const std::uint32_t (&children)[2], std::uint32_t parent) {
        LightNode node{};
        const glm::dvec3 center = bounds.distant ? glm::dvec3(0.0) : middle(bounds);
        for (int k = 0; k < 3; ++k) {
            node.center[k] = static_cast<float>(center[k]);
            node.axis[k] = static_cast<float>(bounds.axis[k]);
        }
        node.radius = bounds.distant ? 0.0f : static_cast<float>(0.5 * glm::length(bounds.high - bounds.low));
        if (bounds.strength > 0.0) {
            using Limits = std::numeric_limits<float>;
            node.amplitude = static_cast<float>(
                std::clamp(std::sqrt(bounds.strength), double{Limits::min()}, double{Limits::max()}));
        }
        node.spread_cosine = static_cast<float>(std::cos(bounds.spread));
        node.spread_sine = static_cast<float>(std::sin(bounds.spread));
        node.distant = bounds.distant ? 1u : 0u;
        node.children[0] = children[0];
        node.children[1] = children[1];
        node.parent = parent;
        return node;
    }

    /// Orders `range` of at least two so that the first of them, whose number is returned, are one side.
    std::size_t split(Range range, int depth) const {
        const auto distant = [&](std::uint32_t i) { return lights_[i].distant; };
        const auto near = std::stable_partition(range.begin(), range.end(), distant);
        if (near != range.begin() && near != range.end()) return static_cast<std::size_t>(near - range.begin());
        constexpr int longest = 64;
        if (near == range.begin() && depth < longest)
            if (const std::size_t left = split_by_cost(range)) return left;
        return range.size() / 2;
    }

    /// The same at the border of two bins; 0 where all middles are the same.
    std::size_t split_by_cost(Range range) const {
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const std::uint32_t i : range) {
            low = glm::min(low, middle(lights_[i]));
            high = glm::max(high, middle(lights_[i]));
        }
        double least = std::numeric_limits<double>::infinity();
        int best_axis = -1;
        std::size_t best_bin = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(high[axis] > low[axis])) continue;
            std::array<Sum, bins> sums;
            for (const std::uint32_t i : range) sums[bin_of(i, axis, low[axis], high[axis])].add(sum_of(lights_[i]));
            std::array<double, bins> right_costs{};
            Sum right, left;
            for (std::size_t b = bins; b-- > 1;) {
                right.add(sums[b]);
                right_costs[b] = right.cost();
            }
            for (std::size_t b = 1; b < bins; ++b) {
                left.add(sums[b - 1]);
                if (left.count == 0 || left.count == range.size()) continue;
                const double cost = left.cost() + right_costs[b];
                if (cost < least || best_axis < 0) {
                    least = cost;
                    best_axis = axis;
                    best_bin = b;
                }
            }
        }
        if (best_axis < 0) return 0;
        const auto border = std::stable_partition(range.begin(), range.end(), [&](std::uint32_t i) {
            return bin_of(i, best_axis, low[best_axis], high[best_axis]) < best_bin;
        });
        return static_cast<std::size_t>(border - range.begin());
    }

    std::size_t bin_of(std::uint32_t light, int axis, double low, double high) const {
        const double along = (middle(lights_[light])[axis] - low) / (high - low);
        return std::min(static_cast<std::size_t>(along * bins), bins - 1);
    }

    static constexpr std::size_t bins = 16;

    const std::vector<LightBounds>& lights_;
    std::vector<std::uint32_t> order_;
    std::vector<LightNode> nodes_;
    std::uint32_t next_ = 0;
};

} // namespace

std::vector<LightNode> light_tree(const std::vector<LightBounds>& lights) { return Builder(lights).build(); }

LightBounds punctual_bounds(const LightRecord& record) {
    LightBounds bounds;
    for (int k = 0; k < 3; ++k) {
        bounds.low[k] = bounds.high[k] = record.position[k];
        bounds.axis[k] = record.direction[k];
        bounds.strength += record.intensity[k] / 3.0;
    }
    bounds.distant = record.kind == BOXWOOD_DIRECTIONAL_LIGHT;
    // Half of a spot's cone: sin^2 is (1 - cos) / 2.
    bounds.spread =
        record.kind == BOXWOOD_SPOT_LIGHT ? 2.0 * std::asin(std::min(std::sqrt(0.5) / record.cone_scale, 1.0)) : pi;
    return bounds;
}

} // namespace boxwood
