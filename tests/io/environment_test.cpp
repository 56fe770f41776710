// SPDX-License-Identifier: MIT
// Environments in OpenEXR files, those of other programs among them.
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <doctest/doctest.h>

#include "boxwood/environment.hpp"
#include "boxwood/error.hpp"
#include "boxwood/image.hpp"
#include "boxwood/material.hpp"
#include "io/samples.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("io");

TEST_CASE("environment: an OpenEXR file comes back, what is no radiance as the nearest, with a warning") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "light.exr";
    Image image{3, 2, {}};
    for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, std::vector<float>{1, 2, 3, 4, 5, 6}});
    std::get<std::vector<float>>(image.channels[1].samples)[4] = -1.0f;
    std::get<std::vector<float>>(image.channels[0].samples)[3] = std::numeric_limits<float>::infinity();
    std::get<std::vector<float>>(image.channels[1].samples)[3] = 2e18f;
    std::get<std::vector<float>>(image.channels[2].samples)[3] = -std::numeric_limits<float>::infinity();
    std::get<std::vector<float>>(image.channels[2].samples)[5] = std::numeric_limits<float>::quiet_NaN();
    save_exr(file, image);
    std::vector<std::string> warnings;
    const Environment e = load_environment(file, warnings);
    CHECK(e.width == 3);
    CHECK(e.height == 2);
    CHECK(e.pixels[1] == glm::vec3(2.0f));
    CHECK(e.pixels[3] == glm::vec3(largest_radiance, largest_radiance, 0));
    CHECK(e.pixels[4] == glm::vec3(5, 0, 5));
    CHECK(e.pixels[5] == glm::vec3(6, 6, 0));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].starts_with("5 values"));
    image.channels.pop_back();
    save_exr(file, image);
    CHECK_THROWS_AS(load_environment(file, warnings), InputError);
    std::filesystem::remove(file);
    CHECK_THROWS_AS(load_environment(file, warnings), InputError);
}

TEST_CASE("environment: luminance alone is grey, other channels are named") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "light.exr";
    const auto save = [&](const std::vector<std::string>& names) {
        Image image{2, 1, {}};
        for (const std::string& name : names)
            image.channels.push_back({name, std::vector<float>{1.5f, std::numeric_limits<float>::quiet_NaN()}});
        save_exr(file, image);
    };
    std::vector<std::string> warnings;
    save({"Y", "A"});
    CHECK(load_environment(file, warnings).pixels == std::vector<glm::vec3>{glm::vec3(1.5f), glm::vec3(0.0f)});
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].starts_with("1 values")); // of the file, not of the pixel's three
    save({"Y", "R", "G", "B"});
    CHECK(load_environment(file, warnings).pixels[0] == glm::vec3(1.5f));
    for (const auto& [names, listed] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"view.R", "view.G", "view.B"}, "there are view.B, view.G, view.R; needed are R, G and B, or Y alone"},
             {{"R", "G"}, "there are G, R; "},
             {{"Y", "RY", "BY"}, "there are BY, RY, Y; "}}) {
        save(names);
        CHECK_THROWS_WITH_AS(load_environment(file, warnings), doctest::Contains(listed.c_str()), InputError);
    }
    save(std::vector<std::string>{std::string(250, 'x')});
    CHECK_THROWS_WITH_AS(load_environment(file, warnings), doctest::Contains("xx ...; needed"), InputError);
}

TEST_CASE("environment: of a file of several parts the first with colours is read, or the channels of all are named") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "parts.exr";
    const auto save = [&](const std::vector<std::string>& last) {
        std::vector<float> values{1, 2};
        std::vector<Imf::Header> headers;
        for (const std::vector<std::string>& names : {std::vector<std::string>{"Z"}, last}) {
            Imf::Header& header = headers.emplace_back(2, 1);
            header.setName(headers.size() == 1 ? "depth" : "beauty");
            header.setType(Imf::SCANLINEIMAGE);
            for (const std::string& name : names) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        }
        Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(headers.size()));
        for (int part = 0; part < 2; ++part) {
            Imf::FrameBuffer frame;
            const Imf::ChannelList& channels = headers[static_cast<std::size_t>(part)].channels();
            for (auto channel = channels.begin(); channel != channels.end(); ++channel)
                frame.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                                        sizeof(float), 2 * sizeof(float)));
            Imf::OutputPart writer(output, part);
            writer.setFrameBuffer(frame);
            writer.writePixels(1);
        }
    };
    std::vector<std::string> warnings;
    save({"R", "G", "B"});
    CHECK(load_environment(file, warnings).pixels[1] == glm::vec3(2.0f));
    save({"N.X"});
    CHECK_THROWS_WITH_AS(load_environment(file, warnings), doctest::Contains("there are depth: Z; beauty: N.X; "),
                         InputError);
}

TEST_CASE("environment: infinity of 16 bits is the largest value of 16 bits, with a warning") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "half.exr";
    std::vector<half> values{half(1.0f), half::posInf(), half::qNan(), half::negInf()};
    Imf::Header header(4, 1);
    Imf::FrameBuffer frame;
    for (const char* name : {"R", "G", "B"}) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        frame.insert(name,
                     Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), sizeof(half), 4 * sizeof(half)));
    }
    {
        Imf::OutputFile output(file.c_str(), header);
        output.setFrameBuffer(frame);
        output.writePixels(1);
    }
    std::vector<std::string> warnings;
    const Environment e = load_environment(file, warnings);
    CHECK(e.pixels[0] == glm::vec3(1.0f));
    CHECK(e.pixels[1] == glm::vec3(65504.0f));
    CHECK(e.pixels[2] == glm::vec3(0.0f));
    CHECK(e.pixels[3] == glm::vec3(0.0f));
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[0].starts_with("3 infinite values"));
    CHECK(warnings[1].starts_with("6 values"));
}

TEST_SUITE_END();
