// SPDX-License-Identifier: MIT
#include "render/light_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "bounds/lanes_of.hpp"
#include "render/light_tree_oracle.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

constexpr double pi = std::numbers::pi;

struct Question {
    glm::vec3 place{0.0f};
    float u = 0.0f;
    std::uint32_t light = 0;
};

struct Answer {
    std::uint32_t light;
    double rest, probability, of_named;
    std::array<double, 3> probabilities; ///< Of environment, distant and near lights.
};

/// Some lights being near, and the questions about them.
std::vector<Answer> ask(const std::vector<LightNode>& nodes, const std::vector<Question>& questions,
                        float environment = 0.0f) {
    Device& device = test_device();
    std::vector<std::array<float, 5>> q;
    for (const Question& each : questions)
        q.push_back({each.place.x, each.place.y, each.place.z, each.u, float(each.light)});
    const std::size_t count = padded(q.size());
    std::vector<float> found[2];
    for (const int k : {0, 1}) {
        const Guarded<float> answers(device, 7 * count);
        launch(device, {"render/light_tree_test.cl", "light_tree_test", {{"LANES", k == 0 ? "1" : "16"}}},
               "light tree test", count, upload(device, nodes, "light tree"),
               static_cast<std::uint32_t>(nodes.size() / 2 + 1), environment,
               upload(device, by_components(q), "questions"), static_cast<std::uint32_t>(count), answers.view());
        CHECK(answers.intact());
        found[k] = answers.values();
    }
    CHECK(same_bits(found[0], found[1]));
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const auto of = [&](std::size_t component) { return found[1][component * count + i]; };
        answers.push_back({static_cast<std::uint32_t>(of(0)), of(1), of(2), of(3), {of(4), of(5), of(6)}});
    }
    return answers;
}

LightBounds lamp_at(const glm::dvec3& place, double size, const glm::dvec3& axis, double strength) {
    return {place - 0.5 * size, place + 0.5 * size, glm::normalize(axis), 0.0, strength, false};
}

LightBounds sun(double irradiance) {
    LightBounds light;
    light.spread = pi;
    light.strength = irradiance;
    light.distant = true;
    return light;
}

/// Lamps over five orders of magnitude in size and strength in the cube [-1, 1]^3, every fifth one shining all around.
std::vector<LightBounds> random_lights(std::size_t lamps, std::size_t suns) {
    Random random(11);
    std::vector<LightBounds> lights;
    for (std::size_t i = 0; i < suns; ++i) lights.push_back(sun(std::exp(random.uniform(-3, 3))));
    for (std::size_t i = 0; i < lamps; ++i) {
        const auto between = [&] { return double(random.uniform(-1, 1)); };
        const glm::dvec3 place(between(), between(), between());
        lights.push_back(lamp_at(place, std::exp(random.uniform(-8, -1)), {between(), between(), 1.5},
                                 std::exp(random.uniform(-5, 5))));
        if (i % 5 == 0) lights.back().spread = pi;
    }
    return lights;
}

/// Named lights are among the last `near` of `lights`.
std::vector<Question> random_questions(std::size_t count, std::size_t lights, std::size_t near, float scale) {
    Random random(12);
    std::vector<Question> questions(count);
    for (Question& q : questions) {
        q.place =
            scale * glm::vec3(random.uniform(-1.5f, 1.5f), random.uniform(-1.5f, 1.5f), random.uniform(-1.5f, 1.5f));
        q.u = std::min(random.uniform(0, 1), 0x1.fffffep-1f);
        q.light = static_cast<std::uint32_t>(lights - near + random.below(static_cast<std::uint32_t>(near)));
    }
    return questions;
}

std::vector<LightBounds> scaled(std::vector<LightBounds> lights, double scale) {
    for (LightBounds& light : lights) {
        light.low *= scale;
        light.high *= scale;
        light.strength *= light.distant ? 1.0 : scale * scale;
    }
    return lights;
}

