// SPDX-License-Identifier: MIT
#include <limits>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "boxwood/image.hpp"
#include "io/samples.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::TemporaryFolder;

namespace {

template <class T>
std::vector<T> read_channel(Imf::InputFile& in, const std::string& name, Imf::PixelType type) {
    const auto window = in.header().dataWindow();
    const std::size_t width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const std::size_t height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
    std::vector<T> samples(width * height);
    Imf::FrameBuffer pixels;
    pixels.insert(name, Imf::Slice(type, reinterpret_cast<char*>(samples.data()), sizeof(T), sizeof(T) * width));
    in.setFrameBuffer(pixels);
    in.readPixels(window.min.y, window.max.y);
    return samples;
}

std::vector<float> ramp(std::size_t size) {
    std::vector<float> values(size);
    for (std::size_t i = 0; i < size; ++i) values[i] = 0.1f * static_cast<float>(i);
    return values;
}

} // namespace

TEST_CASE("exr: an EXR file gives back every channel, as OpenEXR reads it") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "image.exr";
    // 35 rows: OpenEXR compresses ZIP in blocks of 16, so two full blocks and a part.
    const std::uint32_t width = 7;
    const std::uint32_t height = 35;
    std::vector<float> depth = ramp(width * height);
    depth[3] = std::numeric_limits<float>::infinity(); // what a miss looks like
    std::vector<std::uint32_t> ids(width * height, 0xffffffffu);
    ids[5] = 0x7fffffffu; // would not survive a float
    const std::vector<float> red(width * height, 1.0f / 3.0f);
    save_exr(file, {width, height, {{"normal.X", red}, {"depth.Z", depth}, {"instance.id", ids}, {"R", red}}});

    Imf::InputFile in(file.c_str());
    CHECK(in.header().dataWindow().max.x == 6);
    CHECK(in.header().dataWindow().max.y == 34);
    CHECK(in.header().compression() == Imf::ZIP_COMPRESSION);
    CHECK(in.header().channels().findChannel("depth.Z")->type == Imf::FLOAT);
    CHECK(in.header().channels().findChannel("instance.id")->type == Imf::UINT);
    CHECK(read_channel<float>(in, "depth.Z", Imf::FLOAT) == depth);
    CHECK(read_channel<float>(in, "normal.X", Imf::FLOAT) == red);
    CHECK(read_channel<float>(in, "R", Imf::FLOAT) == red);
    CHECK(read_channel<std::uint32_t>(in, "instance.id", Imf::UINT) == ids);
    CHECK(folder.entries() == 1);
}

TEST_CASE("exr: an EXR file's header says what the image's attributes say, and nothing of the day") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "image.exr", again = folder.path() / "again.exr";
    Image image{2, 2, {{"R", ramp(4)}}};
    glm::mat4 matrix(1.0f);
    matrix[3] = {5, 6, 7, 1}; // a translation: of columns in the last column, of rows in the last row
    image.attributes = {{"integrator", std::string("path")}, {"fov", 0.5f}, {"samples", 12}, {"worldToCamera", matrix}};
    save_exr(file, image);
    save_exr(again, image);
    CHECK(boxwood::test::read_bytes(file) == boxwood::test::read_bytes(again));

    const Imf::InputFile in(file.c_str());
    const Imf::Header& header = in.header();
    CHECK(header.typedAttribute<Imf::StringAttribute>("integrator").value() == "path");
    CHECK(header.typedAttribute<Imf::FloatAttribute>("fov").value() == 0.5f);
    CHECK(header.typedAttribute<Imf::IntAttribute>("samples").value() == 12);
    const Imath::M44f rows = header.typedAttribute<Imf::M44fAttribute>("worldToCamera").value();
    CHECK(rows[3][0] == 5.0f);
    CHECK(rows[3][2] == 7.0f);
    CHECK(rows[0][3] == 0.0f);
    CHECK(header.findTypedAttribute<Imf::StringAttribute>("capDate") == nullptr);
}

TEST_CASE("exr: an attribute that EXR has itself, or that has no name, is refused") {
    const TemporaryFolder folder;
    for (const std::string& name : {std::string("channels"), std::string("compression"), std::string()}) {
        Image image{2, 2, {{"R", ramp(4)}}};
        image.attributes[name] = 1;
        CHECK_THROWS_AS(save_exr(folder.path() / "image.exr", image), InputError);
    }
    CHECK(folder.entries() == 0);
}

TEST_CASE("exr: an image that EXR cannot hold is refused and nothing is written") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "image.exr";
    const auto where = [&](const Image& image) -> std::string {
        try {
            save_exr(file, image);
        } catch (const InputError& error) {
            CHECK(error.file == file.string());
            return error.where;
        }
        return "accepted";
    };
    const std::vector<float> four = ramp(4);
    CHECK(where({2, 2, {{"R", four}, {"G", ramp(3)}}}) == "channel G");
    CHECK(where({2, 2, {{"R", four}, {"id", std::vector<std::uint32_t>(5)}}}) == "channel id");
    CHECK(where({2, 2, {{"R", four}, {"R", four}}}) == "channel R");
    CHECK(where({2, 2, {{"", four}}}) == "channel ");
    CHECK(where({2, 2, {{std::string(256, 'x'), four}}}) == "channel " + std::string(256, 'x'));
    CHECK(where({2, 2, {}}) == "");
    CHECK(where({0, 2, {{"R", {}}}}) == "");
    CHECK(where({0xffffffffu, 1, {{"R", four}}}) == "");
    CHECK(folder.entries() == 0);
    CHECK_THROWS_AS(save_exr(folder.path() / "missing" / "a.exr", {2, 2, {{"R", four}}}), OutputError);
}

TEST_CASE("exr: a channel name of 255 characters is kept") { // more than the 31 of OpenEXR's short names
    const TemporaryFolder folder;
    const auto file = folder.path() / "image.exr";
    const std::string name(255, 'n');
    save_exr(file, {2, 2, {{name, ramp(4)}}});
    Imf::InputFile in(file.c_str());
    CHECK(read_channel<float>(in, name, Imf::FLOAT) == ramp(4));
}

TEST_SUITE_END();
