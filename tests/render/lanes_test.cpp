// SPDX-License-Identifier: MIT
// A device treats one path at a time, eight or sixteen: nothing of a picture tells.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "appearance_scenes.hpp"
#include "path_scenes.hpp"
#include "render/two_squares.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// Everything that shading reads: a floor with every texture, a ball with normals, tangents and colours that is cut
/// out, a veil, a lamp and lights of every kind.
Scene everything() {
    Scene scene;
    add_floor(scene, metal(glm::vec3(0.9f), 1.0f));
    Mesh& floor = scene.meshes[0];
    floor.uvs[0] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}};
    floor.uvs[1] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    for (std::uint64_t k = 0; k < 3; ++k) {
        const PictureSize size{8 + 5 * std::uint32_t(k), 8};
        scene.images.push_back(image("noise", size, noise(size, k + 1)));
        scene.textures.push_back({std::uint32_t(k)});
    }
    scene.textures[1].nearest = true;
    Material& matter = scene.materials[0];
    matter.base_color_texture = {0, 0};
    matter.metallic_roughness_texture = {1, 1};
    matter.normal_texture = {2, 0};
    matter.emission = glm::vec3(0.5f);
    matter.emission_texture = {1, 0};
    matter.occlusion_texture = {0, 1};
    add_quad(scene, {-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp(glm::vec3(3.0f)));
    Mesh ball = sphere_mesh(small_sizes() ? 4 : 8, true);
    for (const glm::vec3& p : ball.positions) {
        ball.tangents.emplace_back(1.0f, 0.0f, 0.0f, p.x > 0 ? 1.0f : -1.0f);
        ball.uvs[0].emplace_back(p.x, p.y);
        ball.colors.emplace_back(0.5f + 0.5f * p.y, 0.75f, 0.5f, 1.0f);
    }
    Material cut = metal(glm::vec3(0.8f), 0.3f);
    cut.alpha_mode = AlphaMode::mask;
    cut.metallic = 0.5f;
    cut.normal_texture = {2, 0};
    cut.base_color_texture = {0, 0};
    cut.double_sided = true;
    ball.materials.assign(ball.triangles.size(), std::uint32_t(scene.materials.size()));
    scene.materials.push_back(cut);
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), {0.25f, 0.7f, 0.0f});
    scene.instances.push_back({"ball", std::uint32_t(scene.meshes.size()), glm::scale(place, {0.7f, 0.5f, -0.6f})});
    scene.meshes.push_back(ball);
    Material veil = matt({0.2f, 0.4f, 0.8f});
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.5f;
    add_quad(scene, {-1.5f, 0.25f, 1.0f}, {1.5f, 0, 0}, {0, 1, 0}, veil);
    scene.lights.resize(3);
    scene.lights[0].position = {-1.0f, 1.5f, 1.0f};
    scene.lights[1].position = {1.0f, 1.5f, 1.0f};
    scene.lights[1].kind = LightKind::spot;
    scene.lights[1].direction = glm::normalize(glm::vec3(-0.5f, -1, -0.5f));
    scene.lights[2].kind = LightKind::directional;
    scene.lights[2].direction = glm::normalize(glm::vec3(0.5f, -1, 0.25f));
    return scene;
}

/// The names of the channels that differ, floats by their bits.
std::string different(const Image& a, const Image& b) {
    std::string names;
    REQUIRE(a.channels.size() == b.channels.size());
    for (std::size_t i = 0; i < a.channels.size(); ++i) {
        const bool same = std::visit(
            [&](const auto& samples) {
                return same_bits(samples, std::get<std::decay_t<decltype(samples)>>(b.channels[i].samples));
            },
            a.channels[i].samples);
        if (!same) names += a.channels[i].name + " ";
    }
    return names;
}

} // namespace

TEST_CASE("lanes: pictures of every integrator are the same by one, eight and sixteen") {
    Device& device = test_device();
    Scene scene = everything();
    Tree tree = build(device, scene);
    const Camera camera{"camera", look_at({-0.5, 1.5, 3}, {0, 0.5, 0}), true, 0.8f};
    const auto take = [&](RenderOptions options, std::uint32_t lanes) {
        Tuning tuning = device.tuning();
        tuning.lanes = lanes;
        const TuningScope scope(tuning);
        return render(device, scene, tree, default_sky(), camera, options);
    };
    const auto check = [&](RenderOptions options) {
        options.width = small_sizes() ? 3 : 21; // no multiple of eight
        options.height = small_sizes() ? 3 : 13;
        options.batch = small_sizes() ? 5 : 100;
        options.light.seed = test_seed();
        options.light.depth = 3;
        const Image one = take(options, 1);
        CHECK(different(take(options, 8), one) == "");
        CHECK(different(take(options, 16), one) == "");
        const std::vector<float>& green = plane<float>(one, "G");
        CHECK(*std::max_element(green.begin(), green.end()) > 0.0f);
    };
    RenderOptions options;
    options.light.samples = 2;
    for (const Integrator integrator : {Integrator::path, Integrator::ambient, Integrator::ao}) {
        CAPTURE(name(integrator));
        options.light.integrator = integrator;
        options.aovs = {Aov::variance};
        if (integrator == Integrator::path)
            options.aovs = {Aov::direct, Aov::depth, Aov::normal, Aov::position, Aov::albedo, Aov::material};
        check(options);
    }
    options.light.integrator = Integrator::path;
    options.aovs.clear();
    options.light.filter = TextureFilter::nearest;
    options.light.strategy = Strategy::bsdf;
    options.light.hemisphere = Hemisphere::uniform;
    options.light.sampler = SamplerKind::stratified;
    // Programs without transforms.
    for (Instance& instance : scene.instances) instance.transform = glm::mat4(1.0f);
    tree = build(device, scene);
    check(options);
}
