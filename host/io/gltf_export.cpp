// SPDX-License-Identifier: MIT
// Writes GLB by hand: a scene of a million instances is a million JSON objects, too many to hold in a document first.
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "io/atomic_file.hpp"
#include "io/gltf_lines.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::uint64_t largest_file = std::numeric_limits<std::uint32_t>::max();

// The shortest decimal that reads back as the same float, also through a reader that goes by way of double.
void append_number(std::string& text, float value) {
    if (value == 0.0f) { // "-0" would be read as an integer, which has no negative zero
        text += std::signbit(value) ? "-0.0" : "0";
        return;
    }
    std::array<char, 32> digits{};
    char* end = std::to_chars(digits.begin(), digits.end(), value).ptr;
    double read = 0.0;
    std::from_chars(digits.begin(), end, read);
    if (static_cast<float>(read) != value) {
        end = std::to_chars(digits.begin(), digits.end(), static_cast<double>(value)).ptr;
    }
    text.append(digits.data(), end);
}

std::string quoted(const std::string& name) {
    return nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// One element after another of a JSON array, with the commas between them.
class Array {
public:
    Array(std::string& text, const char* key) : text_(text) { text_ += std::string(",\"") + key + "\":["; }
    std::string& next() {
        if (!first_) text_ += ',';
        first_ = false;
        return text_;
    }
    void end() { text_ += ']'; }

private:
    std::string& text_;
    bool first_ = true;
};

// A node with its name, its matrix unless that is the identity, and a reference such as "mesh":0.
void append_node(std::string& text, const std::string& name, const glm::mat4& matrix, const char* reference,
                 std::size_t index) {
    text += std::string("{\"") + reference + "\":" + std::to_string(index);
    if (!name.empty()) text += ",\"name\":" + quoted(name);
    static const glm::mat4 identity(1.0f);
    if (std::memcmp(&matrix, &identity, sizeof matrix) != 0) { // by bits: -0 and 0 are told apart
        text += ",\"matrix\":[";
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                if (column + row > 0) text += ',';
                append_number(text, matrix[column][row]);
            }
        }
        text += ']';
    }
    text += '}';
}

void append_vector(std::string& text, const glm::vec3& value) {
    for (int axis = 0; axis < 3; ++axis) {
        text += axis == 0 ? '[' : ',';
        append_number(text, value[axis]);
    }
    text += ']';
}

std::uint64_t position_bytes(const Mesh& mesh) { return std::uint64_t{12} * mesh.positions.size(); }
std::uint64_t triangle_bytes(const Mesh& mesh) { return std::uint64_t{12} * mesh.triangles.size(); }

enum class Mode { triangles, lines };

// Mesh i has accessors and buffer views 2i (positions) and 2i + 1 (indices), in this order in the binary chunk.
void append_meshes(std::string& text, const std::vector<Mesh>& meshes, Mode mode) {
    Array list(text, "meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        list.next() += "{\"primitives\":[{\"attributes\":{\"POSITION\":" + std::to_string(2 * i) +
                       "},\"indices\":" + std::to_string(2 * i + 1) + (mode == Mode::lines ? ",\"mode\":1}]" : "}]");
        if (!meshes[i].name.empty()) text += ",\"name\":" + quoted(meshes[i].name);
        text += '}';
    }
    list.end();
}

void append_accessors(std::string& text, const std::vector<Mesh>& meshes) {
    Array list(text, "accessors");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const MeshBounds bounds = mesh_bounds(meshes[i].positions);
        list.next() += "{\"bufferView\":" + std::to_string(2 * i) +
                       ",\"componentType\":5126,\"count\":" + std::to_string(meshes[i].positions.size()) +
                       ",\"type\":\"VEC3\",\"min\":";
        append_vector(text, bounds.min);
        text += ",\"max\":";
        append_vector(text, bounds.max);
        text += '}';
        list.next() += "{\"bufferView\":" + std::to_string(2 * i + 1) +
                       ",\"componentType\":5125,\"count\":" + std::to_string(3 * meshes[i].triangles.size()) +
                       ",\"type\":\"SCALAR\"}";
    }
    list.end();
}

