// SPDX-License-Identifier: MIT
// Takes .bxw files apart and puts them together with right offsets and checksums, as an attacker would.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "io/bxw_format.hpp"

namespace boxwood::test {

/// The container of a scene and tree, without the checks that save_bxw makes first.
inline std::string bxw_bytes(const Scene& scene, const TreeImage& tree) {
    std::ostringstream out;
    bxw::write(out, scene, tree);
    return out.str();
}

/// Reads a container from memory. Throws as load_bxw does.
inline BxwFile read_bxw(const std::string& bytes) {
    std::istringstream in(bytes);
    return bxw::read(in, bytes.size(), "test.bxw");
}

inline std::vector<bxw::SectionEntry> table_of(const std::string& bytes) {
    std::vector<bxw::SectionEntry> table(bxw::section_kinds.size());
    bytes.copy(reinterpret_cast<char*>(table.data()), table.size() * sizeof(bxw::SectionEntry), sizeof(bxw::Header));
    return table;
}

/// The sections' bytes of a valid container.
inline std::vector<std::string> sections_of(const std::string& bytes) {
    std::vector<std::string> sections;
    for (const bxw::SectionEntry& entry : table_of(bytes)) sections.push_back(bytes.substr(entry.offset, entry.size));
    return sections;
}

/// A container of a given table and sections, with the checksum that covers header and table.
inline std::string seal(std::vector<bxw::SectionEntry> table, const std::vector<std::string>& sections) {
    std::string payload;
    for (const std::string& section : sections) payload += section;
    const std::size_t front = sizeof(bxw::Header) + table.size() * sizeof(bxw::SectionEntry);
    bxw::Header header{bxw::magic, bxw_version, static_cast<std::uint32_t>(table.size()), front + payload.size(), 0};
    header.checksum = bxw::table_checksum(header, table);
    std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
    bytes.append(reinterpret_cast<const char*>(table.data()), table.size() * sizeof table[0]);
    return bytes + payload;
}

/// The table that describes `sections`, which are as many as section_kinds.
inline std::vector<bxw::SectionEntry> describe(const std::vector<std::string>& sections) {
    std::vector<bxw::SectionEntry> table;
    std::uint64_t offset = sizeof(bxw::Header) + sections.size() * sizeof(bxw::SectionEntry);
    for (const std::string& section : sections) {
        bxw::Checksum sum;
        sum.add(section.data(), section.size());
        const bxw::SectionKind& kind = bxw::section_kinds[table.size()];
        table.push_back({bxw::padded(kind.name), offset, section.size(), kind.element_size, sum.value()});
        offset += section.size();
    }
    return table;
}

inline std::string seal(const std::vector<std::string>& sections) { return seal(describe(sections), sections); }

} // namespace boxwood::test
