// SPDX-License-Identifier: MIT
#include <array>
#include <exception>
#include <limits>
#include <string>

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include "boxwood/environment.hpp"
#include "boxwood/error.hpp"
#include "boxwood/material.hpp"

namespace boxwood {

namespace {

constexpr float largest_half = 65504.0f;

using Names = std::array<const char*, 3>; ///< Of the channels that are red, green and blue.
constexpr Names colors{"R", "G", "B"}, grey{"Y", "Y", "Y"};

bool has(const Imf::ChannelList& channels, const Names& names) {
    for (const char* name : names)
        if (channels.findChannel(name) == nullptr) return false;
    return true;
}

/// Luminance alone, not the one beside chroma.
bool is_grey(const Imf::ChannelList& channels) {
    return has(channels, grey) && channels.findChannel("RY") == nullptr && channels.findChannel("BY") == nullptr;
}

/// "B, G, R", with the part's name before it in a file of several; the first few of very many.
std::string listed(const Imf::MultiPartInputFile& input) {
    constexpr std::size_t most = 200;
    std::string text;
    for (int part = 0; part < input.parts(); ++part) {
        const Imf::Header& header = input.header(part);
        if (!text.empty()) text += "; ";
        if (header.hasName()) text += header.name() + ": ";
        const Imf::ChannelList& channels = header.channels();
        for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
            if (channel != channels.begin()) text += ", ";
            text += channel.name();
            if (text.size() > most) return text.substr(0, most) + " ...";
        }
    }
    return text.empty() ? "none" : text;
}

/// A part and its channels to read.
struct Source {
    int part;
    Names names;
};

/// The first part that has R, G and B, else the first that has Y.
Source find_source(const std::string& file, const Imf::MultiPartInputFile& input) {
    for (int part = 0; part < input.parts(); ++part)
        if (has(input.header(part).channels(), colors)) return {part, colors};
    for (int part = 0; part < input.parts(); ++part)
        if (is_grey(input.header(part).channels())) return {part, grey};
    throw InputError(file, "channels", "there are " + listed(input) + "; needed are R, G and B, or Y alone");
}

/// Throws InputError unless the channels are at full resolution, and there are not too many pixels.
void check(const std::string& file, const Imf::ChannelList& channels, const Names& names, std::int64_t width,
           std::int64_t height) {
    constexpr std::int64_t most = std::int64_t{1} << 26;
    for (const char* name : names) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (channel->xSampling != 1 || channel->ySampling != 1)
            throw InputError(file, std::string("channel ") + name, "is not sampled in every pixel");
    }
    if (width < 1 || height < 1 || width > most || height > most || width * height > most)
        throw InputError(file, "data window",
                         std::to_string(width) + " x " + std::to_string(height) + " pixels; at most 2^26");
}

/// Replaces what is no radiance in `channel` of the pixels, counted in `infinite` (of 16 bits) and `faults`.
struct Replacements {
    std::size_t infinite = 0;
    std::size_t faults = 0;

    void replace(int channel, bool is_half, std::vector<glm::vec3>& pixels) {
        for (glm::vec3& pixel : pixels) {
            float& value = pixel[channel];
            if (is_half && value == std::numeric_limits<float>::infinity()) { // of what 16 bits could not hold
                value = largest_half;
                ++infinite;
            } else if (!(value >= 0.0f && value <= largest_radiance)) {
                value = value > 0.0f ? largest_radiance : 0.0f;
                ++faults;
            }
        }
    }

    void warn(std::vector<std::string>& warnings) const {
        if (infinite > 0)
            warnings.push_back(std::to_string(infinite) +
                               " infinite values of 16 bits are 65504, the largest of those");
        if (faults > 0)
            warnings.push_back(std::to_string(faults) +
                               " values that are no radiance are 0, or 2^60 where they are larger");
    }
};

Environment read(const std::string& file, std::vector<std::string>& warnings) {
    Imf::MultiPartInputFile input(file.c_str());
    const Source source = find_source(file, input);
    const Imf::Header& header = input.header(source.part);
    const Imath::Box2i window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    check(file, header.channels(), source.names, width, height);
    Environment environment;
    environment.width = static_cast<std::uint32_t>(width);
    environment.height = static_cast<std::uint32_t>(height);
    environment.pixels.resize(static_cast<std::size_t>(width * height));
    const int channels = source.names == colors ? 3 : 1;
    Imf::FrameBuffer frame;
    for (int c = 0; c < channels; ++c)
        frame.insert(source.names[c], Imf::Slice::Make(Imf::FLOAT, &environment.pixels[0][c], window, sizeof(glm::vec3),
                                                       sizeof(glm::vec3) * environment.width));
    Imf::InputPart part(input, source.part);
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
    Replacements replacements;
    for (int c = 0; c < channels; ++c)
        replacements.replace(c, header.channels().findChannel(source.names[c])->type == Imf::HALF, environment.pixels);
    replacements.warn(warnings);
    if (channels == 1)
        for (glm::vec3& pixel : environment.pixels) pixel = glm::vec3(pixel.x);
    return environment;
}

} // namespace

Environment load_environment(const std::filesystem::path& file, std::vector<std::string>& warnings) {
    try {
        return read(file.string(), warnings);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(file.string(), "", error.what());
    }
}

} // namespace boxwood
