// SPDX-License-Identifier: MIT
// Writes GLB by hand: a scene of a million instances is a million JSON objects, too many to hold in a document first.
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "io/atomic_file.hpp"
#include "io/gltf_export_materials.hpp"
#include "io/gltf_lines.hpp"
#include "io/gltf_text.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::uint64_t largest_file = std::numeric_limits<std::uint32_t>::max();

enum class Mode { triangles, lines };

/// What glTF calls the elements of an accessor.
struct ElementType {
    const char* component;
    const char* type;
};
constexpr ElementType floats2{"5126", "VEC2"}, floats3{"5126", "VEC3"}, floats4{"5126", "VEC4"},
    words{"5125", "SCALAR"};

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

/// The binary chunk: arrays as they lie in memory, each a buffer view at a multiple of four bytes, and the accessors
/// into them.
class Binary {
public:
    /// Gives the view's index. `target` is "" for none.
    std::size_t add_view(std::span<const std::byte> bytes, const char* target) {
        views_.push_back({bytes, target});
        return views_.size() - 1;
    }
    /// Gives the accessor's index.
    std::size_t add_accessor(std::size_t view, std::size_t offset, std::size_t count, ElementType type,
                             const std::string& more = "") {
        if (accessor_count_ > 0) accessors_ += ',';
        accessors_ += "{\"bufferView\":" + std::to_string(view);
        if (offset > 0) accessors_ += ",\"byteOffset\":" + std::to_string(offset);
        accessors_ += std::string(",\"componentType\":") + type.component + ",\"count\":" + std::to_string(count) +
                      ",\"type\":\"" + type.type + "\"" + more + "}";
        return accessor_count_++;
    }
    /// One view and one accessor for an attribute of vertices.
    template <class Vector>
    std::size_t add_attribute(const std::vector<Vector>& values, ElementType type, const std::string& more = "") {
        return add_accessor(add_view(std::as_bytes(std::span(values)), "34962"), 0, values.size(), type, more);
    }

    std::uint64_t size() const {
        std::uint64_t bytes = 0;
        for (const View& view : views_) bytes += padded(view.bytes.size());
        return bytes;
    }

    void append_json(std::string& text) const {
        if (accessor_count_ > 0) text += ",\"accessors\":[" + accessors_ + "]";
        if (views_.empty()) return;
        Array list(text, "bufferViews");
        std::uint64_t offset = 0;
        for (const View& view : views_) {
            list.next() += "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
                           ",\"byteLength\":" + std::to_string(view.bytes.size()) +
                           (*view.target == 0 ? "" : std::string(",\"target\":") + view.target) + "}";
            offset += padded(view.bytes.size());
        }
        list.end();
        text += ",\"buffers\":[{\"byteLength\":" + std::to_string(offset) + "}]";
    }

    void write(std::ostream& out) const {
        for (const View& view : views_) {
            out.write(reinterpret_cast<const char*>(view.bytes.data()),
                      static_cast<std::streamsize>(view.bytes.size()));
            out.write("\0\0\0", static_cast<std::streamsize>(padded(view.bytes.size()) - view.bytes.size()));
        }
    }

private:
    struct View {
        std::span<const std::byte> bytes;
        const char* target;
    };
    std::vector<View> views_;
    std::string accessors_;
    std::size_t accessor_count_ = 0;
};

