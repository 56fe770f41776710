// SPDX-License-Identifier: MIT
#include <cstring>
#include <functional>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "io/bxw_parts.hpp"
#include "io/samples.hpp"
#include "support.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using namespace boxwood::test;

namespace {

/// A layout with the volumes that it holds.
struct Volumes {
    Layout layout;
    Bounds bounds;
};
constexpr std::array<Volumes, 3> layouts = {
    {{Layout::binary, Bounds::aabb}, {Layout::wide8, Bounds::aabb}, {Layout::binary, Bounds::obb_moments}}};
constexpr std::array<Levels, 2> level_choices = {Levels::one, Levels::two};

/// The InputError of reading `bytes`: "where: what", or "accepted".
std::string refusal(const std::string& bytes) {
    try {
        read_bxw(bytes);
    } catch (const InputError& error) {
        CHECK(error.file == "test.bxw");
        return error.what();
    }
    return "accepted";
}

bool mentions(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

/// With an influence area where a tree may have one.
TreeImage tree_of(const Scene& scene, Volumes volumes, Levels levels) {
    TreeImage tree = sample_tree(scene, volumes.layout, levels, volumes.bounds);
    if (levels == Levels::one && volumes.bounds == Bounds::aabb) add_sample_area(tree);
    return tree;
}

std::string sample_bytes(Volumes volumes, Levels levels) {
    const Scene scene = sample_scene();
    return bxw_bytes(scene, tree_of(scene, volumes, levels));
}

/// Overwrites the bytes of `text` at `offset` with those of `value`.
template <class T>
void poke(std::string& text, std::size_t offset, T value) {
    REQUIRE(offset + sizeof value <= text.size());
    std::memcpy(text.data() + offset, &value, sizeof value);
}

constexpr std::size_t scene_section = 0;
constexpr std::size_t positions_section = 1;
constexpr std::size_t triangles_section = 2;
constexpr std::size_t materials_section = 3;
constexpr std::size_t normals_section = 4;
constexpr std::size_t uvs_section = 6;
constexpr std::size_t looks_section = 9;
constexpr std::size_t images_section = 10;
constexpr std::size_t tree_section = 11;
constexpr std::size_t binary_nodes_section = 12;

} // namespace

TEST_CASE("bxw: a .bxw file gives back scene and tree, bit for bit") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "sample.bxw";
    for (const Volumes& volumes : layouts) {
        for (const Levels levels : level_choices) {
            CAPTURE(name(volumes.layout));
            CAPTURE(name(volumes.bounds));
            CAPTURE(name(levels));
            const Scene scene = sample_scene();
            const TreeImage tree = tree_of(scene, volumes, levels);
            save_bxw(file, scene, tree);
            const BxwFile loaded = load_bxw(file);
            CHECK(same(loaded.scene, scene));
            CHECK(same(loaded.tree, tree));
            CHECK(is_bxw(file));
        }
    }
    CHECK(folder.entries() == 1);
}

TEST_CASE("bxw: an empty scene and its empty tree make a .bxw file") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "empty.bxw";
    for (const Levels levels : level_choices) {
        const TreeImage tree = sample_tree({}, Layout::wide8, levels);
        save_bxw(file, {}, tree);
        const BxwFile loaded = load_bxw(file);
        CHECK(same(loaded.scene, Scene{}));
        CHECK(same(loaded.tree, tree));
    }
}

TEST_CASE("bxw: a tree that does not fit the scene is not written") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "bad.bxw";
    const Scene scene = sample_scene();
    TreeImage tree = sample_tree(scene, Layout::wide8, Levels::two);
    tree.blocks[0].primitive[0] = 1; // the mesh has one triangle
    CHECK_THROWS_AS(save_bxw(file, scene, tree), InputError);
    CHECK(folder.entries() == 0);
}