/// Every light once, below its parent, within the nodes above it.
void check_tree(const std::vector<LightNode>& nodes, const std::vector<LightBounds>& lights) {
    const std::size_t inner = lights.size() - 1;
    REQUIRE(nodes.size() == inner + lights.size());
    CHECK(nodes[0].parent == 0);
    std::set<std::uint32_t> met;
    for (std::size_t i = 0; i < inner; ++i)
        for (const std::uint32_t child : nodes[i].children) {
            CHECK(met.insert(child).second);
            CHECK(nodes[child].parent == i);
        }
    CHECK(met.size() == 2 * inner);
    for (std::size_t light = 0; light < lights.size(); ++light) {
        CHECK(nodes[inner + light].children[0] == inner + light);
        CHECK(nodes[inner + light].children[1] == inner + light);
        int depth = 0;
        for (std::size_t at = inner + light; at != 0; at = nodes[at].parent, ++depth) {
            const LightNode &node = nodes[at], &parent = nodes[nodes[at].parent];
            CHECK(parent.amplitude >= node.amplitude);
            if (parent.distant || node.distant) continue;
            const glm::dvec3 a(parent.center[0], parent.center[1], parent.center[2]);
            const glm::dvec3 b = 0.5 * (lights[light].low + lights[light].high);
            CHECK(glm::distance(a, b) <= (1 + 1e-5) * parent.radius);
            const glm::dvec3 axis(parent.axis[0], parent.axis[1], parent.axis[2]);
            const double spread = std::atan2(double(parent.spread_sine), double(parent.spread_cosine));
            const double between = std::acos(std::clamp(glm::dot(axis, lights[light].axis), -1.0, 1.0));
            if (lights[light].strength > 0) CHECK(std::min(between + lights[light].spread, pi) <= spread + 1e-3);
        }
        CHECK(depth <= 64 + std::ceil(std::log2(double(lights.size()))));
    }
}

} // namespace

TEST_CASE("light_tree: every light is a leaf, below nodes that hold it") {
    for (const std::size_t lamps : {0, 1, 2, 3, 17, 500})
        for (const std::size_t suns : {0, 1, 2, 5}) {
            if (lamps + suns == 0) continue;
            CAPTURE(lamps);
            CAPTURE(suns);
            const std::vector<LightBounds> lights = random_lights(lamps, suns);
            check_tree(light_tree(lights), lights);
        }
    // Ever closer to one place, so that each bin takes one off; and all in one place.
    std::vector<LightBounds> lights;
    for (int i = 0; i < 1000; ++i) lights.push_back(lamp_at({std::exp(-0.08 * i), 0, 0}, 0, {0, 1, 0}, 1));
    check_tree(light_tree(lights), lights);
    lights.assign(1000, lamp_at({1, 2, 3}, 0, {0, 1, 0}, 1));
    check_tree(light_tree(lights), lights);
}

TEST_CASE("light_tree: what is chosen, and how often, is as in double precision") {
    const std::size_t count = small_sizes() ? 64 : 8192;
    for (const auto& kinds : {std::pair<std::size_t, std::size_t>{200, 2}, {2, 0}, {1, 1}, {1, 0}})
        for (const float environment : {0.0f, 3.0f}) {
            const std::size_t lamps = kinds.first, suns = kinds.second;
            CAPTURE(lamps);
            CAPTURE(environment);
            const std::vector<LightNode> nodes = light_tree(random_lights(lamps, suns));
            const std::vector<Question> questions = random_questions(count, lamps + suns, lamps, 1.0f);
            const std::vector<Answer> answers = ask(nodes, questions, environment);
            const auto root = static_cast<std::uint32_t>(LightRoots(nodes).near);
            std::size_t compared = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const glm::dvec3 place(questions[i].place);
                const double named = light_probability(nodes, root, place, questions[i].light);
                CHECK(std::abs(answers[i].of_named - named) <= 2e-3 * named);
                const auto probabilities = light_probabilities(nodes, environment, place);
                // The cut goes another way where two children send about the same.
                for (int k = 0; k < 3; ++k) CHECK(std::abs(answers[i].probabilities[k] - probabilities[k]) <= 1e-2);
                const ChosenLight wanted = test::choose_light(nodes, root, place, questions[i].u);
                if (wanted.margin < 1e-4) continue;
                ++compared;
                CHECK(answers[i].light == wanted.light);
                CHECK(std::abs(answers[i].probability - wanted.probability) <= 2e-3 * wanted.probability);
                CHECK(std::abs(answers[i].rest - wanted.rest) <= 1e-2 + 1e-4 / wanted.probability);
            }
            CHECK(compared > count / 2);
        }
}

