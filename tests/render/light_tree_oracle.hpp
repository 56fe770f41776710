// SPDX-License-Identifier: MIT
// How often lights are chosen, in double precision and with angles (cl/render/light_tree.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "shared/light.h"

namespace boxwood::test {

/// Irradiance that a node may send to a place on a surface that faces it.
inline double node_irradiance(const LightNode& node, const glm::dvec3& place) {
    const double intensity = double(node.amplitude) * node.amplitude;
    if (node.distant) return intensity;
    const glm::dvec3 from = place - glm::dvec3(node.center[0], node.center[1], node.center[2]);
    const double distance = glm::length(from), radius = node.radius;
    if (distance <= radius) return intensity / (radius * radius);
    const glm::dvec3 axis(node.axis[0], node.axis[1], node.axis[2]);
    const double angle = std::acos(std::clamp(glm::dot(axis, from) / distance, -1.0, 1.0));
    const double spread = std::atan2(double(node.spread_sine), double(node.spread_cosine));
    const double beyond = std::max(angle - spread - std::asin(radius / distance), 0.0);
    return intensity * std::max(std::cos(beyond), 1.0 / 64) / (distance * distance);
}

/// Probability of a node's first child.
inline double first_child_probability(const std::vector<LightNode>& nodes, const LightNode& node,
                                      const glm::dvec3& place) {
    const LightNode &a = nodes[node.children[0]], &b = nodes[node.children[1]];
    if (a.amplitude > 0 && !(b.amplitude > 0)) return 1.0;
    if (b.amplitude > 0 && !(a.amplitude > 0)) return 0.0;
    if (!(a.amplitude > 0)) return 0.5;
    const double first = node_irradiance(a, place), second = node_irradiance(b, place);
    return std::clamp(1.0 / (1.0 + second / first), 1.0 / 64, 63.0 / 64);
}

/// Roots of distant and of near lights; -1: there are none.
struct LightRoots {
    int distant = -1, near = -1;

    explicit LightRoots(const std::vector<LightNode>& nodes) {
        const std::uint32_t* children = nodes[0].children;
        const bool mixed = nodes[children[0]].distant != nodes[children[1]].distant;
        if (nodes[children[0]].distant) distant = mixed ? static_cast<int>(children[0]) : 0;
        if (!nodes[children[1]].distant) near = mixed ? static_cast<int>(children[1]) : 0;
    }
};

/// By a cut of the tree about the light that matters most.
inline double near_irradiance(const std::vector<LightNode>& nodes, const glm::dvec3& place) {
    const std::size_t inner = nodes.size() / 2;
    auto at = static_cast<std::size_t>(LightRoots(nodes).near);
    double sum = 0.0, last = node_irradiance(nodes[at], place);
    while (at < inner) {
        const double a = node_irradiance(nodes[nodes[at].children[0]], place);
        const double b = node_irradiance(nodes[nodes[at].children[1]], place);
        sum += std::min(a, b);
        last = std::max(a, b);
        at = nodes[at].children[a >= b ? 0 : 1];
    }
    return sum + last;
}

/// Of environment, distant and near lights: half of them evenly, the rest by irradiance.
inline std::array<double, 3> light_probabilities(const std::vector<LightNode>& nodes, double environment,
                                                 const glm::dvec3& place) {
    const LightRoots roots(nodes);
    const bool some[3] = {environment > 0, roots.distant >= 0, roots.near >= 0};
    std::array<double, 3> probabilities = {environment, 0, 0};
    if (some[1]) probabilities[1] = std::pow(double(nodes[roots.distant].amplitude), 2.0);
    if (some[2]) probabilities[2] = near_irradiance(nodes, place);
    const double kinds = some[0] + some[1] + some[2], all = probabilities[0] + probabilities[1] + probabilities[2];
    for (int i = 0; i < 3; ++i) probabilities[i] = some[i] ? 0.5 / kinds + 0.5 * probabilities[i] / all : 0.0;
    if (kinds == 1)
        for (int i = 0; i < 3; ++i) probabilities[i] = some[i] ? 1.0 : 0.0;
    return probabilities;
}

struct ChosenLight {
    std::uint32_t light = 0;
    double rest = 0.0, probability = 1.0;
    double margin = std::numeric_limits<double>::infinity(); ///< How far, in u, a choice was from the other one.
};

/// Of those below `root`.
inline ChosenLight choose_light(const std::vector<LightNode>& nodes, std::uint32_t root, const glm::dvec3& place,
                                double u) {
    const std::uint32_t inner = static_cast<std::uint32_t>(nodes.size() / 2);
    ChosenLight chosen;
    chosen.rest = u;
    std::uint32_t at = root;
    while (at < inner) {
        const double probability = first_child_probability(nodes, nodes[at], place);
        const bool first = chosen.rest < probability;
        chosen.margin = std::min(chosen.margin, std::abs(chosen.rest - probability) * chosen.probability);
        const double part = first ? probability : 1.0 - probability;
        chosen.rest = (first ? chosen.rest : chosen.rest - probability) / part;
        chosen.probability *= part;
        at = nodes[at].children[first ? 0 : 1];
    }
    chosen.light = at - inner;
    return chosen;
}

/// With what probability that gives `light`, which is below the root.
inline double light_probability(const std::vector<LightNode>& nodes, std::uint32_t root, const glm::dvec3& place,
                                std::uint32_t light) {
    double probability = 1.0;
    for (std::size_t at = nodes.size() / 2 + light; at != root; at = nodes[at].parent) {
        const LightNode& parent = nodes[nodes[at].parent];
        const double of_first = first_child_probability(nodes, parent, place);
        probability *= parent.children[0] == at ? of_first : 1.0 - of_first;
    }
    return probability;
}

} // namespace boxwood::test
