// SPDX-License-Identifier: MIT
#include "boxwood/appearance.hpp"

#include <algorithm>

#include "boxwood/error.hpp"
#include "render/appearance_attributes.hpp"
#include "render/appearance_lights.hpp"
#include "render/appearance_textures.hpp"
#include "runtime/capacity.hpp"
#include "scene/materials_in_use.hpp"

namespace boxwood {

namespace {

/// Without `textures` the factors alone.
MaterialRecord material_record(const Material& material, const TextureSet* textures) {
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
    const auto uses = texture_uses(material);
    for (std::size_t place = 0; place < uses.size(); ++place) {
        record.textures[place].texture = BOXWOOD_NONE;
        if (textures != nullptr) record.textures[place] = textures->input(*uses[place], place);
    }
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
                             std::vector<std::string>& warnings) {
    if (needs.uv_sets > 2)
        throw InputError("appearance", "uv_sets", std::to_string(needs.uv_sets) + " is out of range: 0 to 2");
    const std::vector<Material> materials = all_materials(scene);
    std::vector<bool> used = materials_in_use(scene);
    const std::size_t first = std::find(used.begin(), used.end(), true) - used.begin();
    if (!needs.materials) std::fill(used.begin() + std::min(first + 1, used.size()), used.end(), false);
    TextureSet textures(scene, needs.textures ? used : std::vector<bool>(used.size(), false), warnings);
    const BufferNeed buffers[] = {
        {"vertex attributes", scene.vertex_count() * needs.attribute_floats(), sizeof(float)},
        {"materials of triangles", needs.materials ? scene.triangle_count() : 0, sizeof(std::uint32_t)},
        {"materials", materials.size(), sizeof(MaterialRecord)},
        {"textures", textures.records().size(), sizeof(TextureRecord)},
        {"texels", textures.word_count(), sizeof(std::uint32_t)},
        {"lights", light_limit(scene, needs), sizeof(LightRecord) + 2 * sizeof(LightNode)}};
    check_fits(device, buffers, "what shading reads");

    Appearance appearance;
    appearance.requirements = needs;
    if (textures.word_count() > 0) {
        appearance.texels = make_buffer<std::uint32_t>(device, textures.word_count(), "texels");
        textures.decode(device, appearance.texels, warnings);
    }
    std::vector<glm::dvec3> emission;
    std::vector<MaterialRecord> records;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const bool textured = needs.textures && used[i];
        records.push_back(material_record(materials[i], textured ? &textures : nullptr));
        const glm::dvec3 factor(emits(materials[i]) && used[i] ? materials[i].emission : glm::vec3(0.0f));
        emission.push_back(factor * (textured ? textures.mean(materials[i].emission_texture) : glm::dvec3(1.0)));
    }
    if (!needs.materials) records = {records[std::min(first, records.size() - 1)]};

    const auto upload_some = [&device](const auto& values, const char* label, auto& target) {
        if (!values.empty()) target = upload(device, values, label);
    };
    upload_some(vertex_attributes(scene, needs), "vertex attributes", appearance.attributes);
    if (needs.materials)
        upload_some(triangle_materials(scene), "materials of triangles", appearance.triangle_materials);
    upload_some(records, "materials", appearance.materials);
    upload_some(textures.records(), "textures", appearance.textures);
    const LightList lights = light_list(scene, needs, emission);
    upload_some(lights.records, "lights", appearance.lights);
    upload_some(lights.nodes, "light tree", appearance.light_nodes);
    return appearance;
}

} // namespace boxwood
