// SPDX-License-Identifier: MIT
// Which materials and meshes a scene shows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood {

/// The inputs of a material that may be textures, by BOXWOOD_BASE_COLOR and its like.
std::array<const TextureUse*, 5> texture_uses(const Material& material);

/// Whether a surface of this material gives off light of its own, before textures. An unlit one shows its colour and
/// nothing else.
bool emits(const Material& material);

/// By mesh: whether some instance shows it. O(instances + meshes).
std::vector<bool> meshes_in_use(const Scene& scene);

/// By material, the plain one behind those of the scene: whether some triangle of a mesh in use has it. O(triangles).
std::vector<bool> materials_in_use(const Scene& scene);

/// Material of a triangle as an index into those of materials_in_use().
std::uint32_t material_of(const Scene& scene, const Mesh& mesh, std::size_t triangle);

} // namespace boxwood
