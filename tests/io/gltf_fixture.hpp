// SPDX-License-Identifier: MIT
// Small glTF files made in memory: a JSON document whose only buffer is a GLB chunk filled piece by piece.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "io/gltf_document.hpp"

namespace boxwood::test {

class GltfFixture {
public:
    nlohmann::json root = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> binary;

    /// Adds a buffer view with these values, 4-byte aligned, and gives its index.
    template <class T>
    std::size_t view(const std::vector<T>& values, std::size_t stride = 0) {
        nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride != 0) view["byteStride"] = stride;
        const auto bytes = std::as_bytes(std::span(values));
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        binary.resize((binary.size() + 3) / 4 * 4);
        return append("bufferViews", view);
    }

    std::size_t accessor(std::size_t view, int component_type, std::size_t count, const char* type) {
        return append("accessors",
                      {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
    }

    std::size_t positions(const std::vector<float>& values) {
        return accessor(view(values), 5126, values.size() / 3, "VEC3");
    }

    std::size_t indices(const std::vector<std::uint32_t>& values) {
        return accessor(view(values), 5125, values.size(), "SCALAR");
    }

    /// Adds a mesh of one primitive and a node that shows it.
    void show(const nlohmann::json& primitive, nlohmann::json node = nlohmann::json::object()) {
        node["mesh"] = append("meshes", {{"primitives", {primitive}}});
        append("nodes", node);
    }

    std::size_t append(const char* array, const nlohmann::json& value) {
        root[array].push_back(value);
        return root[array].size() - 1;
    }

    std::vector<std::byte> bytes() const {
        nlohmann::json whole = root;
        if (!binary.empty() && !whole.contains("buffers")) whole["buffers"] = {{{"byteLength", binary.size()}}};
        std::string json = whole.dump();
        json.append((4 - json.size() % 4) % 4, ' ');
        std::vector<std::byte> file;
        const auto add_word = [&file](std::size_t value) {
            for (int i = 0; i < 4; ++i) file.push_back(static_cast<std::byte>(value >> (8 * i)));
        };
        const auto add = [&file](std::span<const std::byte> more) {
            file.insert(file.end(), more.begin(), more.end());
        };
        add_word(0x46546c67);
        add_word(2);
        add_word(20 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
        add_word(json.size());
        add_word(0x4e4f534a);
        add(std::as_bytes(std::span(json)));
        if (binary.empty()) return file;
        add_word(binary.size());
        add_word(0x004e4942);
        add(binary);
        return file;
    }

    Scene load() const {
        Scene scene = load_gltf_memory(bytes(), "test.glb", {});
        validate(scene, "test.glb");
        return scene;
    }

    /// The element that the InputError names, or "no error".
    std::string fault() const {
        try {
            load();
        } catch (const InputError& error) {
            return error.file == "test.glb" ? error.where : "wrong file: " + error.file;
        }
        return "no error";
    }
};

/// One right triangle in the plane z = 0, shown by one node.
inline GltfFixture triangle_fixture() {
    GltfFixture fixture;
    const std::size_t positions = fixture.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    fixture.show({{"attributes", {{"POSITION", positions}}}, {"indices", fixture.indices({0, 1, 2})}});
    return fixture;
}

} // namespace boxwood::test