void append_buffer_views(std::string& text, const std::vector<Mesh>& meshes) {
    Array list(text, "bufferViews");
    std::uint64_t offset = 0;
    const auto append = [&](std::uint64_t bytes, const char* target) {
        list.next() += "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
                       ",\"byteLength\":" + std::to_string(bytes) + ",\"target\":" + target + "}";
        offset += bytes;
    };
    for (const Mesh& mesh : meshes) {
        append(position_bytes(mesh), "34962");
        append(triangle_bytes(mesh), "34963");
    }
    list.end();
    text += ",\"buffers\":[{\"byteLength\":" + std::to_string(offset) + "}]";
}

// glTF demands a zfar of orthographic cameras and a znear of both; Boxwood has no use for either.
void append_cameras(std::string& text, const std::vector<Camera>& cameras) {
    Array list(text, "cameras");
    for (const Camera& camera : cameras) {
        list.next();
        if (camera.perspective) {
            text += "{\"type\":\"perspective\",\"perspective\":{\"znear\":0.01,\"yfov\":";
            append_number(text, camera.vertical_fov);
        } else {
            text += "{\"type\":\"orthographic\",\"orthographic\":{\"znear\":0,\"zfar\":1000,\"xmag\":";
            append_number(text, camera.half_height);
            text += ",\"ymag\":";
            append_number(text, camera.half_height);
        }
        text += "}}";
    }
    list.end();
}

void append_nodes(std::string& text, const Scene& scene) {
    Array nodes(text, "nodes");
    for (const Instance& instance : scene.instances) {
        append_node(nodes.next(), instance.name, instance.transform, "mesh", instance.mesh);
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        append_node(nodes.next(), scene.cameras[i].name, scene.cameras[i].to_world, "camera", i);
    }
    nodes.end();
    text += ",\"scenes\":[{\"nodes\":[";
    for (std::size_t i = 0; i < scene.instances.size() + scene.cameras.size(); ++i) {
        if (i > 0) text += ',';
        text += std::to_string(i);
    }
    text += "]}]";
}

// glTF forbids empty arrays, so what a scene lacks is left out.
std::string make_json(const Scene& scene, Mode mode) {
    std::string text = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Boxwood\"},\"scene\":0";
    if (!scene.meshes.empty()) {
        append_meshes(text, scene.meshes, mode);
        append_accessors(text, scene.meshes);
        append_buffer_views(text, scene.meshes);
    }
    if (!scene.cameras.empty()) append_cameras(text, scene.cameras);
    if (scene.instances.empty() && scene.cameras.empty()) {
        text += ",\"scenes\":[{}]";
    } else {
        append_nodes(text, scene);
    }
    text += '}';
    text.append((4 - text.size() % 4) % 4, ' ');
    return text;
}

void write_u32(std::ostream& out, std::uint64_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    out.write(reinterpret_cast<const char*>(&word), sizeof word);
}

template <class T>
void write_array(std::ostream& out, const std::vector<T>& values) {
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

void save(const std::filesystem::path& file, const Scene& scene, Mode mode) {
    validate(scene, file.string());
    const std::string text = make_json(scene, mode);
    std::uint64_t binary = 0;
    for (const Mesh& mesh : scene.meshes) binary += position_bytes(mesh) + triangle_bytes(mesh);
    const std::uint64_t total = 12 + 8 + text.size() + (binary > 0 ? 8 + binary : 0);
    if (total > largest_file) {
        throw InputError(file.string(), "", "would have " + std::to_string(total) + " bytes; GLB ends at 4 GiB");
    }

    AtomicFile target(file);
    std::ostream& out = target.stream();
    out << "glTF";
    write_u32(out, 2);
    write_u32(out, total);
    write_u32(out, text.size());
    out << "JSON" << text;
    if (binary > 0) {
        write_u32(out, binary);
        out.write("BIN\0", 4);
        for (const Mesh& mesh : scene.meshes) {
            write_array(out, mesh.positions);
            write_array(out, mesh.triangles);
        }
    }
    target.commit();
}

} // namespace

void save_glb(const std::filesystem::path& file, const Scene& scene) { save(file, scene, Mode::triangles); }

void save_glb_lines(const std::filesystem::path& file, const Scene& scene) { save(file, scene, Mode::lines); }

} // namespace boxwood
