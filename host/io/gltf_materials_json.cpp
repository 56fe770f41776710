// SPDX-License-Identifier: MIT
// Checks of what a glTF file says about materials, textures and lights; numbers out of range are corrected where they
// are read.
#include "io/gltf_extensions.hpp"
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
void check_alpha_mode(const F& material) {
    const nlohmann::json* mode = material.find("alphaMode");
    if (mode == nullptr || *mode == "OPAQUE" || *mode == "MASK" || *mode == "BLEND") return;
    material.warn("alphaMode", "is not a mode that glTF knows; taken as OPAQUE");
    material.erase("alphaMode");
}

template <class F>
void check_material(const F& material) {
    material.string("name");
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) check_texture_info(material, key);
    material.numbers("emissiveFactor", 3);
    check_alpha_mode(material);
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
    const auto glossy = extensions.object(specular_glossiness);
    glossy.numbers("diffuseFactor", 4);
    check_texture_info(glossy, "diffuseTexture");
}

template <class F>
void check_light(const F& light) {
    light.string("name");
    light.string("type", true);
    light.numbers("color", 3);
    light.number("intensity");
    light.number("range");
    if (light.find("spot") == nullptr) return;
    const auto spot = light.object("spot");
    spot.number("innerConeAngle");
    spot.number("outerConeAngle");
}

} // namespace

void check_gltf_materials(nlohmann::json& root, const FieldReport& report) {
    const auto top = [] { return std::string(); };
    for_each(root, "materials", report, top, [](const auto&, const auto& f) { check_material(f); });
    for_each(root, "textures", report, top, [](const auto&, const auto& f) {
        f.reference("source");
        f.reference("sampler");
    });
    for_each(root, "samplers", report, top, [](const auto&, const auto& f) {
        for (const char* key : {"wrapS", "wrapT", "magFilter"}) f.index(key);
    });
    for_each(root, "images", report, top, [](const auto&, const auto& f) {
        f.string("name");
        f.string("uri");
        f.reference("bufferView");
    });
    if (root.find("extensions") == root.end()) return;
    const auto extensions = Fields(&root, report, top).object("extensions");
    if (extensions.find("KHR_lights_punctual") == nullptr) return;
    extensions.object("KHR_lights_punctual"); // is one
    const std::string path = "extensions.KHR_lights_punctual.";
    for_each(
        *extensions.find("KHR_lights_punctual"), "lights", report, [&path] { return path; },
        [](const auto&, const auto& f) { check_light(f); });
}

} // namespace boxwood
