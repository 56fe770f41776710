// SPDX-License-Identifier: MIT
// tinygltf ignores fields of a wrong type and follows some indices unchecked, so its input is checked first.
#include <algorithm>
#include <array>
#include <cstdint>

#include "boxwood/error.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_extensions.hpp"
#include "io/gltf_fields.hpp"
#include "io/gltf_json_reader.hpp"

namespace boxwood {

namespace {

using nlohmann::json;

template <class F>
void check_accessor(const F& accessor) {
    accessor.reference("bufferView");
    accessor.size("byteOffset");
    accessor.one_of("componentType", {5120, 5121, 5122, 5123, 5125, 5126});
    accessor.size("count", true);
    accessor.one_of("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
    accessor.string("name");
    accessor.boolean("normalized");
    if (accessor.find("sparse") == nullptr) return;
    const auto sparse = accessor.object("sparse");
    sparse.index("count", true);
    const auto indices = sparse.object("indices", true);
    indices.index("bufferView", true);
    indices.index("byteOffset");
    indices.index("componentType", true);
    const auto values = sparse.object("values", true);
    values.index("bufferView", true);
    values.index("byteOffset");
}

template <class F>
void check_buffer_view(const F& view) {
    view.index("buffer", true);
    view.size("byteOffset");
    view.size("byteLength", true);
    view.size("byteStride");
    const json* stride = view.find("byteStride");
    if (stride == nullptr) return;
    if (*stride == 0) {
        view.warn("byteStride", "is 0, which glTF forbids; taken as absent");
        view.erase("byteStride");
    } else if (*stride < 4 || *stride > 252 || stride->get<std::uint64_t>() % 4 != 0) {
        view.warn("byteStride", "is not a multiple of 4 from 4 to 252; followed as it is");
    }
}

std::size_t array_size(const json& root, const char* key) {
    const auto found = root.find(key);
    return found == root.end() ? 0 : found->size();
}

template <class F>
void check_primitive(const json& root, json& value, const F& primitive) {
    primitive.index_map("attributes", true);
    primitive.reference("indices");
    primitive.reference("material");
    primitive.index("mode");
    primitive.object("extensions").object(draco);          // is one
    if (const json* indices = primitive.find("indices")) { // right even in a mesh that no node shows
        const auto index = indices->get<std::size_t>();
        if (index >= array_size(root, "accessors")) primitive.fail("indices", "names an accessor that does not exist");
        const json& accessor = root["accessors"][index];
        const auto view = accessor.find("bufferView");
        if (view != accessor.end() && view->get<std::size_t>() >= array_size(root, "bufferViews"))
            primitive.fail("indices", "names an accessor whose bufferView does not exist");
    }
    const auto targets = value.find("targets");
    if (targets == value.end()) return;
    if (!targets->is_array()) primitive.fail("targets", "is not an array");
    for (json& target : *targets) primitive.check_index_map(target, "targets");
}

template <class F>
void check_light_of(const F& extension) {
    extension.find("light", true);
    extension.reference("light");
}

template <class F>
void check_node(const F& node) {
    node.reference("mesh");
    node.reference("camera");
    node.reference("skin");
    node.numbers("weights");
    node.indices("children");
    node.numbers("matrix", 16);
    node.numbers("translation", 3);
    node.numbers("rotation", 4);
    node.numbers("scale", 3);
    node.string("name");
    if (node.find("extensions") == nullptr) return;
    const auto extensions = node.object("extensions");
    if (extensions.find("KHR_lights_punctual") != nullptr) check_light_of(extensions.object("KHR_lights_punctual"));
    if (extensions.find("EXT_mesh_gpu_instancing") == nullptr) return;
    extensions.object("EXT_mesh_gpu_instancing").index_map("attributes", true);
}

template <class F>
void check_camera(const F& camera) {
    camera.string("name");
    camera.one_of("type", {"perspective", "orthographic"});
    if (*camera.find("type") == "perspective") {
        const auto fields = camera.object("perspective", true);
        for (const char* key : {"yfov", "znear"}) fields.number(key, true);
        for (const char* key : {"zfar", "aspectRatio"}) fields.number(key);
    } else {
        const auto fields = camera.object("orthographic", true);
        for (const char* key : {"xmag", "ymag", "znear", "zfar"}) fields.number(key, true);
    }
}

template <class F>
void check_asset(const F& fields, const std::string& file) {
    const auto asset = fields.object("asset", true);
    asset.string("version", true);
    asset.string("minVersion");
    const auto version = asset.find("version")->template get<std::string>();
    if (!version.starts_with("2."))
        throw InputError(file, "asset.version", "is " + excerpt(version) + "; only 2.x can be read");
    const json* minimum = asset.find("minVersion");
    if (minimum != nullptr && *minimum != "2.0") {
        throw InputError(file, "asset.minVersion",
                         "asks for a reader of " + excerpt(minimum->template get<std::string>()) +
                             "; this one is of 2.0");
    }
}

} // namespace

void check_gltf_fields(json& root, const std::string& file, Warnings& warnings) {
    const FieldReport report{file, warnings};
    const auto top = [] { return std::string(); };
    const Fields fields(&root, report, top);
    check_asset(fields, file);
    fields.reference("scene");
    for_each(root, "accessors", report, top, [](const json&, const auto& f) { check_accessor(f); });
    for_each(root, "bufferViews", report, top, [](const json&, const auto& f) { check_buffer_view(f); });
    for_each(root, "buffers", report, top, [](const json&, const auto& f) {
        f.size("byteLength", true);
        f.string("uri");
    });
    for_each(root, "meshes", report, top, [&](json& mesh, const auto& f) {
        f.string("name");
        f.numbers("weights");
        for_each(
            mesh, "primitives", report, [&f] { return f.path() + "."; },
            [&root](json& value, const auto& primitive) { check_primitive(root, value, primitive); });
    });
    for_each(root, "nodes", report, top, [](const json&, const auto& f) { check_node(f); });
    for_each(root, "skins", report, top, [](const json&, const auto& f) {
        f.string("name");
        f.numbered_indices("joints");
        f.reference("inverseBindMatrices");
    });
    for_each(root, "cameras", report, top, [](const json&, const auto& f) { check_camera(f); });
    for_each(root, "scenes", report, top, [](const json&, const auto& f) {
        f.string("name");
        f.indices("nodes");
    });
    check_gltf_materials(root, report);
}

json parse_gltf_json(std::string_view text, const std::string& file) {
    GltfJsonReader reader(file);
    json::sax_parse(text.begin(), text.end(), &reader);
    json root = reader.take();
    if (!root.is_object()) throw InputError(file, "JSON", "is not an object (is this a glTF file?)");
    return root;
}

} // namespace boxwood
