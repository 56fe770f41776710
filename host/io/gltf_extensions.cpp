// SPDX-License-Identifier: MIT
#include "io/gltf_extensions.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"
#include "io/gltf_document.hpp"

namespace boxwood {

namespace {

using nlohmann::json;

/// Of materials and sound: what one changes is replaced, so that it never refuses a file.
constexpr std::array neutral_prefixes{"KHR_materials_",   "KHR_texture_",   "KHR_lights_", "KHR_xmp",
                                      "EXT_materials_",   "EXT_texture_",   "EXT_lights_", "MSFT_texture_",
                                      "ADOBE_materials_", "KHR_animation_", "KHR_audio",   "GOOGLE_texture_"};

constexpr std::array<std::string_view, 7> read_extensions{
    "KHR_materials_unlit", "KHR_materials_specular", "KHR_materials_emissive_strength", "KHR_texture_transform",
    "KHR_lights_punctual", "KHR_mesh_quantization",  "EXT_mesh_gpu_instancing"};

/// What stands in for an extension that is not read.
struct Substitute {
    std::string_view extension;
    const char* text;
};

constexpr std::array meshopt{"EXT_meshopt_compression", "KHR_meshopt_compression", "MESHOPT_compression"};

constexpr const char* uncompressed = "the uncompressed data beside it is";
constexpr const char* other_picture = "the PNG or JPEG beside it is";

constexpr std::array<Substitute, 21> substitutes{{
    {draco, "the uncompressed data beside it is, and primitives without that are left out"},
    {meshopt[0], uncompressed},
    {meshopt[1], uncompressed},
    {meshopt[2], uncompressed},
    {specular_glossiness,
     "pbrMetallicRoughness beside it is, or else its diffuse part as the base colour of a matte surface"},
    {"KHR_materials_anisotropy", "highlights are round"},
    {"KHR_materials_clearcoat", "surfaces have no coat"},
    {"KHR_materials_diffuse_transmission", "surfaces let no light through"},
    {"KHR_materials_dispersion", "all colours go the same way"},
    {"KHR_materials_ior", "surfaces reflect as with an index of refraction of 1.5"},
    {"KHR_materials_iridescence", "reflections have no colours of thin films"},
    {"KHR_materials_sheen", "surfaces have no sheen"},
    {"KHR_materials_transmission", "surfaces let no light through"},
    {"KHR_materials_variants", "each primitive has its own material"},
    {"KHR_materials_volume", "surfaces let no light through"},
    {"KHR_node_visibility", "every node is visible"},
    {"KHR_texture_basisu", other_picture},
    {"EXT_texture_avif", other_picture},
    {"EXT_texture_webp", other_picture},
    {"MSFT_texture_dds", other_picture},
    {"MSFT_lod", "the node that lists the others is"},
}};

bool is_read(std::string_view name) {
    return std::find(read_extensions.begin(), read_extensions.end(), name) != read_extensions.end();
}

const char* substitute_of(std::string_view name) {
    const auto found = std::find_if(substitutes.begin(), substitutes.end(),
                                    [name](const Substitute& each) { return each.extension == name; });
    return found == substitutes.end() ? "what is there without it is" : found->text;
}

} // namespace

void check_required_extensions(const json& root, const std::string& file) {
    const auto required = root.find("extensionsRequired");
    if (required == root.end()) return;
    if (!required->is_array()) throw InputError(file, "extensionsRequired", "is not an array");
    for (std::size_t i = 0; i < required->size(); ++i) {
        const json& name = (*required)[i];
        if (!name.is_string()) throw InputError(file, element("extensionsRequired", i), "is not a string");
        const auto& word = name.get_ref<const std::string&>();
        const bool neutral = std::any_of(neutral_prefixes.begin(), neutral_prefixes.end(),
                                         [&word](const char* prefix) { return word.starts_with(prefix); });
        if (!neutral && !is_read(word)) {
            throw InputError(file, element("extensionsRequired", i),
                             "asks for " + excerpt(word) + ", which is not supported; export the scene without it");
        }
    }
}

void warn_of_extensions(const json& root, Warnings& warnings) {
    std::set<std::string_view> named;
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        const auto found = root.find(list);
        if (found == root.end() || !found->is_array()) continue; // the former is for information only
        for (std::size_t i = 0; i < found->size(); ++i) {
            if (!(*found)[i].is_string()) continue;
            const std::string_view name = (*found)[i].get_ref<const std::string&>();
            if (is_read(name) || !named.insert(name).second) continue;
            warnings.add(element(list, i), excerpt(name) + " is not read; " + substitute_of(name));
        }
    }
}

std::string unread_buffer_compression(const json& root) {
    const json used = root.value("extensionsUsed", json::array());
    for (const char* name : meshopt)
        if (std::find(used.begin(), used.end(), name) != used.end()) return name;
    return "";
}

} // namespace boxwood