TEST_CASE("bxw: a .bxw file gives back every kind of index of areas, by its documented number") {
    const Scene scene = sample_scene();
    TreeImage tree = tree_of(scene, layouts[0], Levels::one);
    std::uint32_t number = 0;
    for (const AreaIndexKind kind : {AreaIndexKind::list, AreaIndexKind::octree, AreaIndexKind::kd}) {
        tree.area_index.kind = kind;
        const std::string bytes = bxw_bytes(scene, tree);
        CHECK(read_bxw(bytes).tree.area_index.kind == kind);
        std::uint32_t stored = 0;
        std::memcpy(&stored, sections_of(bytes)[tree_section].data() + 20, sizeof stored);
        CHECK(stored == number++);
    }
}

TEST_CASE("bxw: the file on disk has the documented layout") {
    const std::string bytes = sample_bytes(layouts[0], Levels::one);
    CHECK(bytes.substr(0, 8) == "\x89"
                                "BXW\r\n\x1a\n");
    CHECK(bytes.substr(8, 4) == std::string("\x05\0\0\0", 4));  // version 5, little-endian
    CHECK(bytes.substr(12, 4) == std::string("\x19\0\0\0", 4)); // twenty-five sections
    CHECK(std::string(bytes.data() + 32) == "scene");
    // 32 bytes of header and 25 entries of 48, then one section of no known size before the positions of 3 + 39
    // vertices.
    const auto table = table_of(bytes);
    CHECK(table[0].offset == 1232);
    CHECK(table[1].size == 42 * 12);
    float x = 0;
    std::memcpy(&x, bytes.data() + table[1].offset + 12, sizeof x);
    CHECK(x == 1.0f); // second vertex of the first mesh
}

TEST_CASE("bxw: a .bxw file cut at any byte is refused") {
    for (const Volumes& volumes : layouts) {
        const std::string bytes = sample_bytes(volumes, Levels::two);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            CAPTURE(size);
            const std::string what = refusal(bytes.substr(0, size));
            CHECK(mentions(what, size < 8 ? "not a .bxw file" : "truncated"));
        }
    }
}

TEST_CASE("bxw: a .bxw file with any byte flipped is refused") {
    for (const Volumes& volumes : layouts) {
        std::string bytes = sample_bytes(volumes, Levels::two);
        // Under a checker some: the hash over all of a file costs most there.
        for (std::size_t i = 0; i < bytes.size(); i += small_sizes() ? 5 : 1) {
            CAPTURE(i);
            const char byte = bytes[i];
            for (const int mask : {0x01, 0x80, 0xff}) {
                bytes[i] = static_cast<char>(byte ^ mask);
                CHECK(refusal(bytes) != "accepted");
            }
            bytes[i] = byte;
        }
        CHECK(refusal(bytes) == "accepted");
    }
}

TEST_CASE("bxw: a .bxw file with bytes behind its end is refused") {
    const std::string bytes = sample_bytes(layouts[0], Levels::one);
    CHECK(mentions(refusal(bytes + '\0'), "trailing"));
    CHECK(mentions(refusal(bytes + bytes), "trailing"));
}

TEST_CASE("bxw: a file that ends earlier than its size said is refused") { // it shrank while it was read
    const std::string bytes = sample_bytes(layouts[0], Levels::one);
    std::istringstream in(bytes.substr(0, bytes.size() - 1));
    CHECK_THROWS_AS(detail::bxw::read(in, bytes.size(), "test.bxw"), InputError);
}

TEST_CASE("bxw: a newer .bxw file is refused as newer, whatever follows its version") {
    std::string bytes = sample_bytes(layouts[0], Levels::one);
    poke(bytes, 8, bxw_version + 1);
    CHECK(mentions(refusal(bytes), "newer"));
    CHECK(mentions(refusal(bytes.substr(0, 12)), "newer"));
    poke(bytes, 8, 0u);
    CHECK(mentions(refusal(bytes), "no such format version"));
}

TEST_CASE("bxw: an older .bxw file is refused as older") {
    std::string bytes = sample_bytes(layouts[0], Levels::one);
    for (std::uint32_t version = 1; version < bxw_version; ++version) {
        poke(bytes, 8, version);
        CHECK(mentions(refusal(bytes), "older"));
    }
}

