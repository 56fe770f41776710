// SPDX-License-Identifier: MIT
// Checks of what a glTF file says about materials, textures and lights; numbers out of range are corrected where they are read.
#include "io/gltf_fields.hpp"

namespace boxwood {

namespace {

template <class F>
void check_texture_info(const F& owner, const char* key) {
    if (owner.find(key) == nullptr) return;
    const auto info = owner.object(key);
    info.index("index", true);
    info.index("texCoord");
    info.number("scale");
    info.number("strength");
    if (info.find("extensions") == nullptr) return;
    const auto extensions = info.object("extensions");
    const auto transform = extensions.object("KHR_texture_transform");
    transform.numbers("offset", 2);
    transform.numbers("scale", 2);
    transform.number("rotation");
    transform.index("texCoord");
}

template <class F>
void check_material(const F& material) {
    material.string("name");
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) check_texture_info(material, key);
    material.numbers("emissiveFactor", 3);
    if (material.find("alphaMode") != nullptr) material.one_of("alphaMode", {"OPAQUE", "MASK", "BLEND"});
    material.number("alphaCutoff");
    material.boolean("doubleSided");
    if (material.find("pbrMetallicRoughness") != nullptr) {
        const auto pbr = material.object("pbrMetallicRoughness");
        pbr.numbers("baseColorFactor", 4);
        pbr.number("metallicFactor");
        pbr.number("roughnessFactor");
        check_texture_info(pbr, "baseColorTexture");
        check_texture_info(pbr, "metallicRoughnessTexture");
    }
    if (material.find("extensions") == nullptr) return;
    const auto extensions = material.object("extensions");
    extensions.object("KHR_materials_emissive_strength").number("emissiveStrength");
    extensions.object("KHR_materials_specular").number("specularFactor");
    extensions.object("KHR_materials_unlit");
}

template <class F>
void check_light(const F& light) {
    light.string("name");
    light.one_of("type", {"point", "spot", "directional"});
    light.numbers("color", 3);
    light.number("intensity");
    light.number("range");
    if (light.find("spot") == nullptr) return;
    const auto spot = light.object("spot");
    spot.number("innerConeAngle");
    spot.number("outerConeAngle");
}

} // namespace

void check_gltf_looks(const nlohmann::json& root, const std::string& file) {
    const auto top = [] { return std::string(); };
    for_each(root, "materials", file, top, [](const auto&, const auto& f) { check_material(f); });
    for_each(root, "textures", file, top, [](const auto&, const auto& f) {
        f.index("source");
        f.index("sampler");
    });
    for_each(root, "samplers", file, top, [](const auto&, const auto& f) {
        for (const char* key : {"wrapS", "wrapT", "magFilter"}) f.index(key);
    });
    for_each(root, "images", file, top, [](const auto&, const auto& f) {
        f.string("name");
        f.string("uri");
        f.index("bufferView");
    });
    if (root.find("extensions") == root.end()) return;
    const auto extensions = Fields(root, file, top).object("extensions");
    if (extensions.find("KHR_lights_punctual") == nullptr) return;
    extensions.object("KHR_lights_punctual"); // is one
    const std::string path = "extensions.KHR_lights_punctual.";
    for_each(
        *extensions.find("KHR_lights_punctual"), "lights", file, [&path] { return path; },
        [](const auto&, const auto& f) { check_light(f); });
}

} // namespace boxwood
