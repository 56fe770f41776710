// SPDX-License-Identifier: MIT
// Section "scene" of a .bxw file: everything of a Scene but the big arrays and the materials. In order (bxw_codec.hpp):
//
//     import counts: 3 x u64
//     meshes:    text name, u64 vertices, u64 triangles, u32 parts (bits of MeshPart)
//     instances: text name, u32 mesh, 16 x f32 transform (columns)
//     cameras:   text name, 16 x f32 to_world, u32 perspective (0 or 1), f32 vertical_fov, f32 half_height
//     warnings:  text
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood::detail::bxw {

/// What a mesh may have beside positions and triangles.
enum MeshPart : std::uint32_t {
    mesh_materials = 1,
    mesh_normals = 2,
    mesh_tangents = 4,
    mesh_uvs_0 = 8,
    mesh_uvs_1 = 16,
    mesh_colors = 32
};

/// Lengths of a mesh's arrays, as the file states them.
struct MeshSize {
    std::uint64_t vertices;
    std::uint64_t triangles;
    std::uint32_t parts; ///< Bits of MeshPart.

    std::uint64_t vertices_with(MeshPart part) const { return (parts & part) != 0 ? vertices : 0; }
    std::uint64_t triangles_with(MeshPart part) const { return (parts & part) != 0 ? triangles : 0; }
};

/// A decoded section: the scene with the arrays of its meshes still empty, and how long they are to be.
struct SceneOutline {
    Scene scene;
    std::vector<MeshSize> sizes; ///< One per mesh.
};

std::string encode_scene(const Scene& scene);

/// Throws InputError naming `file` unless `bytes` is exactly one outline. Allocates no more than a small multiple of
/// bytes.size(), whatever the counts claim.
SceneOutline decode_scene(std::span<const char> bytes, const std::string& file);

} // namespace boxwood::detail::bxw