TEST_CASE("bxw: what is not a .bxw file is told apart and refused by its name") {
    const TemporaryFolder folder;
    const auto refused = [](const std::filesystem::path& file) {
        try {
            load_bxw(file);
        } catch (const InputError& error) {
            return error.file == file.string();
        }
        return false;
    };
    for (const std::string& bytes : {std::string(), std::string("glTF"), std::string(1000, '\0')}) {
        const auto file = folder.path() / "other";
        write_bytes(file, bytes);
        CHECK_FALSE(is_bxw(file));
        CHECK(refused(file));
    }
    CHECK_FALSE(is_bxw(folder.path() / "missing"));
    CHECK(refused(folder.path() / "missing"));
    CHECK_FALSE(is_bxw(folder.path()));
    CHECK(refused(folder.path()));
    CHECK_FALSE(is_bxw("/dev/zero"));
    CHECK(refused("/dev/zero"));
}

TEST_CASE("bxw: a section table that lies is refused, its checksum being right") {
    const std::string bytes = sample_bytes(layouts[0], Levels::two);
    const auto sections = sections_of(bytes);
    const auto table = table_of(bytes);
    REQUIRE(seal(sections) == bytes);
    using Change = std::function<void(std::vector<detail::bxw::SectionEntry>&)>;
    const std::vector<Change> changes = {
        [](auto& t) { t.pop_back(); },
        [](auto& t) { t.push_back(t.back()); },
        [](auto& t) { std::swap(t[1], t[2]); },
        [](auto& t) { t[0].name[15] = 'x'; },
        [](auto& t) { t[4].element_size = 32; },
        [](auto& t) { t[4].element_size = 0; },
        [](auto& t) { t[1].offset += 1; },
        [](auto& t) { t[5].offset = 0; },
        [](auto& t) { t[1].size += 12; },
        [](auto& t) { t[1].size -= 12; },
        [](auto& t) { t[1].size -= 1; },
        [](auto& t) { t[1].size = ~std::uint64_t{0} / 12 * 12; }, // its end wraps around
        [](auto& t) { t[1].checksum ^= 1; },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        CAPTURE(i);
        auto changed = table;
        changes[i](changed);
        CHECK(refusal(seal(changed, sections)) != "accepted");
    }
}

TEST_CASE("bxw: counts beyond their section are refused before memory is taken") {
    const auto original = sections_of(sample_bytes(layouts[0], Levels::two));
    // Offsets follow from bxw_scene.hpp: three counts, the mesh count, then the first mesh ("one") and its sizes.
    constexpr std::size_t mesh_count = 24;
    constexpr std::size_t name_size = 32;
    constexpr std::size_t vertices = 43;
    constexpr std::size_t triangles = 51;
    for (const std::size_t offset : {mesh_count, name_size, vertices, triangles}) {
        for (const std::uint64_t count : {std::uint64_t{1} << 40, ~std::uint64_t{0}, std::uint64_t{1} << 63}) {
            CAPTURE(offset);
            CAPTURE(count);
            auto sections = original;
            poke(sections[scene_section], offset, count);
            CHECK(refusal(seal(sections)) != "accepted");
        }
    }
    auto sections = original;
    sections[scene_section] += '\0';
    CHECK(mentions(refusal(seal(sections)), "section scene"));

    // Of materials: the materials, the name of the first; and the last 8 bytes are the length of the last image.
    const std::size_t last = original[looks_section].size() - 8;
    for (const std::size_t offset : {std::size_t{0}, std::size_t{8}, last}) {
        for (const std::uint64_t count : {std::uint64_t{1} << 40, ~std::uint64_t{0}, std::uint64_t{1} << 63}) {
            sections = original;
            poke(sections[looks_section], offset, count);
            CHECK(mentions(refusal(seal(sections)), offset == last ? "section images" : "section looks"));
        }
    }
}

TEST_CASE("bxw: the sections of scene and materials are refused when they are cut at any byte") {
    const auto original = sections_of(sample_bytes(layouts[0], Levels::two));
    for (const std::size_t section : {scene_section, looks_section}) {
        for (std::size_t size = 0; size < original[section].size(); ++size) {
            CAPTURE(size);
            auto sections = original;
            sections[section].resize(size);
            CHECK(mentions(refusal(seal(sections)), section == scene_section ? "section scene" : "section looks"));
        }
    }
}

