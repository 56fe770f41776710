// SPDX-License-Identifier: MIT
// Path tracing as stages over queues of rays (dissertation 3.7.3): shade, trace, compact.
#pragma once

#include "boxwood/appearance.hpp"
#include "boxwood/environment.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/render_options.hpp"
#include "boxwood/scene.hpp"
#include "boxwood/tree.hpp"
#include "shared/camera.h"

namespace boxwood {

/// An environment on a device; what it is made of is up to environment.cpp.
struct EnvironmentMap;

/// What light travels through. Referenced, not owned; everything is of one scene on one device.
struct World {
    const Tree& tree;
    const Geometry& geometry;
    const Appearance& appearance;
    const EnvironmentMap& environment;
};

/// Light of one sample of some pixels, 3 floats (R, G, B) per pixel, linear, finite, >= 0.
struct SampleLight {
    BufferView<float> direct;   ///< What is emitted towards the camera, and reflected once.
    BufferView<float> indirect; ///< What is reflected more often.
};

/// Where the primary rays of a batch of pixels and their hits come from.
struct PrimaryHits {
    BufferView<const CameraRecord> camera; ///< One; that of the rays.
    BufferView<const Ray> rays;            ///< Normalised directions.
    BufferView<const Hit> hits;
    std::uint32_t first_pixel = 0; ///< Pixel of rays[0]; the others follow, row by row.
};

/// Sample number `sample` (of options.samples) of the pixels of `primary`: one path each, its own camera ray given. What it is
/// depends on (options, camera, pixel, sample) alone. Throws CapacityError, before any work, when the queues do not fit.
void trace_paths(Device& device, const World& world, const LightOptions& options, std::uint32_t sample,
                 const PrimaryHits& primary, SampleLight light);

} // namespace boxwood
