// SPDX-License-Identifier: MIT
#include <exception>
#include <limits>
#include <set>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "boxwood/error.hpp"
#include "boxwood/image.hpp"
#include "io/atomic_file.hpp"

namespace boxwood {

namespace {

/// Lets OpenEXR write to a std::ostream. A failed write is left to AtomicFile::commit to report.
class StreamAdapter : public Imf::OStream {
public:
    StreamAdapter(std::ostream& out, const std::string& file) : Imf::OStream(file.c_str()), out_(out) {}

    void write(const char bytes[], int count) override { out_.write(bytes, count); }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(out_.tellp()); }
    void seekp(std::uint64_t position) override { out_.seekp(static_cast<std::streamoff>(position)); }

private:
    std::ostream& out_;
};

std::size_t sample_count(const Channel& channel) {
    return std::visit([](const auto& samples) { return samples.size(); }, channel.samples);
}

void check_name(const std::string& name, const std::string& where, const std::string& file) {
    // OpenEXR stores names as C strings of at most 255 bytes.
    if (name.empty() || name.size() > 255 || name.find('\0') != std::string::npos)
        throw InputError(file, where, "a name must have 1 to 255 characters");
}

void check(const Image& image, const std::string& file) {
    constexpr auto largest = static_cast<std::uint32_t>(std::numeric_limits<int>::max() / 2); // of OpenEXR
    if (image.width == 0 || image.height == 0) throw InputError(file, "", "an image without pixels cannot be written");
    if (image.width > largest || image.height > largest)
        throw InputError(file, "", "the image is too large for OpenEXR");
    if (image.channels.empty()) throw InputError(file, "", "an image without channels cannot be written");
    const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
    std::set<std::string_view> names;
    for (const Channel& channel : image.channels) {
        const std::string where = "channel " + channel.name;
        check_name(channel.name, where, file);
        if (!names.insert(channel.name).second) throw InputError(file, where, "the name is repeated");
        if (sample_count(channel) != pixels) {
            throw InputError(file, where,
                             "has " + std::to_string(sample_count(channel)) + " samples for " + std::to_string(pixels) +
                                 " pixels");
        }
    }
}

void insert(Imf::Header& header, const std::string& name, const std::string& text) {
    header.insert(name, Imf::StringAttribute(text));
}
void insert(Imf::Header& header, const std::string& name, float number) {
    header.insert(name, Imf::FloatAttribute(number));
}
void insert(Imf::Header& header, const std::string& name, std::int32_t number) {
    header.insert(name, Imf::IntAttribute(number));
}
void insert(Imf::Header& header, const std::string& name, const glm::mat4& matrix) {
    Imath::M44f rows; // acts on rows: its rows are the columns
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) rows[i][j] = matrix[i][j];
    header.insert(name, Imf::M44fAttribute(rows));
}

void insert_attributes(Imf::Header& header, const Image& image, const std::string& file) {
    for (const auto& [name, attribute] : image.attributes) {
        const std::string where = "attribute " + name;
        check_name(name, where, file);
        if (header.find(name) != header.end()) throw InputError(file, where, "is one of OpenEXR's own");
        std::visit([&, &key = name](const auto& value) { insert(header, key, value); }, attribute);
    }
}

template <class T>
Imf::Slice slice_of(const std::vector<T>& samples, std::uint32_t width) {
    constexpr auto type = std::is_same_v<T, float> ? Imf::FLOAT : Imf::UINT;
    // OpenEXR takes one kind of slice for reading and writing; it does not write through this one.
    auto* const base = reinterpret_cast<char*>(const_cast<T*>(samples.data()));
    return Imf::Slice(type, base, sizeof(T), sizeof(T) * width);
}

void write(std::ostream& out, const Image& image, const std::string& file) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    insert_attributes(header, image, file);
    Imf::FrameBuffer pixels;
    for (const Channel& channel : image.channels) {
        const Imf::Slice slice =
            std::visit([&](const auto& samples) { return slice_of(samples, image.width); }, channel.samples);
        header.channels().insert(channel.name, Imf::Channel(slice.type));
        pixels.insert(channel.name, slice);
    }
    StreamAdapter adapter(out, file);
    Imf::OutputFile output(adapter, header); // its destructor completes the file
    output.setFrameBuffer(pixels);
    output.writePixels(static_cast<int>(image.height));
}

} // namespace

void save_exr(const std::filesystem::path& file, const Image& image) {
    check(image, file.string());
    AtomicFile out(file);
    try {
        write(out.stream(), image, file.string());
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& problem) {
        throw OutputError(file.string(), std::string("OpenEXR cannot write it: ") + problem.what());
    }
    out.commit();
}

} // namespace boxwood
