// SPDX-License-Identifier: MIT
#include "scene/materials_in_use.hpp"

#include <glm/vector_relational.hpp>

namespace boxwood {

std::array<const TextureUse*, 5> texture_uses(const Material& material) {
    return {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
            &material.occlusion_texture, &material.emission_texture};
}

bool emits(const Material& material) {
    return !material.unlit && glm::any(glm::greaterThan(material.emission, glm::vec3(0.0f)));
}

std::vector<bool> meshes_in_use(const Scene& scene) {
    std::vector<bool> used(scene.meshes.size(), false);
    for (const Instance& instance : scene.instances) used[instance.mesh] = true;
    return used;
}

std::uint32_t material_of(const Scene& scene, const Mesh& mesh, std::size_t triangle) {
    const auto plain = static_cast<std::uint32_t>(scene.materials.size());
    const std::uint32_t named = mesh.materials.empty() ? BOXWOOD_NONE : mesh.materials[triangle];
    return named == BOXWOOD_NONE ? plain : named;
}

std::vector<bool> materials_in_use(const Scene& scene) {
    std::vector<bool> used(scene.materials.size() + 1, false);
    const std::vector<bool> shown = meshes_in_use(scene);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (!shown[m]) continue;
        if (mesh.materials.empty()) used.back() = true;
        for (std::size_t i = 0; i < mesh.materials.size(); ++i) used[material_of(scene, mesh, i)] = true;
    }
    return used;
}

} // namespace boxwood
