// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/render.hpp"
#include "path_scenes.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

const std::vector<float>& plane(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return std::get<std::vector<float>>(channel.samples);
    throw std::runtime_error("no channel " + name);
}

/// Of a floor under a lamp: variance.Y over how pictures of different seeds differ, both summed over the pixels.
double told_over_true(SamplerKind sampler) {
    Scene scene;
    add_floor(scene, matt(glm::vec3(0.5f)));
    add_quad(scene, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp(glm::vec3(3.0f)));
    Device& device = test_device();
    const Tree tree = build(device, scene);
    RenderOptions options;
    options.light.sampler = sampler;
    options.light.depth = 1;
    options.light.samples = 16;
    options.width = options.height = small_sizes() ? 4 : 16;
    options.aovs = {Aov::variance};
    const std::uint32_t pixels = options.width * options.height, seeds = small_sizes() ? 3 : 16;
    std::vector<double> sum(pixels), square(pixels);
    double told = 0.0, found = 0.0;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        options.light.seed = seed;
        const Image image = render(device, scene, tree, {}, camera_above(0.5f, 0.5f), options);
        for (std::uint32_t i = 0; i < pixels; ++i) {
            const double y =
                0.2126 * plane(image, "R")[i] + 0.7152 * plane(image, "G")[i] + 0.0722 * plane(image, "B")[i];
            sum[i] += y;
            square[i] += y * y;
            told += static_cast<double>(plane(image, "variance.Y")[i]) / seeds;
        }
    }
    for (std::uint32_t i = 0; i < pixels; ++i) found += (square[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
    return told / found;
}

} // namespace

TEST_CASE("variance: that of independent samples, more than that of points that are spread evenly") {
    if (small_sizes()) { // too few pictures for more
        CHECK(told_over_true(SamplerKind::random) > 0.0);
        return;
    }
    // Of 256 pixels and 16 pictures the true one is known to 2.3 %.
    CHECK(told_over_true(SamplerKind::random) == doctest::Approx(1.0).epsilon(0.1));
    for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::stratified})
        CHECK(told_over_true(sampler) > 1.2);
}

TEST_SUITE_END();
