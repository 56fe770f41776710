// SPDX-License-Identifier: MIT
// Light from and through textures, against closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "path_picture.hpp"
#include "path_scenes.hpp"
#include "render/appearance_scenes.hpp"
#include "scene/picture.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

constexpr double pi = std::numbers::pi;
const glm::dvec3 up(0, 1, 0);

/// A grey floor under a square that faces down, whose texture 0 has `left` for x < 0 and `right` elsewhere, in blocks.
Scene under_square(const Material& material, const std::vector<std::uint8_t>& left,
                   const std::vector<std::uint8_t>& right) {
    Scene scene;
    add_floor(scene, matt(glm::vec3(0.5f)));
    add_quad(scene, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, material);
    scene.meshes.back().uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<std::uint8_t> texels = left;
    texels.insert(texels.end(), right.begin(), right.end());
    if (!texels.empty()) scene.images = {image("halves", {2, 1}, texels)};
    scene.textures = {{0, Wrap::clamp, Wrap::clamp, true}};
    return scene;
}

/// Checks the floor's light against that of a square of `left` and `right`, radiance of the halves, by every strategy.
void check_halves(const Scene& scene, double left, double right) {
    const LitScene lit(test_device(), scene);
    const std::uint32_t across = 16;
    const float half = 0.5f;
    double expected = 0.0;
    for (std::uint32_t i = 0; i < across * across; ++i) {
        const glm::dvec3 p = floor_point(half, across, i % across, i / across);
        const auto from = [&](double x0, double x1) {
            return polygon_irradiance(p, up, {{x0, 1, -0.5}, {x1, 1, -0.5}, {x1, 1, 0.5}, {x0, 1, 0.5}});
        };
        expected += 0.5 / pi * (left * from(-0.5, 0) + right * from(0, 0.5)) / (across * across);
    }
    for (const Strategy strategy : {Strategy::mis, Strategy::lights, Strategy::bsdf}) {
        CAPTURE(static_cast<int>(strategy));
        LightOptions options;
        options.strategy = strategy;
        options.samples = small_sizes() ? 4 : 64;
        options.depth = 1;
        options.seed = test_seed();
        const Estimate found =
            estimate(test_device(), lit, camera_above(half, 0.5f), {across, across}, options, small_sizes() ? 3 : 12);
        CAPTURE(found.error / expected);
        // Of 12 pictures the error itself is known to a fifth: four of them are passed once in 500 times.
        CHECK(std::abs(found.mean - expected) < 4 * found.error + (small_sizes() ? 0.3 : 1e-3) * expected);
        if (!small_sizes()) CHECK(found.error < 0.0066 * expected);
    }
}

} // namespace

TEST_CASE("path_textures: a lamp with a texture that is black on one half shines with the other") {
    Material material = lamp(glm::vec3(3.0f));
    material.emission_texture.texture = 0;
    check_halves(under_square(material, {0, 0, 0, 255}, {255, 255, 255, 255}), 0.0, 3.0);
}

TEST_CASE("path_textures: a lamp that is cut out, or let light pass, by its texture shines with what is left") {
    Material material = lamp(glm::vec3(3.0f));
    material.base_color_texture.texture = 0;
    material.alpha_mode = AlphaMode::mask;
    if (!small_sizes()) check_halves(under_square(material, {9, 9, 9, 100}, {9, 9, 9, 200}), 0.0, 3.0);
    material.alpha_mode = AlphaMode::blend;
    check_halves(under_square(material, {9, 9, 9, 51}, {9, 9, 9, 153}), 3.0 * 0.2, 3.0 * 0.6);
}

TEST_CASE("path_textures: a lamp that is finely cut out shines with half its light, however it is found") {
    Material material = lamp(glm::vec3(3.0f));
    material.base_color_texture.texture = 0;
    material.alpha_mode = AlphaMode::mask;
    Scene scene = under_square(material, {}, {});
    const std::uint32_t size = 32;
    std::vector<std::uint8_t> checks;
    for (std::uint32_t i = 0; i < size * size; ++i)
        checks.insert(checks.end(), {9, 9, 9, static_cast<std::uint8_t>((i + i / size) % 2 == 0 ? 0 : 200)});
    scene.images = {image("checks", {size, size}, checks)};
    check_halves(scene, 1.5, 1.5);
}

