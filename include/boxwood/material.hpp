// SPDX-License-Identifier: MIT
// What surfaces are made of and what lights a scene, as glTF 2.0 has them (sections 3.8, 3.9 and the extensions
// KHR_materials_emissive_strength, KHR_materials_specular, KHR_materials_unlit, KHR_texture_transform,
// KHR_lights_punctual).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "shared/types.h"

namespace boxwood {

/// Largest emission and intensity of one colour: sums and products of a few of them stay inside float.
inline constexpr float largest_radiance = 1152921504606846976.0f; // 2^60

/// Smallest Light::outer_cone.
inline constexpr float smallest_cone = std::numeric_limits<float>::min();

/// A picture as its file holds it; it is decoded when a program reads it.
struct EncodedImage {
    std::string name;             ///< Of the element or file that it came from, for messages.
    std::vector<std::byte> bytes; ///< A whole PNG or JPEG file.
};

/// What lies beyond the edge of a picture.
enum class Wrap { repeat, mirror, clamp };

/// A picture and how it continues.
struct Texture {
    std::uint32_t image = 0; ///< Index into Scene::images.
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool nearest = false; ///< Blocks of one colour where it is magnified, instead of bilinear filtering.
};

/// A texture as one input of a material reads it.
struct TextureUse {
    std::uint32_t texture = BOXWOOD_NONE; ///< Index into Scene::textures; BOXWOOD_NONE: the factor alone counts.
    std::uint32_t uv_set = 0;             ///< 0 or 1.
    glm::mat3 transform{1.0f};            ///< uv' = (transform * (u, v, 1)).xy; like positions in range.

    bool used() const { return texture != BOXWOOD_NONE; }
};

/// How alpha is read: not at all, cut off, or as the share of light that the surface stops.
enum class AlphaMode { opaque, mask, blend };

/// A metallic-roughness material; factors multiply their textures. Colours are linear. Every number is finite and in
/// its range. The defaults are glTF's.
struct Material {
    std::string name;
    glm::vec4 base_color{1.0f}; ///< [0, 1]; the last is alpha.
    float metallic = 1.0f;      ///< [0, 1]
    float roughness = 1.0f;     ///< [0, 1], perceptual: alpha of GGX is its square.
    float specular = 1.0f;      ///< [0, 1]: strength of a dielectric's reflection; 0 is pure Lambert.
    /// Radiance, factor times strength, within [0, largest_radiance]: of the front, of both sides when double_sided.
    glm::vec3 emission{0.0f};
    float normal_scale = 1.0f;       ///< Of the x and y of the normal texture; within largest_coordinate.
    float occlusion_strength = 1.0f; ///< [0, 1]; read by the G-buffer and the ambient integrator only.
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f; ///< >= 0; AlphaMode::mask only.
    bool double_sided = false; ///< Both sides are always shaded; this decides about emission.
    bool unlit = false;        ///< Shows base_color as radiance and scatters nothing.
    TextureUse base_color_texture, metallic_roughness_texture, normal_texture, occlusion_texture, emission_texture;
};

/// What triangles without a material are made of: matt, of a light grey (glTF's own default, white metal, shows no
/// shape).
Material plain_material();

enum class LightKind { point, spot, directional };

/// A light without extent, in world space. Members that its kind does not use are in their range, too.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    /// Colour times intensity, within [0, largest_radiance] and not all zero: per steradian (point, spot) or irradiance
    /// (directional).
    glm::vec3 intensity{1.0f};
    glm::vec3 position{0.0f};                             ///< Point, spot.
    glm::vec3 direction{0.0f, 0.0f, -1.0f};               ///< Where the light goes, normalised. Spot, directional.
    float range = std::numeric_limits<float>::infinity(); ///< > 0; nothing beyond it is lit. Point, spot.
    float inner_cone = 0.0f;         ///< Radians, >= 0 and < outer_cone: full intensity inside. Spot.
    float outer_cone = 0.785398163f; ///< Radians, <= pi / 2: none outside. Spot.
};

} // namespace boxwood
