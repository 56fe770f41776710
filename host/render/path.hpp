// SPDX-License-Identifier: MIT
// Path tracing as stages over queues of rays (dissertation 3.7.3): shade, trace, compact.
#pragma once

#include "boxwood/appearance.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/render_options.hpp"
#include "boxwood/tree.hpp"
#include "render/environment.hpp"
#include "shared/camera.h"

namespace boxwood {

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

/// Sample number `sample` (of options.samples) of the pixels of `primary`: one path each, its own camera ray given.
/// What it is depends on (options, camera, pixel, sample) alone. Of `options`, integrator and primary are not read.
/// Surfaces with alpha, any number of them, cost no bounce; of those at the very same distance, the first by instance
/// and triangle stands for all. Stages in the profile: shade, shadow, compact, trace. Throws InputError for arrays of
/// different sizes, and CapacityError, before any work, for 2^30 pixels or more or when the queues do not fit.
void trace_paths(Device& device, const World& world, const LightOptions& options, std::uint32_t sample,
                 const PrimaryHits& primary, SampleLight light);

} // namespace boxwood
