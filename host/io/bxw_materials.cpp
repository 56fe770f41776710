// SPDX-License-Identifier: MIT
#include "io/bxw_materials.hpp"

#include "io/bxw_codec.hpp"
#include "scene/materials_in_use.hpp"

namespace boxwood::detail::bxw {

namespace {

// Least bytes of an element, all texts empty.
constexpr std::size_t input_bytes = 2 * sizeof(std::uint32_t) + sizeof(glm::mat3);
constexpr std::size_t material_bytes = text_bytes + 13 * sizeof(float) + 3 * sizeof(std::uint32_t) + 5 * input_bytes;
constexpr std::size_t texture_bytes = 4 * sizeof(std::uint32_t);
constexpr std::size_t light_bytes = text_bytes + sizeof(std::uint32_t) + 12 * sizeof(float);
constexpr std::size_t image_bytes = text_bytes + sizeof(std::uint64_t);

void put_word(Encoder& out, auto value) { out.put(static_cast<std::uint32_t>(value)); }

void encode_material(Encoder& out, const Material& material) {
    out.put_text(material.name);
    out.put(material.base_color);
    out.put(material.metallic);
    out.put(material.roughness);
    out.put(material.specular);
    out.put(material.emission);
    out.put(material.normal_scale);
    out.put(material.occlusion_strength);
    put_word(out, material.alpha_mode);
    out.put(material.alpha_cutoff);
    put_word(out, material.double_sided);
    put_word(out, material.unlit);
    for (const TextureUse* use : texture_uses(material)) {
        out.put(use->texture);
        out.put(use->uv_set);
        out.put(use->transform);
    }
}

Material decode_material(Decoder& in) {
    Material material;
    material.name = in.get_text();
    material.base_color = in.get<glm::vec4>();
    material.metallic = in.get<float>();
    material.roughness = in.get<float>();
    material.specular = in.get<float>();
    material.emission = in.get<glm::vec3>();
    material.normal_scale = in.get<float>();
    material.occlusion_strength = in.get<float>();
    material.alpha_mode = static_cast<AlphaMode>(in.get_word(3, "has an unknown alpha mode"));
    material.alpha_cutoff = in.get<float>();
    material.double_sided = in.get_word(2, "has a material with sides neither one nor two") == 1;
    material.unlit = in.get_word(2, "has a material neither lit nor unlit") == 1;
    for (TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture,
                            &material.normal_texture, &material.occlusion_texture, &material.emission_texture}) {
        use->texture = in.get<std::uint32_t>();
        use->uv_set = in.get<std::uint32_t>();
        use->transform = in.get<glm::mat3>();
    }
    return material;
}

Texture decode_texture(Decoder& in) {
    Texture texture;
    texture.image = in.get<std::uint32_t>();
    texture.wrap_u = static_cast<Wrap>(in.get_word(3, "has an unknown way to continue a texture"));
    texture.wrap_v = static_cast<Wrap>(in.get_word(3, "has an unknown way to continue a texture"));
    texture.nearest = in.get_word(2, "has an unknown filter of a texture") == 1;
    return texture;
}

void encode_light(Encoder& out, const Light& light) {
    out.put_text(light.name);
    put_word(out, light.kind);
    out.put(light.intensity);
    out.put(light.position);
    out.put(light.direction);
    out.put(light.range);
    out.put(light.inner_cone);
    out.put(light.outer_cone);
}

Light decode_light(Decoder& in) {
    Light light;
    light.name = in.get_text();
    light.kind = static_cast<LightKind>(in.get_word(3, "has an unknown kind of light"));
    light.intensity = in.get<glm::vec3>();
    light.position = in.get<glm::vec3>();
    light.direction = in.get<glm::vec3>();
    light.range = in.get<float>();
    light.inner_cone = in.get<float>();
    light.outer_cone = in.get<float>();
    return light;
}

} // namespace

std::string encode_materials(const Scene& scene) {
    Encoder out;
    out.put_count(scene.materials.size());
    for (const Material& material : scene.materials) encode_material(out, material);
    out.put_count(scene.textures.size());
    for (const Texture& texture : scene.textures) {
        out.put(texture.image);
        put_word(out, texture.wrap_u);
        put_word(out, texture.wrap_v);
        put_word(out, texture.nearest);
    }
    out.put_count(scene.lights.size());
    for (const Light& light : scene.lights) encode_light(out, light);
    out.put_count(scene.images.size());
    for (const EncodedImage& image : scene.images) {
        out.put_text(image.name);
        out.put_count(image.bytes.size());
    }
    return out.take();
}

std::vector<std::uint64_t> decode_materials(std::span<const char> bytes, const std::string& file, Scene& scene) {
    Decoder in(bytes, "section looks", file);
    scene.materials.resize(in.get_count(material_bytes));
    for (Material& material : scene.materials) material = decode_material(in);
    scene.textures.resize(in.get_count(texture_bytes));
    for (Texture& texture : scene.textures) texture = decode_texture(in);
    scene.lights.resize(in.get_count(light_bytes));
    for (Light& light : scene.lights) light = decode_light(in);
    scene.images.resize(in.get_count(image_bytes));
    std::vector<std::uint64_t> sizes;
    for (EncodedImage& image : scene.images) {
        image.name = in.get_text();
        sizes.push_back(in.get<std::uint64_t>());
    }
    in.finish();
    return sizes;
}

} // namespace boxwood::detail::bxw
