// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/appearance.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/render_options.hpp"
#include "shared/camera.h"
#include "shared/ray.h"

namespace boxwood {

/// What primary rays met, one value or three floats per pixel. An empty view is a plane that is not asked for: it is
/// neither computed nor compiled. Misses are zero, of the depth infinity, of indices BOXWOOD_NONE. No float is NaN.
struct GBuffer {
    BufferView<float> positions;         ///< 3: world space.
    BufferView<float> geometric_normals; ///< 3: world space, unit length, towards the ray's origin.
    BufferView<float> shading_normals;   ///< 3: of vertices and normal texture, likewise.
    BufferView<float> albedos;           ///< 3: base colour, linear, [0, 1].
    BufferView<float> depths;            ///< 1: distance along the ray.
    /// 4: what is added to the first set of texture coordinates from the pixel to the next one on the right, then to
    /// the one above, du, dv, du, dv, over the root of `samples`. Zero without any.
    BufferView<float> uv_derivatives;
    BufferView<std::uint32_t> materials;  ///< 1: index into Appearance::materials.
    BufferView<std::uint32_t> instances;  ///< 1: index into Scene::instances.
    BufferView<std::uint32_t> primitives; ///< 1: index of the triangle within the mesh of the instance.
};

/// Primary hits turned into planes (dissertation 2.6, 3.7.6), in one launch. `camera` holds one record, `rays` are its
/// rays in some pixels and `hits` what they met in the scene of `geometry` and `appearance`; textures are filtered over
/// a pixel, or over its share when it has several samples. Every plane has hits.size() pixels or is empty; no hits are
/// nothing to do. Throws InputError when sizes differ, when `appearance` is of other triangles, or for no samples.
/// O(pixels).
void g_buffer(Device& device, const Geometry& geometry, const Appearance& appearance,
              BufferView<const CameraRecord> camera, BufferView<const Ray> rays, BufferView<const Hit> hits,
              TextureFilter filter, std::uint32_t samples, const GBuffer& planes);

} // namespace boxwood
