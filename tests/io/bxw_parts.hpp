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
    detail::bxw::write(out, scene, tree);
    return out.str();
}

/// Reads a container from memory. Throws as load_bxw does.
inline BxwFile read_bxw(const std::string& bytes) {
    std::istringstream in(bytes);
    return detail::bxw::read(in, bytes.size(), "test.bxw");
}

inline std::vector<detail::bxw::SectionEntry> table_of(const std::string& bytes) {
    std::vector<detail::bxw::SectionEntry> table(detail::bxw::section_kinds.size());
    bytes.copy(reinterpret_cast<char*>(table.data()), table.size() * sizeof(detail::bxw::SectionEntry),
               sizeof(detail::bxw::Header));
    return table;
}

/// The sections' bytes of a valid container.
inline std::vector<std::string> sections_of(const std::string& bytes) {
    std::vector<std::string> sections;
    for (const detail::bxw::SectionEntry& entry : table_of(bytes))
        sections.push_back(bytes.substr(entry.offset, entry.size));
    return sections;
}

/// A container of a given table and sections, with the checksum that covers header and table.
inline std::string seal(std::vector<detail::bxw::SectionEntry> table, const std::vector<std::string>& sections) {
    std::string payload;
    for (const std::string& section : sections) payload += section;
    const std::size_t front = sizeof(detail::bxw::Header) + table.size() * sizeof(detail::bxw::SectionEntry);
    detail::bxw::Header header{detail::bxw::magic, bxw_version, static_cast<std::uint32_t>(table.size()),
                               front + payload.size(), 0};
    header.checksum = detail::bxw::table_checksum(header, table);
    std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
    bytes.append(reinterpret_cast<const char*>(table.data()), table.size() * sizeof table[0]);
    return bytes + payload;
}

/// The table that describes `sections`, which are as many as section_kinds.
inline std::vector<detail::bxw::SectionEntry> describe(const std::vector<std::string>& sections) {
    std::vector<detail::bxw::SectionEntry> table;
    std::uint64_t offset = sizeof(detail::bxw::Header) + sections.size() * sizeof(detail::bxw::SectionEntry);
    for (const std::string& section : sections) {
        detail::bxw::Checksum sum;
        sum.add(section.data(), section.size());
        const detail::bxw::SectionKind& kind = detail::bxw::section_kinds[table.size()];
        table.push_back({detail::bxw::padded(kind.name), offset, section.size(), kind.element_size, sum.value()});
        offset += section.size();
    }
    return table;
}

inline std::string seal(const std::vector<std::string>& sections) { return seal(describe(sections), sections); }

} // namespace boxwood::test
