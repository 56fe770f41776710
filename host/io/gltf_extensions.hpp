// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "io/gltf_warnings.hpp"

namespace boxwood {

inline constexpr const char* draco = "KHR_draco_mesh_compression";
inline constexpr const char* specular_glossiness = "KHR_materials_pbrSpecularGlossiness";

/// Throws InputError naming the first required extension that Boxwood does not support and that may change geometry.
void check_required_extensions(const nlohmann::json& root, const std::string& file);

/// One warning for each extension that the file uses or requires and Boxwood does not read, saying what stands in for
/// it. Comes after check_required_extensions.
void warn_of_extensions(const nlohmann::json& root, Warnings& warnings);

/// The extension that the file uses in which compressed data may stand in for a buffer's, by name; empty for none.
std::string unread_buffer_compression(const nlohmann::json& root);

} // namespace boxwood
