// SPDX-License-Identifier: MIT
#include "io/gltf_json_reader.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "boxwood/error.hpp"

namespace boxwood {

namespace {

// Deeper than any glTF property that is kept.
constexpr std::size_t deepest_nesting = 64;

constexpr std::array<std::string_view, 15> sections{
    "asset",    "accessors", "bufferViews", "buffers",    "cameras",
    "meshes",   "nodes",     "scene",       "scenes",     "materials",
    "textures", "samplers",  "images",      "extensions", "extensionsRequired"};

constexpr std::array<std::string_view, 6> extensions{
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_materials_emissive_strength",
    "KHR_materials_specular",  "KHR_materials_unlit", "KHR_texture_transform"};

template <class List>
bool contains(const List& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

} // namespace

// The number of open objects and arrays is 1 in the root, 3 in an element of a root array, 4 in an object of that element.
bool GltfJsonReader::keep(const std::string& key) {
    const std::size_t depth = open_.size();
    if (depth == 1) section_ = key;
    if (depth < extension_depth_) extension_depth_ = 0;
    if (depth == extension_depth_) return contains(extensions, key);
    if (key == "extensions") {
        // An extension inside another has none that is read.
        if (extension_depth_ > 0 || (section_ != "nodes" && section_ != "materials" && depth > 1)) return false;
        extension_depth_ = depth + 1;
        return true;
    }
    if (depth == 1) return contains(sections, key);
    return key != "extras" && !(section_ == "accessors" && (key == "min" || key == "max"));
}

bool GltfJsonReader::key(string_t& key) {
    if (skipped_depth_ == 0) {
        skip_next_ = !keep(key);
        key_ = std::move(key);
    }
    return true;
}

/// True for a scalar that is left out.
bool GltfJsonReader::skips() {
    if (skipped_depth_ > 0) return true;
    return std::exchange(skip_next_, false);
}

// Values before it in its array may move, but they are complete; the containers that are open stay where they are.
nlohmann::json* GltfJsonReader::place(nlohmann::json value) {
    if (open_.empty()) {
        root_ = std::move(value);
        return &root_;
    }
    nlohmann::json& parent = *open_.back();
    if (parent.is_object()) return &(parent[key_] = std::move(value));
    parent.push_back(std::move(value));
    return &parent.back();
}

bool GltfJsonReader::add(nlohmann::json value) {
    if (!skips()) place(std::move(value));
    return true;
}

bool GltfJsonReader::open(nlohmann::json value) {
    if (skips()) {
        ++skipped_depth_;
        return true;
    }
    if (open_.size() == deepest_nesting) throw InputError(file_, "JSON", "is nested too deeply");
    open_.push_back(place(std::move(value)));
    return true;
}

bool GltfJsonReader::close() {
    if (skipped_depth_ > 0) {
        --skipped_depth_;
    } else {
        open_.pop_back();
    }
    return true;
}

bool GltfJsonReader::parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) {
    throw InputError(file_, "JSON", std::string("cannot be parsed (is this a glTF file?): ") + error.what());
}

} // namespace boxwood