TEST_CASE("path_textures: both axes of a beam count for what is seen as a picture, by the camera or in a mirror") {
    // A fine pattern on a ceiling that the camera sees at a slant, itself or by way of the floor.
    const PictureSize size{64, 64};
    Material patterned = lamp(glm::vec3(1.0f));
    patterned.emission = glm::vec3(0.0f);
    patterned.base_color = glm::vec4(1.0f);
    patterned.unlit = true;
    patterned.base_color_texture.texture = 0;
    patterned.base_color_texture.transform = glm::mat3(8, 0, 0, 0, 8, 0, 0, 0, 1);
    const auto picture = [&](const Material& floor, const glm::vec3& target, TextureFilter filter) {
        Scene scene;
        add_floor(scene, floor);
        add_quad(scene, {-4, 1, -4}, {8, 0, 0}, {0, 0, 8}, patterned); // faces down
        scene.meshes.back().uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        scene.images = {image("noise", size, noise(size, 5))};
        scene.textures = {{0, Wrap::repeat, Wrap::repeat, true}};
        const LitScene lit(test_device(), scene);
        LightOptions options;
        options.filter = filter;
        options.samples = 2;
        options.depth = 1;
        const Camera camera{"slant", look_at({0, 0.5f, 3}, target), true, 0.2f};
        return take_picture(test_device(), lit, camera, {12, 12}, options);
    };
    const glm::vec3 to_floor(0, 0, 1), to_ceiling(0, 1, 1);
    const auto differ = [&](const Material& floor, const glm::vec3& target) {
        const auto both = picture(floor, target, TextureFilter::anisotropic);
        const auto wider = picture(floor, target, TextureFilter::trilinear);
        return both.direct != wider.direct;
    };
    CHECK(differ(matt(glm::vec3(0.5f)), to_ceiling));
    CHECK(differ(metal(glm::vec3(0.9f), 0.02f), to_floor));
    CHECK_FALSE(differ(matt(glm::vec3(0.5f)), to_floor));
    CHECK_FALSE(differ(metal(glm::vec3(0.9f), 0.5f), to_floor));
}

TEST_CASE("path_textures: the shadow of a fence that is cut out of a texture, texel by texel") {
    // 8 x 8 times a checkerboard of 2 x 2, between the floor and a point light.
    Material fence = matt(glm::vec3(0.5f));
    fence.alpha_mode = AlphaMode::mask;
    fence.base_color_texture.texture = 0;
    fence.base_color_texture.transform = glm::mat3(8, 0, 0, 0, 8, 0, 0, 0, 1);
    Scene scene;
    add_floor(scene, matt(glm::vec3(0.5f)));
    add_quad(scene, {-1, 0.75f, 1}, {2, 0, 0}, {0, 0, -2}, fence);
    scene.meshes.back().uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.images = {image("checks", {2, 2}, {0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 0})};
    scene.textures = {{0, Wrap::repeat, Wrap::repeat, true}};
    const glm::dvec3 light(0.25, 1.5, -0.125);
    scene.lights = {{"point", LightKind::point, glm::vec3(2.0f), glm::vec3(light)}};
    const LitScene lit(test_device(), scene);
    const std::uint32_t across = small_sizes() ? 6 : 61;
    LightOptions options;
    options.samples = 1;
    options.depth = 1;
    const float half = 0.5f;
    const auto picture = take_picture(test_device(), lit, camera_above(half, 0.5f), {across, across}, options);
    double passed = 0.0;
    for (std::uint32_t y = 0; y < across; ++y)
        for (std::uint32_t x = 0; x < across; ++x) {
            const glm::dvec3 p = floor_point(half, across, x, y), to = light - p;
            const double open = 2.0 * 0.5 / pi * to.y / std::pow(glm::length(to), 3);
            const double found = picture.light(3 * (across * y + x)) / open;
            passed += found / (across * across);
            CHECK((found == 0.0 || std::abs(found - 1.0) < 1e-4));
            // uv (0, 0) is at (-1, 1), and a block is 1/8 wide; its first row and column are open.
            const glm::dvec3 through = p + 0.5 * to;
            const glm::dvec2 block = 8.0 * glm::dvec2(through.x + 1.0, 1.0 - through.z);
            const glm::dvec2 inside = glm::fract(block);
            if (std::min({inside.x, inside.y, 1.0 - inside.x, 1.0 - inside.y}) < 1e-4) continue;
            const bool open_block = (int(std::floor(block.x)) + int(std::floor(block.y))) % 2 == 0;
            CHECK((found > 0.5) == open_block);
        }
    // That many independent places would have this standard error.
    CHECK(std::abs(passed - 0.5) < 3 * 0.5 / across);
}

TEST_SUITE_END();
