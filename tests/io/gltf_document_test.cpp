// SPDX-License-Identifier: MIT
#include "io/gltf_document.hpp"

#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <unistd.h>

#include "boxwood/gltf.hpp"
#include "io/gltf_fixture.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

/// A folder that is gone after the test.
class TemporaryFolder {
public:
    TemporaryFolder() : path(std::filesystem::temp_directory_path() / ("boxwood-gltf-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path write(const std::filesystem::path& name, std::span<const std::byte> bytes) const {
        std::filesystem::create_directories((path / name).parent_path());
        std::ofstream(path / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return path / name;
    }
    const std::filesystem::path path;
};

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

// The element that the error names; the file must be named too.
std::string fault(const std::filesystem::path& file) {
    try {
        load_gltf(file);
    } catch (const InputError& error) {
        return error.file == file.string() ? error.where : "wrong file: " + error.file;
    }
    return "no error";
}

std::string text_fault(const std::string& text) {
    try {
        load_gltf_memory(bytes_of(text), "text", {});
    } catch (const InputError& error) {
        return error.where;
    }
    return "no error";
}

// The triangle as glTF text with its buffer elsewhere.
std::string triangle_text(const std::string& uri) {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["buffers"] = {{{"byteLength", fixture.binary.size()}, {"uri", uri}}};
    return fixture.root.dump();
}

} // namespace

TEST_CASE("gltf_document: GLB is known by its magic, text by its lack, whatever the file is called") {
    const TemporaryFolder folder;
    const GltfFixture fixture = test::triangle_fixture();
    CHECK(load_gltf(folder.write("binary.gltf", fixture.bytes())).triangle_count() == 1);
    folder.write("data.bin", fixture.binary);
    CHECK(load_gltf(folder.write("text.glb", bytes_of(triangle_text("data.bin")))).triangle_count() == 1);
}

TEST_CASE("gltf_document: buffers by data URI and by file, with escapes, spaces and letters of any script") {
    const TemporaryFolder folder;
    const GltfFixture fixture = test::triangle_fixture();
    folder.write("a b%20c/\u2764 d.bin", fixture.binary);
    for (const char* uri : {"a b%20c/\u2764 d.bin", "a%20b%2520c/%E2%9D%A4%20d.bin", "./a b%2520c/\u2764 d.bin"}) {
        CAPTURE(uri);
        CHECK(fault(folder.write("scene.gltf", bytes_of(triangle_text(uri)))) == "no error");
    }

    const std::string zeros(48 * 4 / 3, 'A'); // base64 of 48 zero bytes: one triangle without area
    for (const char* media : {"application/octet-stream", "application/gltf-buffer", "application/x-of-our-own", ""}) {
        const std::string uri = std::string("data:") + media + ";base64," + zeros;
        CHECK(text_fault(triangle_text(uri)) == "no error");
    }
    CHECK(text_fault(triangle_text("data:application/octet-stream;base64," + zeros.substr(4))) == "buffers[0]");
    CHECK(text_fault(triangle_text("data:application/octet-stream;base64,")) == "buffers[0].uri");
    CHECK(text_fault(triangle_text("data:application/octet-stream,plain")) == "buffers[0]"); // five bytes
}

TEST_CASE("gltf_document: buffer files stay inside the folder of the scene, exist, and are long enough") {
    const TemporaryFolder folder;
    const GltfFixture fixture = test::triangle_fixture();
    folder.write("outside.bin", fixture.binary);
    folder.write("scene/inside.bin", fixture.binary);
    folder.write("scene/short.bin", std::span(fixture.binary).first(47));
    std::filesystem::create_directories(folder.path / "scene/folder.bin");
    std::filesystem::create_symlink("../outside.bin", folder.path / "scene/link.bin");
    const auto fault_of = [&folder](const std::string& uri) {
        return fault(folder.write("scene/scene.gltf", bytes_of(triangle_text(uri))));
    };
    CHECK(fault_of("inside.bin") == "no error");
    CHECK(fault_of("../outside.bin") == "buffers[0].uri");
    CHECK(fault_of("%2e%2e/outside.bin") == "buffers[0].uri");
    CHECK(fault_of("../scene/inside.bin") == "buffers[0].uri");
    CHECK(fault_of((folder.path / "scene/inside.bin").string()) == "buffers[0].uri");
    CHECK(fault_of("file://" + (folder.path / "scene/inside.bin").string()) == "buffers[0].uri");
    CHECK(fault_of("link.bin") == "buffers[0].uri");
    CHECK(fault_of("inside.bin%00.png") == "buffers[0].uri");
    CHECK(fault_of("folder.bin") == "buffers[0].uri");
    CHECK(fault_of("missing.bin") == "buffers[0].uri");
    CHECK(fault_of("short.bin") == "buffers[0]");

    GltfFixture absent = fixture;
    absent.root["buffers"] = {{{"byteLength", 48}}};
    CHECK(text_fault(absent.root.dump()) == "buffers[0]");
}

TEST_CASE("gltf_document: missing, empty and foreign files are refused") {
    const TemporaryFolder folder;
    CHECK(fault(folder.path / "missing.gltf") == "");
    CHECK(fault(folder.path) == "");
    CHECK(fault(folder.write("empty.glb", {})) == "");
    CHECK(fault(folder.write("text.gltf", bytes_of("no JSON at all"))) == "JSON");
    CHECK(text_fault("[]") == "JSON");
    CHECK(text_fault("42") == "JSON");
    CHECK(text_fault("{}") == "asset");
    CHECK(text_fault(R"({"asset":{"version":"1.0"}})") == "asset.version");
    CHECK(text_fault(R"({"asset":{"version":2}})") == "asset.version");
    CHECK(text_fault(R"({"asset":{"version":"2.0","minVersion":"2.1"}})") == "asset.minVersion");
    CHECK(text_fault(R"({"asset":{"version":"2.0"},"nodes":{}})") == "nodes");
    CHECK(text_fault(R"({"asset":{"version":"2.0"},"nodes":[7]})") == "nodes[0]");
    CHECK(text_fault("{\"asset\":{\"version\":\"2.0\",\"copyright\":\"\xff\"}}") == "JSON");
}

TEST_CASE("gltf_document: an empty scene is a scene") {
    for (const char* text : {R"({"asset":{"version":"2.0"}})", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{}]})",
                             R"({"asset":{"version":"2.0"},"nodes":[{}],"scenes":[{"nodes":[0]}]})"}) {
        const Scene scene = load_gltf_memory(bytes_of(text), "text", {});
        CHECK(scene.meshes.empty());
        CHECK(scene.instances.empty());
        CHECK(scene.cameras.empty());
        CHECK(scene.warnings.empty());
    }
}

