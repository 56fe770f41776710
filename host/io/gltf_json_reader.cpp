// SPDX-License-Identifier: MIT
#include "io/gltf_json_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"

namespace boxwood {

namespace {

// Deeper than any glTF property that is kept.
constexpr std::size_t deepest_nesting = 64;

constexpr std::array<std::string_view, 17> sections{
    "asset",  "accessors", "bufferViews", "buffers",        "cameras",           "meshes",
    "nodes",  "scene",     "scenes",      "materials",      "textures",          "samplers",
    "images", "skins",     "extensions",  "extensionsUsed", "extensionsRequired"};

constexpr std::array<std::string_view, 8> extensions{"EXT_mesh_gpu_instancing",
                                                     "KHR_draco_mesh_compression",
                                                     "KHR_lights_punctual",
                                                     "KHR_materials_emissive_strength",
                                                     "KHR_materials_pbrSpecularGlossiness",
                                                     "KHR_materials_specular",
                                                     "KHR_materials_unlit",
                                                     "KHR_texture_transform"};
constexpr std::array<std::string_view, 3> extended_sections{"meshes", "nodes", "materials"};

constexpr double largest_exact_integer = 0x1p53;

template <class List>
bool contains(const List& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

} // namespace

// The number of open objects and arrays is 1 in the root, 3 in an element of a root array, 4 in an object of that
// element.
bool GltfJsonReader::keep(const std::string& key) {
    const std::size_t depth = open_.size();
    if (depth == 1) section_ = key;
    if (!extensions_.empty() && depth == extensions_.back().depth) {
        const bool kept = contains(extensions, key);
        extensions_.back().has_foreign = extensions_.back().has_foreign || !kept;
        return kept;
    }
    if (key == "extensions") return depth == 1 || contains(extended_sections, section_);
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

bool GltfJsonReader::number_float(number_float_t value, const string_t&) {
    const bool whole = std::trunc(value) == value && std::abs(value) <= largest_exact_integer;
    if (!whole || (value == 0.0 && std::signbit(value))) return add(value);
    return value < 0.0 ? add(static_cast<number_integer_t>(value)) : add(static_cast<number_unsigned_t>(value));
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
    const bool extends = value.is_object() && !open_.empty() && open_.back()->is_object() && key_ == "extensions";
    open_.push_back(place(std::move(value)));
    if (extends) extensions_.push_back({open_.size()});
    return true;
}

bool GltfJsonReader::close() {
    if (skipped_depth_ > 0) {
        --skipped_depth_;
        return true;
    }
    const bool is_empty = open_.back()->empty();
    const std::size_t depth = open_.size();
    open_.pop_back();
    if (extensions_.empty() || depth != extensions_.back().depth) return true;
    // What is empty in the document is so in the file.
    if (is_empty && extensions_.back().has_foreign) open_.back()->erase("extensions");
    extensions_.pop_back();
    return true;
}

bool GltfJsonReader::parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) {
    throw InputError(file_, "JSON", "cannot be parsed (is this a glTF file?): " + excerpt(error.what()));
}

} // namespace boxwood
