// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood {

/// What shading a scene needs: each member decides about a piece of the programs, and about a buffer or a part of one.
struct ShadingRequirements {
    bool transforms = false;   ///< Some mesh is not placed where its vertices are: object and world space differ.
    bool materials = false;    ///< More than one material is in use: triangles name theirs.
    bool normals = false;      ///< Some mesh in use has vertex normals, or some material a normal texture.
    bool tangents = false;     ///< Some material in use has a normal texture.
    std::uint32_t uv_sets = 0; ///< Sets of texture coordinates that materials in use read, 0 to 2.
    bool colors = false;       ///< Some mesh in use has vertex colours.
    bool textures = false;     ///< Some material in use has a texture.
    bool wide_texels = false;  ///< Some of these textures has 16 bits per channel.
    bool alpha = false;        ///< Some material in use has AlphaMode::mask or blend.
    bool specular = false;     ///< Some material in use reflects: metallic > 0 or specular > 0.
    bool emission = false;     ///< Some material in use emits.
    bool punctual = false;     ///< There are point, spot or directional lights.

    /// Floats per vertex in Appearance::attributes.
    std::uint32_t attribute_floats() const;
};

/// Of the meshes of a valid scene (see validate) that have an instance, and the materials that their triangles name.
/// O(size of the scene).
ShadingRequirements shading_requirements(const Scene& scene);

/// The words for reports: "transforms", "materials", "normals", "tangents", "texture-coordinates",
/// "second-texture-coordinates", "colors", "textures", "wide-texels", "alpha", "specular", "emission",
/// "punctual-lights".
std::vector<std::string> words(const ShadingRequirements& requirements);

/// A word for reports, and why it is there: the first element that asks for it, or the option.
struct Reason {
    std::string word;
    std::string because;
};

} // namespace boxwood