// A node with its name, its matrix unless that is the identity, and what it shows, such as "mesh":0.
void append_node(std::string& text, const std::string& name, const glm::mat4& matrix, const std::string& shown) {
    text += '{' + shown;
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

/// The attributes of a mesh as members of a JSON object.
std::string attributes_of(const Mesh& mesh, Binary& binary) {
    const MeshBounds bounds = mesh_bounds(mesh.positions);
    std::string limits = ",\"min\":";
    append_vector(limits, bounds.min);
    limits += ",\"max\":";
    append_vector(limits, bounds.max);
    std::string text = "\"POSITION\":" + std::to_string(binary.add_attribute(mesh.positions, floats3, limits));
    const auto add = [&](const char* name, const auto& values, ElementType type) {
        if (!values.empty())
            text += std::string(",\"") + name + "\":" + std::to_string(binary.add_attribute(values, type));
    };
    add("NORMAL", mesh.normals, floats3);
    add("TANGENT", mesh.tangents, floats4);
    add("TEXCOORD_0", mesh.uvs[0], floats2);
    add("TEXCOORD_1", mesh.uvs[1], floats2);
    add("COLOR_0", mesh.colors, floats4);
    return text;
}

// A primitive for each run of triangles of one material, so that triangles keep their order.
void append_primitives(std::string& text, const Mesh& mesh, Mode mode, Binary& binary) {
    const std::string attributes = attributes_of(mesh, binary);
    const std::size_t view = binary.add_view(std::as_bytes(std::span(mesh.triangles)), "34963");
    const auto material = [&mesh](std::size_t i) { return mesh.materials.empty() ? BOXWOOD_NONE : mesh.materials[i]; };
    text += "\"primitives\":[";
    for (std::size_t first = 0, end = 0; first < mesh.triangles.size(); first = end) {
        while (end < mesh.triangles.size() && material(end) == material(first)) ++end;
        const std::size_t indices = binary.add_accessor(view, 12 * first, 3 * (end - first), words);
        if (first > 0) text += ',';
        text += "{\"attributes\":{" + attributes + "},\"indices\":" + std::to_string(indices);
        if (material(first) != BOXWOOD_NONE) text += ",\"material\":" + std::to_string(material(first));
        text += mode == Mode::lines ? ",\"mode\":1}" : "}";
    }
    text += ']';
}

void append_meshes(std::string& text, const std::vector<Mesh>& meshes, Mode mode, Binary& binary) {
    Array list(text, "meshes");
    for (const Mesh& mesh : meshes) {
        list.next() += '{';
        append_primitives(text, mesh, mode, binary);
        if (!mesh.name.empty()) text += ",\"name\":" + quoted(mesh.name);
        text += '}';
    }
    list.end();
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
        append_node(nodes.next(), instance.name, instance.transform, "\"mesh\":" + std::to_string(instance.mesh));
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        append_node(nodes.next(), scene.cameras[i].name, scene.cameras[i].to_world, "\"camera\":" + std::to_string(i));
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        append_node(nodes.next(), scene.lights[i].name, placement(scene.lights[i]),
                    "\"extensions\":{\"KHR_lights_punctual\":{\"light\":" + std::to_string(i) + "}}");
    }
    nodes.end();
}

// glTF forbids empty arrays, so what a scene lacks is left out.
std::string make_json(const Scene& scene, Mode mode, Binary& binary) {
    std::string text = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Boxwood\"},\"scene\":0";
    if (!scene.meshes.empty()) append_meshes(text, scene.meshes, mode, binary);
    std::vector<std::size_t> image_views;
    for (const EncodedImage& image : scene.images) image_views.push_back(binary.add_view(image.bytes, ""));
    append_materials(text, scene, image_views);
    binary.append_json(text);
    if (!scene.cameras.empty()) append_cameras(text, scene.cameras);
    const std::size_t nodes = scene.instances.size() + scene.cameras.size() + scene.lights.size();
    if (nodes == 0) {
        text += ",\"scenes\":[{}]";
    } else {
        append_nodes(text, scene);
        text += ",\"scenes\":[{\"nodes\":[";
        for (std::size_t i = 0; i < nodes; ++i) text += (i > 0 ? "," : "") + std::to_string(i);
        text += "]}]";
    }
    text += '}';
    text.append((4 - text.size() % 4) % 4, ' ');
    return text;
}

void write_u32(std::ostream& out, std::uint64_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    out.write(reinterpret_cast<const char*>(&word), sizeof word);
}

void save(const std::filesystem::path& file, const Scene& scene, Mode mode) {
    validate(scene, file.string());
    Binary binary;
    const std::string text = make_json(scene, mode, binary);
    const std::uint64_t size = binary.size();
    const std::uint64_t total = 12 + 8 + text.size() + (size > 0 ? 8 + size : 0);
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
    if (size > 0) {
        write_u32(out, size);
        out.write("BIN\0", 4);
        binary.write(out);
    }
    target.commit();
}

} // namespace

void save_glb(const std::filesystem::path& file, const Scene& scene) { save(file, scene, Mode::triangles); }

void save_glb_lines(const std::filesystem::path& file, const Scene& scene) { save(file, scene, Mode::lines); }

} // namespace boxwood
