// SPDX-License-Identifier: MIT
// Numbers of glTF JSON whose types are checked already, brought into their range.
#pragma once

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "io/gltf_mesh.hpp"

namespace boxwood {

/// The object under `key`, or an empty one.
inline const nlohmann::json& object_at(const nlohmann::json& owner, const char* key) {
    static const nlohmann::json empty = nlohmann::json::object();
    const auto found = owner.find(key);
    return found == owner.end() ? empty : *found;
}

struct Range {
    float low;
    float high;
};

/// `value` in float and within `range`; a warning when it was not.
inline float within(double value, Range range, const std::string& where, Warnings& warnings) {
    if (value >= double{range.low} && value <= double{range.high}) return static_cast<float>(value);
    const float nearest = value < double{range.low} ? range.low : range.high;
    warnings.add(where, "is out of range; taken as " + nlohmann::json(nearest).dump());
    return nearest;
}

/// The number under `key`, or `otherwise`.
inline float number_at(const nlohmann::json& owner, const char* key, float otherwise, Range range,
                       const std::string& where, Warnings& warnings) {
    const auto found = owner.find(key);
    if (found == owner.end()) return otherwise;
    return within(found->get<double>(), range, where + "." + key, warnings);
}

/// The vector under `key`, or `otherwise`.
template <class Vector>
Vector vector_at(const nlohmann::json& owner, const char* key, Vector otherwise, Range range, const std::string& where,
                 Warnings& warnings) {
    const auto found = owner.find(key);
    if (found == owner.end()) return otherwise;
    for (int i = 0; i < Vector::length(); ++i)
        otherwise[i] = within((*found)[static_cast<std::size_t>(i)].get<double>(), range,
                              element(where + "." + key, static_cast<std::size_t>(i)), warnings);
    return otherwise;
}

} // namespace boxwood
