// SPDX-License-Identifier: MIT
// Fuzz target for the .bxw reader. The first byte of an input chooses: 255 is the rest as a file, which tries header
// and table; below that, one of six sample files is edited and sealed with right checksums, which tries all that a
// checksum would else keep from the fuzzer. An accepted file must be written and read again to the same values.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "boxwood/error.hpp"
#include "io/bxw_parts.hpp"
#include "io/samples.hpp"

using namespace boxwood;
using namespace boxwood::test;

namespace {

constexpr std::uint8_t raw_file = 255;

const std::array<std::vector<std::string>, 6>& samples() {
    static const auto made = [] {
        const Scene scene = sample_scene();
        std::array<std::vector<std::string>, 6> result;
        for (std::size_t i = 0; i < result.size(); ++i) {
            const Layout layout = i % 3 == 1 ? Layout::wide8 : Layout::binary;
            const Bounds bounds = i % 3 == 2 ? Bounds::obb_points : Bounds::aabb;
            const Levels levels = i < 3 ? Levels::one : Levels::two;
            TreeImage tree = sample_tree(scene, layout, levels, bounds);
            if (levels == Levels::one && bounds == Bounds::aabb) add_sample_area(tree);
            result[i] = sections_of(bxw_bytes(scene, tree));
        }
        return result;
    }();
    return made;
}

/// One edit: a section, what to do to it, where and with which value. Five bytes of input.
void edit(std::vector<std::string>& sections, std::span<const std::uint8_t, 5> bytes) {
    std::string& section = sections[bytes[0] % sections.size()];
    const std::size_t offset = bytes[2] | static_cast<std::size_t>(bytes[3]) << 8;
    const char value = static_cast<char>(bytes[4]);
    switch (bytes[1] % 4) {
    case 0: // a byte
        if (!section.empty()) section[offset % section.size()] = value;
        break;
    case 1: // four equal bytes, for the words that are all ones or zero
        for (std::size_t i = 0; i < 4 && offset + i < section.size(); ++i) section[offset + i] = value;
        break;
    case 2: // another length
        section.resize(offset % (section.size() + 257), value);
        break;
    default: // a bit
        if (!section.empty()) section[offset % section.size()] ^= static_cast<char>(1 << (bytes[4] % 8));
    }
}

std::string file_of(std::span<const std::uint8_t> input) {
    if (input.empty()) return {};
    const std::uint8_t choice = input.front();
    input = input.subspan(1);
    if (choice == raw_file) return {input.begin(), input.end()};
    std::vector<std::string> sections = samples()[choice % samples().size()];
    for (; input.size() >= 5; input = input.subspan(5)) edit(sections, input.first<5>());
    return seal(sections);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string file = file_of({data, size});
    BxwFile loaded;
    try {
        loaded = read_bxw(file);
    } catch (const InputError&) {
        return 0;
    }
    const BxwFile again = read_bxw(bxw_bytes(loaded.scene, loaded.tree));
    if (!same(again.scene, loaded.scene) || !same(again.tree, loaded.tree)) std::abort();
    return 0;
}
