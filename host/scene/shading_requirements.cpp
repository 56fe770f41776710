// SPDX-License-Identifier: MIT
#include "scene/shading_reasons.hpp"

#include <algorithm>
#include <array>

#include "scene/element.hpp"
#include "scene/materials_in_use.hpp"
#include "scene/picture.hpp"

namespace boxwood {

namespace {

auto is(const std::string& word) {
    return [word](const Reason& reason) { return reason.word == word; };
}

/// Requirements and, beside each, the element that asked first.
class Needs {
public:
    void add(const Scene& scene, const Material& material, const std::string& element) {
        const auto uses = texture_uses(material);
        static constexpr std::array inputs{"base colour", "metallic-roughness", "normal", "occlusion", "emission"};
        for (std::size_t i = 0; i < uses.size(); ++i) {
            if (!uses[i]->used()) continue;
            const std::string reader = element + " has a texture of its " + inputs[i];
            set("textures", reader);
            set("texture-coordinates", reader);
            if (uses[i]->uv_set > 0) set("second-texture-coordinates", reader);
            if (is_wide(scene.images[scene.textures[uses[i]->texture].image]))
                set("wide-texels", reader + ", of 16 bits");
        }
        if (material.normal_texture.used()) {
            set("normals", element + " has a normal texture");
            set("tangents", element + " has a normal texture");
        }
        if (material.alpha_mode == AlphaMode::mask) set("alpha", element + " cuts off by alpha");
        if (material.alpha_mode == AlphaMode::blend) set("alpha", element + " blends by alpha");
        if (!material.unlit && material.metallic > 0.0f) set("specular", element + " is metallic");
        if (!material.unlit && material.specular > 0.0f) set("specular", element + " reflects");
        if (emits(material)) set("emission", element + " emits light");
    }

    void set(const char* word, const std::string& because) {
        if (!has(word)) reasons_.push_back({word, because});
    }

    bool has(const char* word) const { return std::any_of(reasons_.begin(), reasons_.end(), is(word)); }

    ShadingRequirements requirements() const {
        ShadingRequirements needs;
        needs.transforms = has("transforms");
        needs.materials = has("materials");
        needs.normals = has("normals");
        needs.tangents = has("tangents");
        needs.uv_sets = has("second-texture-coordinates") ? 2 : has("texture-coordinates") ? 1 : 0;
        needs.colors = has("colors");
        needs.textures = has("textures");
        needs.wide_texels = has("wide-texels");
        needs.alpha = has("alpha");
        needs.specular = has("specular");
        needs.emission = has("emission");
        needs.punctual = has("punctual-lights");
        return needs;
    }

    std::vector<Reason> in_order() const {
        std::vector<Reason> result;
        for (const std::string& word : words(requirements()))
            result.push_back(*std::find_if(reasons_.begin(), reasons_.end(), is(word)));
        return result;
    }

private:
    std::vector<Reason> reasons_;
};

Needs needs_of(const Scene& scene) {
    Needs needs;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].transform != glm::mat4(1.0f))
            needs.set("transforms", element("instances", i, scene.instances[i].name) + " is placed by a transform");
    const std::vector<bool> materials = materials_in_use(scene);
    std::string first;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (!materials[i]) continue;
        const bool plain = i == scene.materials.size();
        const Material material = plain ? plain_material() : scene.materials[i];
        const std::string name = plain ? "the plain material" : element("materials", i, material.name);
        if (!first.empty()) needs.set("materials", first + " and " + name + " are in use");
        first = first.empty() ? name : first;
        needs.add(scene, material, name);
    }
    const std::vector<bool> meshes = meshes_in_use(scene);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        if (!meshes[i]) continue;
        if (!mesh.normals.empty()) needs.set("normals", element("meshes", i, mesh.name) + " has normals");
        if (!mesh.colors.empty()) needs.set("colors", element("meshes", i, mesh.name) + " has colours");
    }
    if (!scene.lights.empty()) needs.set("punctual-lights", element("lights", 0, scene.lights[0].name) + " is one");
    return needs;
}

} // namespace

std::uint32_t ShadingRequirements::attribute_floats() const {
    return (normals ? 3u : 0u) + (tangents ? 4u : 0u) + 2u * uv_sets + (colors ? 4u : 0u);
}

ShadingRequirements shading_requirements(const Scene& scene) { return needs_of(scene).requirements(); }

std::vector<Reason> shading_reasons(const Scene& scene) { return needs_of(scene).in_order(); }

std::vector<std::string> words(const ShadingRequirements& needs) {
    std::vector<std::string> result;
    const auto add = [&result](bool needed, const char* word) {
        if (needed) result.emplace_back(word);
    };
    add(needs.transforms, "transforms");
    add(needs.materials, "materials");
    add(needs.normals, "normals");
    add(needs.tangents, "tangents");
    add(needs.uv_sets > 0, "texture-coordinates");
    add(needs.uv_sets > 1, "second-texture-coordinates");
    add(needs.colors, "colors");
    add(needs.textures, "textures");
    add(needs.wide_texels, "wide-texels");
    add(needs.alpha, "alpha");
    add(needs.specular, "specular");
    add(needs.emission, "emission");
    add(needs.punctual, "punctual-lights");
    return result;
}

} // namespace boxwood
