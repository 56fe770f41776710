// SPDX-License-Identifier: MIT
// Where the bytes of buffers come from: data: URIs and paths in all their spellings, and buffers without bytes.
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "boxwood/gltf.hpp"
#include "io/gltf_fixture.hpp"
#include "io/samples.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

std::string base64(const std::vector<std::byte>& bytes, const char* last_digits = "+/") {
    const std::string digits =
        std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789") + last_digits;
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

/// The triangle with a vertex whose bytes are all 0xff but for the exponent, so that base64 has every odd character.
GltfFixture odd_triangle() {
    GltfFixture fixture;
    const float odd = -1.9999999f; // 0xbfffffff
    fixture.show({{"attributes", {{"POSITION", fixture.positions({0, 0, 0, odd, 0, odd, 0, odd, odd})}}}});
    return fixture;
}

/// The scene as text with its buffer under `uri`, loaded from `folder`.
Scene load_text(const GltfFixture& fixture, const std::string& uri, const std::filesystem::path& folder = {}) {
    json root = fixture.root;
    root["buffers"] = {{{"byteLength", fixture.binary.size()}, {"uri", uri}}};
    const std::string text = root.dump();
    return load_gltf_memory(std::as_bytes(std::span(text)), "text", folder);
}

void write(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
    std::filesystem::create_directories(file.parent_path());
    test::write_bytes(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

} // namespace

TEST_CASE(
    "gltf_buffers: data URIs: base64 of both alphabets, broken into lines, escaped or without padding, and text") {
    const GltfFixture fixture = odd_triangle();
    const std::vector<glm::vec3> wanted = fixture.load().meshes.at(0).positions;
    const std::string plain = base64(fixture.binary), safe = base64(fixture.binary, "-_");
    REQUIRE(plain.find('/') != std::string::npos);
    std::string lines, escaped;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        lines += plain[i];
        if (i % 20 == 19) lines += "\r\n";
        escaped += plain[i] == '/'   ? "%2F"
                   : plain[i] == '+' ? "%2b"
                   : plain[i] == '=' ? "%3D"
                                     : std::string(1, plain[i]);
    }
    std::string text;
    for (const std::byte byte : fixture.binary) {
        constexpr const char* hex = "0123456789ABCDEF";
        const auto value = std::to_integer<unsigned>(byte);
        text += {'%', hex[value / 16], hex[value % 16]};
    }
    const std::string head = "data:application/octet-stream;base64,";
    for (const std::string& uri :
         {head + plain, head + safe, head + lines, head + escaped, head + lines + "\n ", "DATA:;BASE64," + plain,
          "data:;charset=utf-8;base64," + plain, "data:," + text, "data:application/octet-stream," + text}) {
        CAPTURE(uri);
        const Scene scene = load_text(fixture, uri);
        CHECK(scene.meshes.at(0).positions == wanted);
        CHECK(scene.warnings.empty());
    }
    for (const std::string& uri : {head + "*" + plain, head + "\xe2\x9d\xa4" + plain, std::string("data:no comma")})
        CHECK_THROWS_WITH_AS(load_text(fixture, uri), doctest::Contains("buffers[0].uri: is a data URI with"),
                             InputError);
}

TEST_CASE("gltf_buffers: paths: escapes or none, backslashes, and dots inside of the folder") {
    const test::TemporaryFolder folder;
    const GltfFixture fixture = test::triangle_fixture();
    write(folder.path() / "scene/sub/mesh.bin", fixture.binary);
    write(folder.path() / "scene/50%20.bin", fixture.binary);
    write(folder.path() / "outside.bin", fixture.binary);
    std::filesystem::create_directory_symlink("..", folder.path() / "scene/up");
    const auto warnings = [&](const std::string& uri) {
        const Scene scene = load_text(fixture, uri, folder.path() / "scene");
        CHECK(scene.triangle_count() == 1);
        return scene.warnings;
    };
    for (const char* uri : {"sub/mesh.bin", "./sub/mesh.bin", "sub/../sub/mesh.bin", "sub/.././sub//mesh.bin",
                            "50%20.bin", "50%2520.bin"}) {
        CAPTURE(uri);
        CHECK(warnings(uri).empty());
    }
    for (const char* uri : {"sub\\mesh.bin", ".\\sub\\mesh.bin", "sub%5Cmesh.bin", "sub\\..\\sub/mesh.bin"}) {
        CAPTURE(uri);
        CHECK(warnings(uri) == std::vector<std::string>{"buffers[0].uri: has backslashes, taken as slashes"});
    }
    write(folder.path() / "scene/sub\\mesh.bin", fixture.binary); // a file of that very name comes first
    CHECK(warnings("sub\\mesh.bin").empty());

    const auto fault = [&](const std::string& uri) -> std::string {
        try {
            load_text(fixture, uri, folder.path() / "scene");
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    };
    for (const char* uri : {"../outside.bin", "..\\outside.bin", "sub/../../outside.bin", "sub\\..\\..\\outside.bin",
                            "%2e%2e/outside.bin", "..%5coutside.bin", "../scene/sub/mesh.bin", "up/outside.bin",
                            "sub/../up/outside.bin", "\\outside.bin", "missing/../../outside.bin"}) {
        CAPTURE(uri);
        CHECK(fault(uri).starts_with("text: buffers[0].uri: leaves the folder of the scene: "));
    }
    CHECK(fault("sub/none%20here.bin") == "text: buffers[0].uri: does not exist: sub/none here.bin");
    CHECK(fault("C:\\a\\mesh.bin") == "text: buffers[0].uri: does not exist: C:\\a\\mesh.bin");
    CHECK(fault("sub") == "text: buffers[0].uri: is not a regular file: sub");
    CHECK(fault("http://a/b.bin") == "text: buffers[0].uri: is neither a data URI nor a relative path: http://a/b.bin");
}

TEST_CASE("gltf_buffers: a buffer without data fails where something is read from it, and nowhere else") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["buffers"] = {{{"byteLength", fixture.binary.size()}}, {{"byteLength", 100}}};
    CHECK(fixture.load().warnings.empty()); // valid: extensions may fill it
    const std::size_t view = fixture.append("bufferViews", {{"buffer", 1}, {"byteLength", 100}});
    CHECK(fixture.load().warnings.empty());
    fixture.root["accessors"][0]["bufferView"] = view;
    CHECK(fixture.fault() == "buffers[1]");

    fixture = test::triangle_fixture();
    fixture.root["buffers"] = {{{"byteLength", fixture.binary.size()}},
                               {{"byteLength", 100}, {"uri", "data:,short"}},
                               {{"byteLength", 100}, {"uri", "missing.bin"}}};
    const Scene scene = fixture.load();
    REQUIRE(scene.warnings.size() == 2);
    CHECK(scene.warnings[0] == "buffers[1]: has 5 bytes where byteLength says 100");
    CHECK(scene.warnings[1].starts_with("buffers[2].uri: names a file, and this scene has no folder"));
    fixture.root["bufferViews"][0]["buffer"] = 2;
    CHECK(fixture.fault() == "buffers[2].uri");
}

TEST_CASE("gltf_buffers: no message carries more than an excerpt of what a file says") {
    const std::string longest(100'000, 'x');
    const auto check = [](const GltfFixture& fixture) {
        try {
            const Scene scene = fixture.load();
            CHECK(!scene.warnings.empty());
            for (const std::string& warning : scene.warnings) CHECK(warning.size() < 1000);
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).size() < 1000);
        }
    };
    const auto changed = [&](auto change) {
        GltfFixture fixture = test::triangle_fixture();
        change(fixture.root);
        check(fixture);
    };
    for (const std::string& uri : {longest, "../" + longest, "http://" + longest, "data:," + longest, "sub\\" + longest,
                                   "data:;base64,*" + longest}) {
        changed([&](json& root) { root["buffers"] = {{{"byteLength", 200'000}, {"uri", uri}}}; });
        changed([&](json& root) { root["images"] = {{{"uri", uri}}}; });
        const test::TemporaryFolder folder;
        CHECK_THROWS_AS(load_text(test::triangle_fixture(), "data:;base64,*" + uri, folder.path()), InputError);
        try {
            load_text(test::triangle_fixture(), uri, folder.path());
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).size() < 1000);
        }
    }
    changed([&](json& root) { root["asset"]["version"] = longest; });
    changed([&](json& root) { root["asset"]["minVersion"] = longest; });
    changed([&](json& root) { root["extensionsUsed"] = {longest}; });
    changed([&](json& root) { root["extensionsRequired"] = {longest}; });
    changed([&](json& root) { root["nodes"][0][longest] = nullptr; });
    changed([&](json& root) { root["accessors"][0]["type"] = longest; });
    changed([&](json& root) {
        root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{longest, 99}};
    });
    changed([&](json& root) {
        root["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", longest}}}}}}};
        root["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
    });
    for (const std::string& text : {"{\"asset\": \"" + longest, "{" + longest, "{\"a\": " + longest}) try {
            load_gltf_memory(std::as_bytes(std::span(text)), "text", {});
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).size() < 1000);
        }
}

TEST_SUITE_END();
