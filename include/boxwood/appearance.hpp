// SPDX-License-Identifier: MIT
// What shading reads of a scene, on a device.
#pragma once

#include "boxwood/buffer.hpp"
#include "boxwood/shading_requirements.hpp"
#include "shared/light.h"
#include "shared/material.h"

namespace boxwood {

/// Attributes, materials, textures and lights of a scene. What the requirements do not name is an empty buffer, and
/// programs made for them do not read it.
struct Appearance {
    ShadingRequirements requirements;
    /// Interleaved, requirements.attribute_floats() per vertex in the order of Geometry::positions (dissertation
    /// 3.7.1): normal (3), tangent (4), texture coordinates (2 and 2), colour (4), each where it is required.
    Buffer<float> attributes;
    Buffer<std::uint32_t> triangle_materials; ///< Per triangle of the Geometry, an index into `materials`.
    Buffer<MaterialRecord> materials;         ///< Those of the scene, then the plain one.
    Buffer<TextureRecord> textures;           ///< One for each (texture, sRGB or not) that some material reads.
    Buffer<std::uint32_t> texels;             ///< Words: one a texel, two where its picture has 16 bits.
    /// Punctual ones in scene order, then the triangles that emit, by instance and primitive.
    Buffer<LightRecord> lights;
    /// Empty without lights, else the tree over them: lights - 1 nodes of two children, the root first, then a leaf for
    /// each light.
    Buffer<LightNode> light_nodes;
};

/// Decodes and uploads what `requirements` names of a valid scene (see validate). Lights are chosen
/// for the place that they may light, through a tree (Conty Estevez and Kulla 2018): by intensity, of a triangle
/// emission (of a texture its mean) times area and cosine, over the square of the distance; by irradiance of a
/// directional one. Triangles that give off nothing, or have no area, are no lights. A picture that cannot be decoded,
/// or would pass 2^28 words, is one grey texel (of a normal texture: none), and a warning is added to `warnings`.
/// Throws InputError for more than two sets of texture coordinates, CapacityError, before anything is uploaded, when it
/// does not fit. O(size of the scene).
Appearance upload_appearance(Device& device, const Scene& scene, const ShadingRequirements& requirements,
                             std::vector<std::string>& warnings);

} // namespace boxwood
