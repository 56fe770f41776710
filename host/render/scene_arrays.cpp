// SPDX-License-Identifier: MIT
#include "render/scene_arrays.hpp"

namespace boxwood {

Defines scene_defines(const ShadingRequirements& requirements) {
    const auto flag = [](bool needed) { return std::string(needed ? "1" : "0"); };
    return {{"MATERIALS", flag(requirements.materials)}, {"NORMALS", flag(requirements.normals)},
            {"TANGENTS", flag(requirements.tangents)},   {"UV_SETS", std::to_string(requirements.uv_sets)},
            {"COLORS", flag(requirements.colors)},       {"TEXTURES", flag(requirements.textures)}};
}

} // namespace boxwood
