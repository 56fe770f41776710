// SPDX-License-Identifier: MIT
#include "io/sample_materials.hpp"

#include <algorithm>
#include <span>

namespace boxwood::test {

namespace {

bool same(const TextureUse& a, const TextureUse& b) {
    return a.texture == b.texture && a.uv_set == b.uv_set && a.transform == b.transform;
}

bool same(const Material& a, const Material& b) {
    return a.name == b.name && a.base_color == b.base_color && a.metallic == b.metallic && a.roughness == b.roughness &&
           a.specular == b.specular && a.emission == b.emission && a.normal_scale == b.normal_scale &&
           a.occlusion_strength == b.occlusion_strength && a.alpha_mode == b.alpha_mode &&
           a.alpha_cutoff == b.alpha_cutoff && a.double_sided == b.double_sided && a.unlit == b.unlit &&
           same(a.base_color_texture, b.base_color_texture) &&
           same(a.metallic_roughness_texture, b.metallic_roughness_texture) &&
           same(a.normal_texture, b.normal_texture) && same(a.occlusion_texture, b.occlusion_texture) &&
           same(a.emission_texture, b.emission_texture);
}

bool same(const Texture& a, const Texture& b) {
    return a.image == b.image && a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v && a.nearest == b.nearest;
}

bool same(const Light& a, const Light& b) {
    return a.name == b.name && a.kind == b.kind && a.intensity == b.intensity && a.position == b.position &&
           a.direction == b.direction && a.range == b.range && a.inner_cone == b.inner_cone &&
           a.outer_cone == b.outer_cone;
}

} // namespace

void add_materials(Scene& scene) {
    Mesh& mesh = scene.meshes[1];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto x = static_cast<float>(i);
        mesh.normals.push_back(i == 0 ? glm::vec3(0.0f) : glm::vec3(0, 0, 1));
        mesh.tangents.push_back(i == 0 ? glm::vec4(0.0f) : glm::vec4(1, 0, 0, i % 2 == 0 ? 1 : -1));
        mesh.uvs[0].emplace_back(0.25f * x, -x);
        mesh.uvs[1].emplace_back(x, 1.0f / (1.0f + x));
        mesh.colors.emplace_back(1.0f / (1.0f + x), 0.5f, 0.25f, 0.75f);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.materials.push_back(i < 3 ? BOXWOOD_NONE : i < 20 ? 1u : 0u);
    Material material;
    material.name = "everything";
    material.base_color = {0.1f, 0.2f, 0.3f, 0.4f};
    material.metallic = 0.25f;
    material.roughness = 0.75f;
    material.specular = 0.5f;
    material.emission = {0.1f, 2.3f, 40.5f};
    material.normal_scale = -1.5f;
    material.occlusion_strength = 0.3f;
    material.alpha_mode = AlphaMode::mask;
    material.alpha_cutoff = 0.7f;
    material.double_sided = true;
    material.base_color_texture = {0, 1, glm::mat3(2, 0, 0, 0, 0.3f, 0, 0.1f, 0.2f, 1)};
    material.metallic_roughness_texture = {1, 0};
    material.normal_texture = {1, 1};
    material.occlusion_texture = {0, 0};
    material.emission_texture = {2, 0};
    Material glass;
    glass.alpha_mode = AlphaMode::blend;
    glass.unlit = true;
    scene.materials = {material, glass};
    scene.textures = {{0, Wrap::mirror, Wrap::clamp, true}, {1}, {0}};
    // The first bytes of files are all that a scene asks of them.
    const unsigned char png[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 1, 2, 3}, jpeg[] = {0xff, 0xd8, 0xff, 4};
    const auto bytes = [](std::span<const unsigned char> from) {
        const auto as_bytes = std::as_bytes(from);
        return std::vector<std::byte>(as_bytes.begin(), as_bytes.end());
    };
    scene.images = {{"first", bytes(png)}, {"", bytes(jpeg)}};
    Light spot{"spot", LightKind::spot, {0.3f, 200.5f, 0}, {1, 2, 3}, {0.6f, 0, 0.8f}};
    spot.inner_cone = 0.1f;
    spot.outer_cone = 0.6f;
    Light sun{"", LightKind::directional, {0.1f, 0.2f, 0.3f}};
    sun.direction = {0, -1, 0};
    Light point{"point", LightKind::point, {7, 8, 9}, {-1, 0, 1}};
    point.range = 12.5f;
    scene.lights = {spot, sun, point};
}

bool same_materials(const Scene& a, const Scene& b) {
    const auto equal = [](const auto& x, const auto& y) {
        return std::ranges::equal(x, y, [](const auto& p, const auto& q) { return same(p, q); });
    };
    const auto images = [](const EncodedImage& x, const EncodedImage& y) {
        return x.name == y.name && x.bytes == y.bytes;
    };
    return equal(a.materials, b.materials) && equal(a.textures, b.textures) && equal(a.lights, b.lights) &&
           std::ranges::equal(a.images, b.images, images);
}

} // namespace boxwood::test
