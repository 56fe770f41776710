// SPDX-License-Identifier: MIT
// What shading kernels share: macros and arguments (cl/render/scene_arrays.h).
#pragma once

#include <string>

#include "boxwood/appearance.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/render_options.hpp"
#include "runtime/launch.hpp"
#include "shared/sample.h"

namespace boxwood {

/// The value of a macro that says whether something is needed.
std::string flag(bool needed);

/// The macros of cl/render/scene_arrays.h and cl/runtime/real.h, and with textures that of cl/render/texture.h.
Defines scene_defines(const Device& device, const Geometry& geometry, const ShadingRequirements& requirements,
                      TextureFilter filter);

/// Sample number `sample` of a picture, of the pixels from `first_pixel` on.
SampleSettings sample_settings(const LightOptions& options, std::uint32_t sample, std::uint32_t first_pixel);

/// Launches a kernel whose first parameters are SCENE_PARAMETERS, the others `arguments`.
template <class... Arguments>
void launch_shading(Device& device, const KernelRef& kernel, const char* label, std::size_t work_items,
                    const Geometry& geometry, const Appearance& appearance, Arguments&&... arguments) {
    launch(device, kernel, label, work_items, geometry.positions, geometry.triangles, geometry.meshes,
           geometry.instances, appearance.attributes, appearance.triangle_materials, appearance.materials,
           appearance.textures, appearance.texels, arguments...);
}

} // namespace boxwood
