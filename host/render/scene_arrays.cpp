// SPDX-License-Identifier: MIT
#include "render/scene_arrays.hpp"

namespace boxwood {

Defines scene_defines(const ShadingRequirements& requirements, TextureFilter filter) {
    const auto flag = [](bool needed) { return std::string(needed ? "1" : "0"); };
    Defines defines{{"MATERIALS", flag(requirements.materials)}, {"NORMALS", flag(requirements.normals)},
                    {"TANGENTS", flag(requirements.tangents)},   {"UV_SETS", std::to_string(requirements.uv_sets)},
                    {"COLORS", flag(requirements.colors)},       {"TEXTURES", flag(requirements.textures)}};
    // TextureFilter counts down from the best one.
    if (requirements.textures) defines["FILTER"] = std::to_string(2 - static_cast<int>(filter));
    return defines;
}

} // namespace boxwood