TEST_CASE("light_tree: the probabilities of all lights are positive and add up to 1, at every scale") {
    const std::size_t lamps = small_sizes() ? 12 : 61, suns = 3;
    for (const int exponent : {-62, 0, 55}) {
        CAPTURE(exponent);
        const double scale = std::ldexp(1.0, exponent);
        const std::vector<LightBounds> lights = scaled(random_lights(lamps, suns), scale);
        const std::vector<LightNode> nodes = light_tree(lights);
        // Inside, at a light, far away and nowhere.
        const glm::vec3 at_light(0.5 * (lights.back().low + lights.back().high));
        const float nan = std::nanf(""), size = float(scale);
        for (const glm::vec3& place : {glm::vec3(0), at_light, size * glm::vec3(0.3f, -0.2f, 0.9f),
                                       size * glm::vec3(1e6f), glm::vec3(1e38f), glm::vec3(nan)}) {
            CAPTURE(place.x);
            std::vector<Question> questions;
            for (std::size_t i = 0; i < lamps; ++i)
                questions.push_back({place, float(i) / float(lamps), static_cast<std::uint32_t>(suns + i)});
            double sum = 0;
            for (const Answer& answer : ask(nodes, questions, 2.0f)) {
                CHECK(answer.of_named > 0);
                CHECK((answer.light >= suns && answer.light < lights.size()));
                CHECK((answer.rest >= 0 && answer.rest < 1));
                for (const double probability : answer.probabilities)
                    CHECK((probability >= 0.1666 && probability <= 0.6667));
                CHECK(answer.probabilities[0] + answer.probabilities[1] + answer.probabilities[2] ==
                      doctest::Approx(1.0).epsilon(1e-6));
                sum += answer.of_named;
            }
            CHECK(std::abs(sum - 1) < 1e-5);
        }
    }
}

TEST_CASE("light_tree: scenes of another size, by a power of two, choose alike to the bit") {
    const std::size_t count = small_sizes() ? 32 : 1024;
    const std::vector<LightBounds> lights = random_lights(50, 2);
    const std::vector<Answer> a = ask(light_tree(lights), random_questions(count, 52, 50, 1.0f), 1.0f);
    for (const int exponent : {-62, -3, 40, 55}) {
        CAPTURE(exponent);
        const double scale = std::ldexp(1.0, exponent);
        const std::vector<Answer> b =
            ask(light_tree(scaled(lights, scale)), random_questions(count, 52, 50, float(scale)), 1.0f);
        for (std::size_t i = 0; i < count; ++i) {
            CHECK(a[i].light == b[i].light);
            CHECK(a[i].probability == b[i].probability);
            CHECK(a[i].of_named == b[i].of_named);
            CHECK(a[i].probabilities == b[i].probabilities);
        }
    }
}

TEST_CASE("light_tree: what is near, and what faces a place, is chosen there") {
    // A sun as bright as a lamp 8 away, two lamps over a wide ground, and one more that shines up.
    const std::vector<LightBounds> lights = {sun(1.0), lamp_at({-50, 4, 0}, 1, {0, -1, 0}, 64),
                                             lamp_at({50, 4, 0}, 1, {0, -1, 0}, 64),
                                             lamp_at({50, 4, 3}, 1, {0, 1, 0}, 64)};
    const std::vector<LightNode> nodes = light_tree(lights);
    const auto probabilities = [&](const glm::vec3& place) {
        std::vector<double> found;
        for (const Answer& answer : ask(nodes, {{place, 0, 1}, {place, 0, 2}, {place, 0, 3}})) {
            if (found.empty()) found = {answer.probabilities[1]};
            found.push_back(answer.probabilities[2] * answer.of_named);
        }
        return found;
    };
    const auto left = probabilities({-50, 0, 0}), right = probabilities({50, 0, 0}), far = probabilities({0, 0, 5000});
    CHECK(left[1] > 0.6);
    CHECK(right[2] > 0.5);
    CHECK(right[3] < 0.05);
    CHECK(far[0] > 0.74);
    // A lamp that gives nothing is not chosen beside another.
    const std::vector<LightBounds> dark = {lamp_at({0, 1, 0}, 1, {0, -1, 0}, 0), lamp_at({1, 1, 0}, 1, {0, -1, 0}, 1)};
    const std::vector<Answer> answers = ask(light_tree(dark), {{{0, 0, 0}, 0.1f, 0}, {{0, 0, 0}, 0.9f, 1}});
    CHECK(answers[0].of_named == 0.0);
    CHECK(answers[1].of_named == 1.0);
    for (const Answer& answer : answers) CHECK(answer.light == 1);
}

TEST_SUITE_END();
