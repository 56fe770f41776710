// SPDX-License-Identifier: MIT
// The .bxw container, version 5. Little-endian, no padding, so that every byte is either compared or under a checksum:
//
//     Header
//     SectionEntry[section_count]
//     the sections' bytes, back to back in table order, up to the end of the file
//
// All sections of `section_kinds` are present, in that order; one without elements has size 0. A reader of this version
// refuses any other arrangement, so a new section or element means a new version.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <xxhash.h>

#include "boxwood/bxw.hpp"

namespace boxwood::detail::bxw {

static_assert(std::endian::native == std::endian::little, "sections are the bytes of arrays in memory");
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12 && sizeof(glm::mat4) == 64);
static_assert(sizeof(glm::vec2) == 8 && sizeof(glm::vec4) == 16);

/// A byte that is not ASCII, the name, and line ends that a text-mode copy would change.
inline constexpr std::array<char, 8> magic = {'\x89', 'B', 'X', 'W', '\r', '\n', '\x1a', '\n'};

struct Header {
    std::array<char, 8> magic;
    std::uint32_t version; ///< Compared before anything behind it is interpreted.
    std::uint32_t section_count;
    std::uint64_t file_size;
    std::uint64_t checksum; ///< XXH64 of the header with this field zero, followed by the table.
};
static_assert(sizeof(Header) == 32);

struct SectionEntry {
    std::array<char, 16> name; ///< Padded with zeros.
    std::uint64_t offset;      ///< From the start of the file.
    std::uint64_t size;        ///< Bytes; a multiple of element_size.
    std::uint64_t element_size;
    std::uint64_t checksum; ///< XXH64 of the section's bytes.
};
static_assert(sizeof(SectionEntry) == 48);

/// The one element of section "tree".
struct TreeRecord {
    std::uint32_t layout; ///< 0 binary, 1 wide8
    std::uint32_t levels; ///< 1 or 2
    std::uint32_t bottom_depth;
    std::uint32_t top_depth;
    /// 0 aabb, 1 obb-points, 2 obb-boxes, 3 obb-quaternion, 4 obb-cascade, 5 obb-moments, 6 obb-refined
    std::uint32_t bounds;
    std::uint32_t area_index; ///< 0 list, 1 octree, 2 kd; 0 without areas.
};
static_assert(sizeof(TreeRecord) == 24);

struct SectionKind {
    std::string_view name;
    std::uint64_t element_size;
};

inline constexpr std::array<SectionKind, 25> section_kinds = {{
    {"scene", 1},                         // see bxw_scene.hpp
    {"positions", sizeof(glm::vec3)},     // of all meshes, in mesh order
    {"triangles", sizeof(glm::uvec3)},    // of all meshes, indices within the mesh
    {"materials", sizeof(std::uint32_t)}, // of the triangles of all meshes that have them, likewise the attributes
    {"normals", sizeof(glm::vec3)},
    {"tangents", sizeof(glm::vec4)},
    {"uvs_0", sizeof(glm::vec2)},
    {"uvs_1", sizeof(glm::vec2)},
    {"colors", sizeof(glm::vec4)},
    {"looks", 1},  // of materials, textures and lights: see bxw_materials.hpp
    {"images", 1}, // the files of all images
    {"tree", sizeof(TreeRecord)},
    {"binary_nodes", sizeof(BinaryNode)}, // from here on the arrays of TreeImage
    {"oriented_nodes", sizeof(OrientedNode)},
    {"leaf_triangles", sizeof(Triangle)},
    {"wide_nodes", sizeof(Wide8Node)},
    {"leaf_blocks", sizeof(Triangle4)},
    {"binary_top", sizeof(BinaryNode)},
    {"oriented_top", sizeof(OrientedNode)},
    {"wide_top", sizeof(Wide8Node)},
    {"instances", sizeof(InstanceRecord)},
    {"first_triangles", sizeof(std::uint32_t)},
    {"areas", sizeof(LocalArea)},
    {"area_nodes", sizeof(AreaNode)},
    {"area_items", sizeof(std::uint32_t)},
}};

/// Running XXH64.
class Checksum {
public:
    Checksum() { XXH64_reset(state_.get(), 0); }
    void add(const void* data, std::size_t size) { XXH64_update(state_.get(), data, size); }
    std::uint64_t value() const { return XXH64_digest(state_.get()); }

private:
    struct Free {
        void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
    };
    std::unique_ptr<XXH64_state_t, Free> state_{XXH64_createState()};
};

/// The checksum of a header and its table.
inline std::uint64_t table_checksum(Header header, std::span<const SectionEntry> table) {
    header.checksum = 0;
    Checksum sum;
    sum.add(&header, sizeof header);
    sum.add(table.data(), table.size_bytes());
    return sum.value();
}

/// The section name as the table stores it.
inline std::array<char, 16> padded(std::string_view name) {
    std::array<char, 16> result{};
    name.copy(result.data(), result.size());
    return result;
}

/// Writes a whole container; a failure shows in the stream's state.
void write(std::ostream& out, const Scene& scene, const TreeImage& tree);

/// Reads a whole container of `size` bytes; `file` names it in errors. Throws InputError as load_bxw does.
BxwFile read(std::istream& in, std::uint64_t size, const std::string& file);

} // namespace boxwood::detail::bxw
