// SPDX-License-Identifier: MIT
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "boxwood/image.hpp"
#include "io/samples.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::TemporaryFolder;

TEST_CASE("png: a PNG file gives back every pixel, as stb_image reads it") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "image.png";
    const std::uint32_t width = 5; // odd, and different from the height, to tell rows from columns
    const std::uint32_t height = 3;
    std::vector<std::uint8_t> rgb(3 * width * height);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(255 - 5 * i);
    save_png(file, width, height, rgb);

    int read_width = 0;
    int read_height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load(file.c_str(), &read_width, &read_height, &channels, 0), stbi_image_free);
    REQUIRE(pixels);
    CHECK(read_width == 5);
    CHECK(read_height == 3);
    REQUIRE(channels == 3);
    CHECK(std::vector<std::uint8_t>(pixels.get(), pixels.get() + rgb.size()) == rgb);
    CHECK(folder.entries() == 1);
}

TEST_CASE("png: an image that PNG cannot hold is refused and nothing is written") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "image.png";
    const std::vector<std::uint8_t> twelve(12);
    CHECK_THROWS_AS(save_png(file, 2, 3, twelve), InputError);
    CHECK_THROWS_AS(save_png(file, 2, 1, twelve), InputError);
    CHECK_THROWS_AS(save_png(file, 0, 2, {}), InputError);
    CHECK_THROWS_AS(save_png(file, 0xffffffffu, 0xffffffffu, twelve), InputError);
    CHECK(folder.entries() == 0);
    CHECK_THROWS_AS(save_png(folder.path() / "missing" / "a.png", 2, 2, twelve), OutputError);
}

TEST_SUITE_END();
