// SPDX-License-Identifier: MIT
#include <algorithm>

#include "boxwood/requirements.hpp"
#include "scene/materials_in_use.hpp"
#include "shared/material.h"

namespace boxwood {

namespace {

void add_material(const Material& material, ShadingRequirements& needs) {
    for (const TextureUse* use : texture_uses(material)) {
        if (!use->used()) continue;
        needs.textures = true;
        needs.uv_sets = std::max(needs.uv_sets, use->uv_set + 1);
    }
    needs.tangents |= material.normal_texture.used();
    needs.alpha |= material.alpha_mode != AlphaMode::opaque;
    needs.specular |= !material.unlit && (material.metallic > 0.0f || material.specular > 0.0f);
    needs.emission |= emits(material);
}

} // namespace

std::uint32_t ShadingRequirements::attribute_floats() const {
    return (normals ? 3u : 0u) + (tangents ? 4u : 0u) + 2u * uv_sets + (colors ? 4u : 0u);
}

ShadingRequirements shading_requirements(const Scene& scene) {
    ShadingRequirements needs;
    const std::vector<bool> materials = materials_in_use(scene);
    needs.materials = std::count(materials.begin(), materials.end(), true) > 1;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (materials[i]) add_material(i < scene.materials.size() ? scene.materials[i] : plain_material(), needs);
    const std::vector<bool> meshes = meshes_in_use(scene);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (!meshes[i]) continue;
        needs.normals |= !scene.meshes[i].normals.empty();
        needs.colors |= !scene.meshes[i].colors.empty();
    }
    needs.normals |= needs.tangents;
    needs.punctual = !scene.lights.empty();
    return needs;
}

} // namespace boxwood
