// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "io/gltf_document.hpp"

namespace boxwood {

/// An accessor without a buffer view is all zeros (but for its sparse values) and takes no room in the file, so that a
/// few bytes could ask for all the memory there is. This many elements are the most it may have, and all that a scene
/// reads the most they may have together.
inline constexpr std::size_t largest_implicit_count = std::size_t{1} << 20;
inline constexpr std::size_t largest_implicit_total = std::size_t{1} << 24;

/// Elements of accessors[index] as floats, sparse values applied. Normalised integers become [-1, 1] or [0, 1] (glTF
/// 2.0 section 3.11), other integers their own value. `where` names the user of the accessor, for messages. Throws
/// InputError when the accessor is missing, of another type, or reaches outside its buffer view or buffer. O(count).
std::vector<glm::vec2> read_vec2(const GltfDocument& document, int index, const std::string& where);
std::vector<glm::vec3> read_vec3(const GltfDocument& document, int index, const std::string& where);
std::vector<glm::vec4> read_vec4(const GltfDocument& document, int index, const std::string& where);

std::vector<glm::mat4> read_mat4(const GltfDocument& document, int index, const std::string& where);

/// Colours of three or four components; of three the last is 1. Throws like read_vec3.
std::vector<glm::vec4> read_colors(const GltfDocument& document, int index, const std::string& where);

/// The bytes of a buffer view. Throws InputError when there is no such view, or when it reaches outside its buffer.
std::span<const std::byte> view_bytes(const GltfDocument& document, int view, const std::string& where);

/// Elements of an index accessor: scalars of unsigned 8, 16 or 32 bits. Throws like read_vec3, also for an index that
/// equals the largest value of its type, which glTF forbids because some devices restart a primitive there. Warns of a
/// byteStride, which glTF allows vertices alone.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index, const std::string& where,
                                        Warnings& warnings);

/// Whether accessors[index] has any data in the file: a buffer view or sparse values. Throws InputError when there is
/// no such accessor.
bool has_data(const GltfDocument& document, int index, const std::string& where);

/// Number of elements of accessors[index]. Throws InputError when there is no such accessor.
std::size_t element_count(const GltfDocument& document, int index, const std::string& where);

} // namespace boxwood