TEST_CASE("gltf_document: a GLB cut at any byte is refused") {
    const std::vector<std::byte> whole = test::triangle_fixture().bytes();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        CAPTURE(size);
        CHECK_THROWS_AS(load_gltf_memory(std::span(whole).first(size), "cut", {}), InputError);
    }
}

TEST_CASE("gltf_document: a GLB with any byte changed is refused or keeps every promise of a scene") {
    const std::vector<std::byte> whole = test::triangle_fixture().bytes();
    int refused = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const int flip : {0x01, 0x10, 0x80, 0xff}) {
            std::vector<std::byte> changed = whole;
            changed[i] ^= static_cast<std::byte>(flip);
            try {
                validate(load_gltf_memory(changed, "changed", {}), "loaded");
            } catch (const InputError& error) {
                CHECK(error.file == "changed");
                ++refused;
            }
        }
    }
    CHECK(refused > 0);
}

TEST_CASE("gltf_document: JSON nested without end neither overflows the stack nor takes long") {
    constexpr std::size_t depth = 1'000'000;
    const std::string nest = std::string(depth, '[') + std::string(depth, ']');
    const std::string head = R"({"asset":{"version":"2.0"},)";
    CHECK(text_fault(head + "\"nodes\":" + nest + "}") == "JSON");
    CHECK(text_fault(head + "\"nodes\":[{\"foo\":" + nest + "}]}") == "JSON");
    CHECK(text_fault(head + "\"extras\":" + nest + "}") == "no error"); // never read, so never kept
    CHECK(text_fault(head + "\"nodes\":[{\"extras\":" + nest + "}]}") == "no error");
    CHECK(text_fault(std::string(depth, '[')) == "JSON");
}

TEST_CASE("gltf_document: a required extension that may change geometry is refused by name, others pass") {
    const auto load = [](const char* name) {
        GltfFixture fixture = test::triangle_fixture();
        fixture.root["extensionsRequired"] = {"KHR_materials_unlit", name};
        return fixture.load();
    };
    for (const char* name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_node_visibility", "ACME_new"}) {
        CHECK_THROWS_WITH_AS(load(name), doctest::Contains(name), InputError);
    }
    for (const char* name : {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_texture_transform",
                             "KHR_lights_punctual", "EXT_texture_webp", "KHR_materials_clearcoat"}) {
        CHECK(load(name).triangle_count() == 1);
    }
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["extensionsRequired"] = {"KHR_texture_basisu", 7};
    CHECK(fixture.fault() == "extensionsRequired[1]");
}

TEST_CASE("gltf_document: what Boxwood does not read may be as broken as it likes") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["animations"] = {{{"channels", -1}}};
    fixture.root["extensions"] = {{"ACME_new", {{"extensions", {{"KHR_lights_punctual", 7}}}}}};
    fixture.root["materials"] = {{{"extensions", {{"ACME_new", 7}}}, {"extras", "none"}}};
    fixture.root["textures"] = json::array({{{"extensions", {{"KHR_texture_basisu", 1}}}}});
    CHECK(fixture.load().triangle_count() == 1);
}

TEST_SUITE_END();