TEST_CASE("bxw: a hostile element is refused although every checksum is right") {
    const auto original = sections_of(sample_bytes(layouts[0], Levels::two));
    const auto hostile = [&](auto&& change) {
        auto sections = original;
        change(sections);
        return refusal(seal(sections));
    };
    CHECK(hostile([](auto&) {}) == "accepted");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(hostile([&](auto& s) { poke(s[positions_section], 0, nan); }) != "accepted");
    CHECK(hostile([](auto& s) { poke(s[triangles_section], 0, 3u); }) != "accepted"); // of 3 vertices
    CHECK(mentions(hostile([](auto& s) { poke(s[materials_section], 0, 2u); }), "meshes[1].materials[0]")); // of two
    CHECK(mentions(hostile([&](auto& s) { poke(s[normals_section], 0, nan); }), "meshes[1].normals[0]"));
    CHECK(mentions(hostile([&](auto& s) { poke(s[uvs_section], 4, 1e30f); }), "meshes[1].uvs[0]"));
    CHECK(mentions(hostile([](auto& s) { s[normals_section].clear(); }), "section normals"));
    CHECK(mentions(hostile([](auto& s) { s[images_section][0] = 'G'; }), "images[0]"));
    // Base colour, and the texture of the first input, behind two counts, a name of 10 bytes and the factors.
    CHECK(mentions(hostile([&](auto& s) { poke(s[looks_section], 26, nan); }), "materials[0].base_color"));
    CHECK(mentions(hostile([](auto& s) { poke(s[looks_section], 90, 3u); }), "materials[0].base_color_texture"));
    CHECK(mentions(hostile([](auto& s) { poke(s[tree_section], 0, 2u); }), "layout"));
    CHECK(mentions(hostile([](auto& s) { poke(s[tree_section], 4, 3u); }), "levels"));
    CHECK(mentions(hostile([](auto& s) { poke(s[tree_section], 8, 7u); }), "bottom_depth"));
    CHECK(mentions(hostile([](auto& s) { poke(s[tree_section], 16, 7u); }), "unknown bounds"));
    CHECK(mentions(hostile([](auto& s) { poke(s[tree_section], 20, 3u); }), "unknown index of areas"));
    CHECK(mentions(hostile([](auto& s) { poke(s[tree_section], 16, 1u); }), "binary_nodes"));
    CHECK(mentions(hostile([](auto& s) { s[tree_section] += s[tree_section]; }), "section tree"));
    CHECK(mentions(hostile([](auto& s) { s[tree_section].clear(); }), "section tree"));
    // child[0] of the first node lies behind its two boxes
    CHECK(mentions(hostile([](auto& s) { poke(s[binary_nodes_section], 48, BOXWOOD_LEAF | 1000u); }),
                   "binary_nodes[0].child[0]"));
    CHECK(mentions(hostile([&](auto& s) { poke(s[binary_nodes_section], 0, nan); }), "binary_nodes[0].child[0]"));
}

TEST_CASE("bxw: whatever an attacker writes over one word, reading refuses it or gives a tree that validates") {
    // All six arrangements, every word, the values that break index arithmetic.
    std::size_t accepted = 0;
    std::size_t refused = 0;
    for (const Volumes& volumes : layouts) {
        for (const Levels levels : level_choices) {
            const auto original = sections_of(sample_bytes(volumes, levels));
            for (std::size_t section = 0; section < original.size(); ++section) {
                for (std::size_t offset = 0; offset + 4 <= original[section].size(); offset += 4) {
                    for (const std::uint32_t value : {0u, 1u, 0x80000000u, 0xffffffffu, 0x7f800000u}) {
                        auto sections = original;
                        poke(sections[section], offset, value);
                        try {
                            const BxwFile loaded = read_bxw(seal(sections));
                            validate(loaded.tree, loaded.scene, "test.bxw");
                            ++accepted;
                        } catch (const InputError&) {
                            ++refused;
                        }
                    }
                }
            }
        }
    }
    // Neither kind of word may be absent, or the loop has not tried what it says.
    CHECK(accepted > 1000);
    CHECK(refused > 1000);
}

TEST_SUITE_END();
