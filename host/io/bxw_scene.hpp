// SPDX-License-Identifier: MIT
// Section "scene" of a .bxw file: everything of a Scene but the big arrays. In order, a list being a 64-bit count and
// then its elements, a text being a list of bytes:
//
//     import counts: 3 x u64
//     meshes:    text name, u64 vertices, u64 triangles
//     instances: text name, u32 mesh, 16 x f32 transform (columns)
//     cameras:   text name, 16 x f32 to_world, u32 perspective (0 or 1), f32 vertical_fov, f32 half_height
//     warnings:  text
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood::bxw {

/// Lengths of a mesh's arrays, as the file states them.
struct MeshSize {
    std::uint64_t vertices;
    std::uint64_t triangles;
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

} // namespace boxwood::bxw
