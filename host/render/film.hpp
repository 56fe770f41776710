// SPDX-License-Identifier: MIT
// Samples added up on the device (cl/render/film.cl), and what the sums mean.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/buffer.hpp"
#include "boxwood/image.hpp"
#include "boxwood/render.hpp"

namespace boxwood {

/// What a film adds up for each pixel.
struct FilmParts {
    std::uint32_t lights = 1; ///< Parts of the light, 1 to 3: direct, indirect, ambient, or the whole.
    bool ao = false;

    std::uint32_t sums() const { return 3 * lights + (ao ? 1 : 0); }
    std::uint32_t floats() const { return 2 * sums() + 3; } ///< Per pixel.
    bool operator==(const FilmParts&) const = default;
};

/// What an integrator gives.
FilmParts film_parts(Integrator integrator);

/// One sample of consecutive pixels: 3 floats per pixel for each part of the light, and 1 of ambient occlusion.
struct FilmSample {
    std::array<BufferView<const float>, 3> lights;
    BufferView<const float> ao;
    std::uint32_t first_pixel = 0;
    std::uint32_t count = 0;
};

/// Floats in the film of a picture: those of its pixels, in whole blocks of 8.
std::uint64_t film_size(FilmParts parts, std::uint64_t pixels);

/// Throws CapacityError when the film of a picture of these options does not fit such a device; for a CPU, whose memory
/// is the host's, with what Render::image() and Render::state() then need beside it.
void check_film(const DeviceInfo& device, const RenderOptions& options);

/// A film without samples. Throws CapacityError.
Buffer<float> make_film(Device& device, FilmParts parts, std::size_t pixels);

/// Adds a sample to its pixels.
void add_sample(Device& device, FilmParts parts, const FilmSample& sample, BufferView<float> film);

/// The means of a film of `pixels` pixels that was downloaded, 0 for a pixel without samples, as planes in the order of
/// the sums.
std::vector<std::vector<float>> film_means(FilmParts parts, std::size_t pixels, const std::vector<float>& film);
/// Variance of the mean of the luminance; infinity for fewer than two samples.
std::vector<float> film_variance(FilmParts parts, std::size_t pixels, const std::vector<float>& film);
/// Samples in each pixel.
std::vector<std::uint32_t> film_samples(FilmParts parts, std::size_t pixels, const std::vector<float>& film);

} // namespace boxwood
