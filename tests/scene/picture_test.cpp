// SPDX-License-Identifier: MIT
#include "scene/picture.hpp"

#include <initializer_list>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "io/png16.hpp"

TEST_SUITE_BEGIN("scene");

using namespace boxwood;

namespace {

EncodedImage file_of(std::initializer_list<unsigned> bytes, std::size_t more = 0) {
    EncodedImage image{"picture", {}};
    for (const unsigned byte : bytes) image.bytes.push_back(static_cast<std::byte>(byte));
    image.bytes.resize(image.bytes.size() + more);
    return image;
}

} // namespace

TEST_CASE("picture: a picture comes back from PNG with one to four channels") {
    // What the channels are as RGBA: 5 x 3 pixels, so that rows and columns are told apart.
    for (std::uint32_t channels = 1; channels <= 4; ++channels) {
        CAPTURE(channels);
        std::vector<std::uint8_t> pixels(5 * 3 * channels);
        for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(7 * i);
        const EncodedImage image{"picture", encode_png("picture", {5, 3}, channels, pixels)};
        CHECK(picture_format(image.bytes) == PictureFormat::png);
        CHECK(picture_size(image).width == 5);
        const Picture picture = decode_picture(image);
        CHECK(picture.size.height == 3);
        REQUIRE(picture.rgba.size() == 60);
        for (std::size_t i = 0; i < 15; ++i) {
            const std::uint8_t* from = &pixels[i * channels];
            const bool alpha = channels % 2 == 0;
            for (std::size_t c = 0; c < 3; ++c) CHECK(picture.rgba[4 * i + c] == from[channels < 3 ? 0 : c]);
            CHECK(picture.rgba[4 * i + 3] == (alpha ? from[channels - 1] : 255));
        }
    }
}

TEST_CASE("picture: a PNG file of 16 bits keeps them, one of 8 stays as small as it is") {
    for (std::uint32_t channels = 1; channels <= 4; ++channels) {
        CAPTURE(channels);
        std::vector<std::uint16_t> values(5 * 3 * channels);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(1 + 1021 * i);
        const EncodedImage image{"picture", test::encode_png16({5, 3}, channels, values)};
        CHECK(is_wide(image));
        const Picture picture = decode_picture(image);
        CHECK(picture.size.width == 5);
        CHECK(picture.rgba.empty());
        REQUIRE(picture.rgba16.size() == 60);
        for (std::size_t i = 0; i < 15; ++i) {
            const std::uint16_t* from = &values[i * channels];
            for (std::size_t c = 0; c < 3; ++c) CHECK(picture.rgba16[4 * i + c] == from[channels < 3 ? 0 : c]);
            CHECK(picture.rgba16[4 * i + 3] == (channels % 2 == 0 ? from[channels - 1] : 65535));
        }
        EncodedImage cut = image;
        cut.bytes.resize(cut.bytes.size() / 2);
        CHECK_THROWS_AS(decode_picture(cut), InputError);
        cut.bytes.resize(20);
        CHECK(!is_wide(cut));
    }
    const EncodedImage narrow{"picture", encode_png("picture", {2, 2}, 1, std::vector<std::uint8_t>(4))};
    CHECK(!is_wide(narrow));
    CHECK(decode_picture(narrow).rgba16.empty());
    CHECK(!is_wide(file_of({0xff, 0xd8, 0xff})));
}

TEST_CASE("picture: what is no picture is refused") {
    CHECK_THROWS_AS(picture_size(file_of({})), InputError);
    CHECK_THROWS_AS(picture_size(file_of({'G', 'I', 'F', '8', '9', 'a'}, 100)), InputError);
    CHECK_THROWS_AS(picture_size(file_of({0xff, 0xd8, 0xff})), InputError);
    CHECK_THROWS_AS(decode_picture(file_of({0x89, 'P', 'N', 'G', 13, 10, 26, 10}, 100)), InputError);
    CHECK_THROWS_AS(encode_png("picture", {2, 2}, 3, std::vector<std::uint8_t>(11)), InputError);
    CHECK_THROWS_AS(encode_png("picture", {0, 2}, 3, {}), InputError);
}

TEST_CASE("picture: a picture that is too large or cut off says so") {
    EncodedImage image{"picture", encode_png("picture", {64, 64}, 3, std::vector<std::uint8_t>(64 * 64 * 3))};
    EncodedImage huge = image;
    for (const std::size_t at : {16, 20}) huge.bytes[at + 2] = std::byte{0xea}; // 59,968 x 59,968
    CHECK_THROWS_WITH_AS(picture_size(huge), doctest::Contains("2^30 bytes"), InputError);
    image.bytes.resize(50);
    CHECK_THROWS_WITH_AS(decode_picture(image), doctest::Contains("ends early"), InputError);
}

TEST_CASE("picture: a JPEG file with more codes in a table than there are symbols is refused") {
    // One segment DHT with 16 counts of 255, also where the file or the segment ends early.
    for (const std::size_t more : {0, 4, 5000}) {
        EncodedImage image = file_of({0xff, 0xd8, 0xff, 0xc4, 0x00, 0x13, 0x00});
        for (int i = 0; i < 16; ++i) image.bytes.push_back(std::byte{255});
        image.bytes.resize(image.bytes.size() + more);
        CHECK_THROWS_WITH_AS(picture_size(image), doctest::Contains("table of codes"), InputError);
    }
}

TEST_CASE("picture: a picture cannot ask for more memory than its size needs") {
    // The data of 4 million pixels under a head that says one: 12 MB from a file of some kB.
    EncodedImage image{"picture", encode_png("picture", {2048, 2048}, 3, std::vector<std::uint8_t>(3 << 22))};
    CHECK(decode_picture(image).rgba.size() == 4 << 22);
    CHECK(image.bytes.size() < 1 << 18);
    for (const std::size_t at : {16, 20})
        for (std::size_t i = 0; i < 4; ++i) image.bytes[at + i] = std::byte{i == 3};
    CHECK(picture_size(image).width == 1);
    CHECK_THROWS_AS(decode_picture(image), InputError);
}

TEST_SUITE_END();
