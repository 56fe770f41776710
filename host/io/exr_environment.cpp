// SPDX-License-Identifier: MIT
#include <exception>
#include <string>

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include "boxwood/environment.hpp"
#include "boxwood/error.hpp"
#include "boxwood/material.hpp"

namespace boxwood {

namespace {

/// Throws InputError unless there are R, G and B at full resolution, and not too many pixels.
void check(const std::string& file, const Imf::ChannelList& channels, std::int64_t width, std::int64_t height) {
    constexpr std::int64_t most = std::int64_t{1} << 26;
    for (const char* name : {"R", "G", "B"}) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (channel == nullptr) throw InputError(file, std::string("channel ") + name, "there is none");
        if (channel->xSampling != 1 || channel->ySampling != 1)
            throw InputError(file, std::string("channel ") + name, "is not sampled in every pixel");
    }
    if (width < 1 || height < 1 || width > most || height > most || width * height > most)
        throw InputError(file, "data window",
                         std::to_string(width) + " x " + std::to_string(height) + " pixels; at most 2^26");
}

Environment read(const std::string& file) {
    Imf::InputFile input(file.c_str());
    const Imath::Box2i window = input.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    check(file, input.header().channels(), width, height);
    Environment environment;
    environment.width = static_cast<std::uint32_t>(width);
    environment.height = static_cast<std::uint32_t>(height);
    environment.pixels.resize(static_cast<std::size_t>(width * height));
    const char* const names[3] = {"R", "G", "B"};
    Imf::FrameBuffer frame;
    for (int c = 0; c < 3; ++c)
        frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, &environment.pixels[0][c], window, sizeof(glm::vec3),
                                                sizeof(glm::vec3) * environment.width));
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
    return environment;
}

} // namespace

Environment load_environment(const std::filesystem::path& file, std::vector<std::string>& warnings) {
    Environment environment;
    try {
        environment = read(file.string());
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(file.string(), "", error.what());
    }
    std::size_t replaced = 0;
    for (glm::vec3& pixel : environment.pixels)
        for (int c = 0; c < 3; ++c)
            if (!(pixel[c] >= 0.0f && pixel[c] <= largest_radiance)) {
                pixel[c] = pixel[c] > 0.0f ? largest_radiance : 0.0f;
                ++replaced;
            }
    if (replaced > 0)
        warnings.push_back(std::to_string(replaced) +
                           " values that are no radiance are 0, or 2^60 where they are larger");
    return environment;
}

} // namespace boxwood
