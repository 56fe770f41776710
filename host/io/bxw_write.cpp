// SPDX-License-Identifier: MIT
#include <ostream>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/bxw_format.hpp"
#include "io/bxw_materials.hpp"
#include "io/bxw_scene.hpp"

namespace boxwood {

namespace detail::bxw {

namespace {

/// A section's bytes, where they already lie in memory.
using Parts = std::vector<std::span<const std::byte>>;

template <class T>
Parts one_part(const std::vector<T>& elements) {
    return {std::as_bytes(std::span(elements))};
}

/// As TreeRecord::area_index.
std::uint32_t word_of(AreaIndexKind kind) {
    return kind == AreaIndexKind::octree ? 1 : kind == AreaIndexKind::kd ? 2 : 0;
}

TreeRecord record_of(const TreeImage& tree) {
    return {tree.layout == Layout::binary ? 0u : 1u,
            tree.levels == Levels::one ? 1u : 2u,
            tree.bottom_depth,
            tree.top_depth,
            static_cast<std::uint32_t>(tree.bounds),
            word_of(tree.area_index.kind)};
}

std::vector<SectionEntry> table_of(std::span<const Parts> sections) {
    std::vector<SectionEntry> table(sections.size());
    std::uint64_t offset = sizeof(Header) + table.size() * sizeof(SectionEntry);
    for (std::size_t i = 0; i < table.size(); ++i) {
        Checksum sum;
        std::uint64_t size = 0;
        for (const auto& part : sections[i]) {
            sum.add(part.data(), part.size());
            size += part.size();
        }
        table[i] = {padded(section_kinds[i].name), offset, size, section_kinds[i].element_size, sum.value()};
        offset += size;
    }
    return table;
}

void put(std::ostream& out, std::span<const std::byte> bytes) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

} // namespace

void write(std::ostream& out, const Scene& scene, const TreeImage& tree) {
    const std::string outline = encode_scene(scene);
    const TreeRecord record = record_of(tree);
    const std::string materials = encode_materials(scene);
    const auto of_meshes = [&scene](auto member) {
        Parts parts;
        for (const Mesh& mesh : scene.meshes) parts.push_back(std::as_bytes(std::span(member(mesh))));
        return parts;
    };
    Parts images;
    for (const EncodedImage& image : scene.images) images.push_back(image.bytes);
    // In the order of section_kinds.
    const std::array<Parts, section_kinds.size()> sections = {
        Parts{std::as_bytes(std::span(outline))},
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.positions; }),
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.triangles; }),
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.materials; }),
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.normals; }),
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.tangents; }),
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.uvs[0]; }),
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.uvs[1]; }),
        of_meshes([](const Mesh& mesh) -> auto& { return mesh.colors; }),
        Parts{std::as_bytes(std::span(materials))},
        std::move(images),
        Parts{std::as_bytes(std::span(&record, 1))},
        one_part(tree.binary_nodes),
        one_part(tree.oriented_nodes),
        one_part(tree.triangles),
        one_part(tree.wide_nodes),
        one_part(tree.blocks),
        one_part(tree.binary_top),
        one_part(tree.oriented_top),
        one_part(tree.wide_top),
        one_part(tree.instances),
        one_part(tree.first_triangles),
        one_part(tree.areas),
        one_part(tree.area_index.nodes),
        one_part(tree.area_index.items)};
    const std::vector<SectionEntry> table = table_of(sections);
    Header header{magic, bxw_version, static_cast<std::uint32_t>(table.size()), table.back().offset + table.back().size,
                  0};
    header.checksum = table_checksum(header, table);
    put(out, std::as_bytes(std::span(&header, 1)));
    put(out, std::as_bytes(std::span(table)));
    for (const Parts& parts : sections) {
        for (const auto& part : parts) put(out, part);
    }
}

} // namespace detail::bxw

void save_bxw(const std::filesystem::path& file, const Scene& scene, const TreeImage& tree) {
    validate(scene, file.string());
    validate(tree, scene, file.string());
    AtomicFile out(file);
    detail::bxw::write(out.stream(), scene, tree);
    out.commit();
}

} // namespace boxwood
