// SPDX-License-Identifier: MIT
#include "render/scene_arrays.hpp"

namespace boxwood {

std::string flag(bool needed) { return needed ? "1" : "0"; }

Defines scene_defines(const Device& device, const Geometry& geometry, const ShadingRequirements& requirements,
                      TextureFilter filter) {
    Defines defines{
        {"TRANSFORMS", flag(geometry.transforms)},         {"MATERIALS", flag(requirements.materials)},
        {"NORMALS", flag(requirements.normals)},           {"TANGENTS", flag(requirements.tangents)},
        {"UV_SETS", std::to_string(requirements.uv_sets)}, {"COLORS", flag(requirements.colors)},
        {"TEXTURES", flag(requirements.textures)},         {"LANES", std::to_string(device.tuning().lanes)}};
    // TextureFilter counts down from the best one.
    if (requirements.textures) {
        defines["FILTER"] = std::to_string(2 - static_cast<int>(filter));
        defines["WIDE_TEXELS"] = flag(requirements.wide_texels);
    }
    return defines;
}

SampleSettings sample_settings(const LightOptions& options, std::uint32_t sample, std::uint32_t first_pixel) {
    return {options.seed, sample, options.samples, options.depth, first_pixel};
}

} // namespace boxwood
