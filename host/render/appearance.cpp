// SPDX-License-Identifier: MIT
#include "boxwood/appearance.hpp"

#include <algorithm>

#include "render/appearance_attributes.hpp"
#include "render/appearance_lights.hpp"
#include "runtime/capacity.hpp"
#include "scene/materials_in_use.hpp"

namespace boxwood {

namespace {

MaterialRecord material_record(const Material& material) {
    MaterialRecord record{};
    for (int i = 0; i < 4; ++i) record.base_color[i] = material.base_color[i];
    for (int i = 0; i < 3; ++i) record.emission[i] = emits(material) ? material.emission[i] : 0.0f;
    record.metallic = material.metallic;
    record.roughness = material.roughness;
    record.normal_scale = material.normal_scale;
    record.occlusion_strength = material.occlusion_strength;
    record.alpha_cutoff = material.alpha_cutoff;
    record.specular = material.specular;
    record.flags = (material.alpha_mode == AlphaMode::mask ? BOXWOOD_ALPHA_MASK : 0u) |
                   (material.alpha_mode == AlphaMode::blend ? BOXWOOD_ALPHA_BLEND : 0u) |
                   (material.double_sided ? BOXWOOD_DOUBLE_SIDED : 0u) | (material.unlit ? BOXWOOD_UNLIT : 0u);
    for (TextureInput& input : record.textures) input.texture = BOXWOOD_NONE;
    return record;
}

/// All materials, the plain one last.
std::vector<Material> all_materials(const Scene& scene) {
    std::vector<Material> materials = scene.materials;
    materials.push_back(plain_material());
    return materials;
}

std::vector<std::uint32_t> triangle_materials(const Scene& scene) {
    std::vector<std::uint32_t> materials;
    materials.reserve(scene.triangle_count());
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) materials.push_back(material_of(scene, mesh, i));
    return materials;
}

} // namespace

Appearance upload_appearance(Device& device, const Scene& scene, const ShadingRequirements& needs,
                             std::vector<std::string>& /*warnings*/) {
    const std::vector<Material> materials = all_materials(scene);
    const BufferNeed buffers[] = {
        {"vertex attributes", scene.vertex_count() * needs.attribute_floats(), sizeof(float)},
        {"materials of triangles", needs.materials ? scene.triangle_count() : 0, sizeof(std::uint32_t)},
        {"materials", materials.size(), sizeof(MaterialRecord)},
        {"lights", light_limit(scene, needs), sizeof(LightRecord) + sizeof(float)}};
    check_fits(device, buffers, "what shading reads");

    std::vector<glm::dvec3> emission;
    std::vector<MaterialRecord> records;
    for (const Material& material : materials) {
        records.push_back(material_record(material));
        emission.push_back(emits(material) ? glm::dvec3(material.emission) : glm::dvec3(0.0));
    }
    if (!needs.materials) {
        const std::vector<bool> used = materials_in_use(scene);
        const auto first = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
        records = {records[std::min(first, records.size() - 1)]};
    }

    Appearance appearance;
    appearance.requirements = needs;
    const auto upload_some = [&device](const auto& values, const char* label, auto& target) {
        if (!values.empty()) target = upload(device, values, label);
    };
    upload_some(vertex_attributes(scene, needs), "vertex attributes", appearance.attributes);
    if (needs.materials)
        upload_some(triangle_materials(scene), "materials of triangles", appearance.triangle_materials);
    upload_some(records, "materials", appearance.materials);
    const LightList lights = light_list(scene, needs, emission);
    upload_some(lights.records, "lights", appearance.lights);
    upload_some(lights.distribution, "light distribution", appearance.light_distribution);
    return appearance;
}

} // namespace boxwood
