// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/png16.hpp"
#include "render/appearance_scenes.hpp"
#include "render/texture_levels.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

double srgb_to_linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
double linear_to_srgb(double l) { return l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055; }

} // namespace

TEST_CASE_TEMPLATE(
    "appearance_textures: levels of detail are means by area, in linear light, of pictures of any size and depth", Code,
    std::uint8_t, std::uint16_t) {
    constexpr std::size_t bits = 8 * sizeof(Code), in_a_word = 32 / bits;
    constexpr double largest = std::numeric_limits<Code>::max();
    // Powers of two, odd, one across, and one texel.
    for (const PictureSize size : {PictureSize{8, 4}, {7, 5}, {1, 6}, {13, 1}, {1, 1}, {3, 3}}) {
        const std::vector<Code> rgba = noise<Code>(size, size.width);
        Picture picture{size, {}};
        if constexpr (sizeof(Code) == 1)
            picture.rgba = rgba;
        else
            picture.rgba16 = rgba;
        for (const bool srgb : {false, true}) {
            CAPTURE(size.width);
            CAPTURE(srgb);
            const std::vector<std::uint32_t> levels = texture_levels(picture, srgb);
            REQUIRE(levels.size() * in_a_word == 4 * level_texels(size));
            const auto code = [&](std::size_t texel, std::size_t c) {
                const std::size_t place = 4 * texel + c;
                return levels[place / in_a_word] >> bits * (place % in_a_word) & std::numeric_limits<Code>::max();
            };
            for (std::size_t i = 0; i < std::size_t{size.width} * size.height; ++i)
                for (std::size_t c = 0; c < 4; ++c) CHECK(code(i, c) == rgba[4 * i + c]);
            const std::uint32_t width = std::max(1u, size.width / 2), height = std::max(1u, size.height / 2);
            if (level_count(size) == 1) continue;
            // Each texel of level 0 as width x height equal pieces: a texel of level 1 is a block of them.
            for (std::uint32_t y = 0; y < height; ++y)
                for (std::uint32_t x = 0; x < width; ++x)
                    for (std::uint32_t c = 0; c < 4; ++c) {
                        double sum = 0;
                        for (std::uint32_t v = 0; v < size.height; ++v)
                            for (std::uint32_t u = 0; u < size.width; ++u) {
                                const std::uint32_t px = (x * size.width + u) / width,
                                                    py = (y * size.height + v) / height;
                                const double value = rgba[4 * (py * size.width + px) + c] / largest;
                                sum += srgb && c < 3 ? srgb_to_linear(value) : value;
                            }
                        sum /= size.width * size.height;
                        const double expected = largest * (srgb && c < 3 ? linear_to_srgb(sum) : sum);
                        const std::size_t at = std::size_t{size.width} * size.height + y * width + x;
                        CHECK(std::abs(code(at, c) - expected) < 0.51);
                    }
        }
        const glm::dvec3 mean = mean_color(picture, true);
        double sum = 0;
        for (std::size_t i = 0; i < rgba.size(); i += 4) sum += srgb_to_linear(rgba[i] / largest);
        CHECK(mean.x == doctest::Approx(sum / static_cast<double>(rgba.size() / 4)));
    }
}

TEST_CASE("appearance_textures: a picture of 16 bits takes two words a texel, beside others that take one") {
    Material material;
    material.base_color_texture.texture = 0;
    material.normal_texture.texture = 1;
    Scene scene = one_square(material);
    const std::vector<std::uint16_t> values{1, 2, 3, 4, 60000, 60001, 60002, 60003};
    scene.images = {{"wide", encode_png16({2, 1}, 4, values)}, image("narrow", {1, 1}, {1, 2, 3, 4})};
    scene.textures = {{0}, {1}};
    CHECK(shading_requirements(scene).wide_texels);
    const Appearance appearance = appearance_of(scene);
    const auto records = download(test_device(), appearance.textures);
    REQUIRE(records.size() == 2);
    CHECK(records[0].format == (BOXWOOD_SRGB | BOXWOOD_WIDE));
    CHECK(records[1].format == 0);
    CHECK(records[1].first_texel == 6);
    const auto words = download(test_device(), appearance.texels);
    REQUIRE(words.size() == 7);
    for (std::size_t i = 0; i < 4; ++i) CHECK(words[i] == (values[2 * i] | std::uint32_t{values[2 * i + 1]} << 16));
    CHECK(words[6] == 0x04030201u);

    scene.images[0].bytes.resize(60); // broken: a grey texel of one word
    CHECK(shading_requirements(scene).wide_texels);
    std::vector<std::string> warnings;
    const Appearance broken = appearance_of(scene, warnings);
    CHECK(warnings.size() == 1);
    CHECK(download(test_device(), broken.textures)[0].format == BOXWOOD_SRGB);
    CHECK(download(test_device(), broken.texels)[0] == 0xff808080u);
    scene.textures[0].image = 1;
    CHECK(!shading_requirements(scene).wide_texels); // no texture in use shows it
}

