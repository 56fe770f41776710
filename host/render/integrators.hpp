// SPDX-License-Identifier: MIT
// One sample of a batch of pixels, by each integrator.
#pragma once

#include "boxwood/raster.hpp"
#include "boxwood/render.hpp"
#include "render/ambient.hpp"
#include "render/film.hpp"
#include "render/path.hpp"
#include "shared/camera.h"

namespace boxwood {

/// What samples are made of. Referenced, not owned.
struct Scenery {
    World world;
    const AmbientLight& ambient;  ///< Read for Integrator::ambient.
    const Rasteriser* rasteriser; ///< Of Primary::raster, else null.
};

/// Consecutive pixels of a picture and the camera of one sample.
struct PixelBatch {
    BufferView<const CameraRecord> camera;
    std::uint32_t first_pixel = 0;
    std::uint32_t count = 0;
};

/// Memory for one sample of a batch.
struct SampleBuffers {
    Buffer<Ray> rays;
    Buffer<Hit> hits;
    std::array<Buffer<float>, 3> lights;
    Buffer<float> ao;
};

SampleBuffers make_sample_buffers(Device& device, FilmParts parts, std::uint32_t pixels);

/// Sample number `sample` of some pixels; the views are of `buffers`.
FilmSample take_sample(Device& device, const Scenery& scenery, const RenderOptions& options, std::uint32_t sample,
                       const PixelBatch& pixels, SampleBuffers& buffers);

} // namespace boxwood
