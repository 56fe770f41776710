// SPDX-License-Identifier: MIT
// Section "looks" of a .bxw file. In order (bxw_codec.hpp), an input of a material being u32 texture, u32 uv_set and
// the 9 x f32 of its transform (columns):
//
//     materials: text name, 4 x f32 base_color, f32 metallic, roughness, specular, 3 x f32 emission, f32 normal_scale,
//                occlusion_strength, u32 alpha_mode, f32 alpha_cutoff, u32 double_sided, u32 unlit, 5 inputs
//     textures:  u32 image, wrap_u, wrap_v, nearest
//     lights:    text name, u32 kind, 3 x f32 intensity, position, direction, f32 range, inner_cone, outer_cone
//     images:    text name, u64 bytes in section "images"
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood::detail::bxw {

std::string encode_materials(const Scene& scene);

/// Puts materials, textures, lights and images into `scene`, the images without their bytes, and gives the length of
/// each. Throws InputError naming `file` unless `bytes` is exactly one such section. Allocates no more than a small
/// multiple of bytes.size().
std::vector<std::uint64_t> decode_materials(std::span<const char> bytes, const std::string& file, Scene& scene);

} // namespace boxwood::detail::bxw