TEST_CASE("appearance_textures: a picture is stored once per encoding, a record once per texture and encoding") {
    Material material;
    material.base_color_texture.texture = 0;
    material.occlusion_texture.texture = 0;
    material.metallic_roughness_texture.texture = 1;
    material.normal_texture.texture = 1;
    material.emission_texture = {2, 1, glm::mat3(2, 0, 0, 0, 3, 0, 0.25f, 0.5f, 1)};
    material.emission = {1, 1, 1};
    Scene scene = one_square(material);
    scene.images = {image("a", {4, 4}, noise({4, 4}, 1)), image("b", {2, 1}, {255, 0, 0, 255, 0, 0, 0, 255})};
    scene.textures = {{0}, {0, Wrap::clamp, Wrap::mirror, true}, {1}};
    const Appearance appearance = appearance_of(scene);
    const auto records = download(test_device(), appearance.textures);
    REQUIRE(records.size() == 4); // 0 as colour, 0 as numbers, 1 as numbers, 2 as colour
    CHECK(appearance.texels.size() == 21 + 21 + 3);
    const auto material_records = download(test_device(), appearance.materials);
    const TextureInput* inputs = material_records[0].textures;
    const auto record = [&](int place) { return records[inputs[place].texture]; };
    CHECK(record(BOXWOOD_BASE_COLOR).format == BOXWOOD_SRGB);
    CHECK(record(BOXWOOD_OCCLUSION).format == 0);
    CHECK(record(BOXWOOD_OCCLUSION).first_texel == record(BOXWOOD_NORMAL).first_texel);
    CHECK(record(BOXWOOD_BASE_COLOR).first_texel != record(BOXWOOD_NORMAL).first_texel);
    CHECK(inputs[BOXWOOD_METALLIC_ROUGHNESS].texture == inputs[BOXWOOD_NORMAL].texture);
    CHECK(record(BOXWOOD_NORMAL).wrap_u == 2);
    CHECK(record(BOXWOOD_NORMAL).wrap_v == 1);
    CHECK(record(BOXWOOD_NORMAL).nearest == 1);
    CHECK(record(BOXWOOD_EMISSION).width == 2);
    CHECK(record(BOXWOOD_EMISSION).levels == 2);
    CHECK(inputs[BOXWOOD_EMISSION].uv_set == 1);
    const float rows[] = {2, 0, 0.25f, 0, 3, 0.5f};
    for (int i = 0; i < 6; ++i) CHECK(inputs[BOXWOOD_EMISSION].rows[i] == rows[i]);
    // Nothing of it without the requirement.
    ShadingRequirements needs = shading_requirements(scene);
    needs.textures = false;
    std::vector<std::string> warnings;
    const Appearance untextured = upload_appearance(test_device(), scene, needs, warnings);
    CHECK(untextured.textures.size() == 0);
    CHECK(untextured.texels.size() == 0);
    CHECK(download(test_device(), untextured.materials)[0].textures[0].texture == BOXWOOD_NONE);
}

TEST_CASE("appearance_textures: pictures that cannot be read are grey, or flat, and named") {
    Material material;
    material.base_color_texture.texture = 0;
    material.normal_texture.texture = 0;
    Scene scene = one_square(material);
    scene.textures = {{0}};
    const EncodedImage good = image("good", {8, 8}, noise({8, 8}, 3));
    EncodedImage truncated = good, huge = good, gif = good;
    truncated.bytes.resize(truncated.bytes.size() / 2);
    for (const std::size_t at : {16, 20}) { // width and height in the header: 65536 x 65536
        huge.bytes[at + 1] = std::byte{1};
        huge.bytes[at + 3] = std::byte{0};
    }
    gif.bytes[0] = std::byte{'G'};
    for (const EncodedImage& bad : {truncated, huge, gif, EncodedImage{"none", {}}}) {
        scene.images = {bad};
        std::vector<std::string> warnings;
        const Appearance appearance = appearance_of(scene, warnings);
        REQUIRE(warnings.size() == 1); // for both uses
        CHECK(warnings[0].starts_with("images[0] (" + bad.name + "): "));
        CHECK(warnings[0].find(bad.name) == warnings[0].rfind(bad.name));
        const auto records = download(test_device(), appearance.textures);
        REQUIRE(records.size() == 2);
        CHECK(records[0].width == 1);
        CHECK(records[0].height == 1);
        CHECK(records[0].levels == 1);
        CHECK(download(test_device(), appearance.texels)[records[0].first_texel] == 0xff808080u);
        const MaterialRecord record = download(test_device(), appearance.materials)[0];
        CHECK(record.textures[BOXWOOD_BASE_COLOR].texture == 0);
        CHECK(record.textures[BOXWOOD_NORMAL].texture == BOXWOOD_NONE);
    }
}

TEST_SUITE_END();
