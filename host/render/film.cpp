// SPDX-License-Identifier: MIT
#include "render/film.hpp"

#include <algorithm>
#include <limits>

#include "boxwood/error.hpp"
#include "render/aovs.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

/// The first float of a pixel; the others follow at distances of 8.
const float* first_float(FilmParts parts, const std::vector<float>& film, std::size_t pixel) {
    return &film[pixel / 8 * 8 * parts.floats() + pixel % 8];
}

/// Of a picture with these AOVs, beside R, G and B.
std::uint64_t channels(const std::vector<Aov>& aovs) {
    std::uint64_t count = 0;
    for (const Aov aov : without_repetition(aovs)) count += channel_count(aov);
    return count;
}

} // namespace

FilmParts film_parts(Integrator integrator) {
    switch (integrator) {
    case Integrator::path:
    case Integrator::direct:
        return {2, false};
    case Integrator::ambient:
        return {3, true};
    case Integrator::ao:
        return {1, true};
    case Integrator::normals:
    case Integrator::cost:
        break;
    }
    return {1, false};
}

std::uint64_t film_size(FilmParts parts, std::uint64_t pixels) { return (pixels + 7) / 8 * 8 * parts.floats(); }

Buffer<float> make_film(Device& device, FilmParts parts, std::size_t pixels) {
    Buffer<float> film = make_buffer<float>(device, film_size(parts, pixels), "film");
    fill(device, film.view(), 0.0f);
    return film;
}

void add_sample(Device& device, FilmParts parts, const FilmSample& sample, BufferView<float> film) {
    if (sample.count == 0) return;
    const std::uint32_t lanes = device.tuning().lanes > 1 ? 8 : 1;
    const Slices slices = cut(device, std::size_t{sample.count} + sample.first_pixel % lanes, lanes);
    const Defines defines{
        {"LIGHTS", std::to_string(parts.lights)}, {"AO", parts.ao ? "1" : "0"}, {"LANES", std::to_string(lanes)}};
    launch(device, {"render/film.cl", "film_add", defines}, "film add", slices.slices, sample.lights[0],
           sample.lights[1], sample.lights[2], sample.ao, sample.first_pixel, sample.count, slices.length, film);
}

std::vector<std::vector<float>> film_means(FilmParts parts, std::size_t pixels, const std::vector<float>& film) {
    const std::uint32_t sums = parts.sums();
    std::vector<std::vector<float>> planes(sums, std::vector<float>(pixels));
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* pixel = first_float(parts, film, i);
        const double count = std::max(1.0, double{pixel[8 * (2 * sums + 2)]});
        for (std::uint32_t k = 0; k < sums; ++k)
            planes[k][i] = static_cast<float>((double{pixel[8 * k]} - double{pixel[8 * (sums + k)]}) / count);
    }
    return planes;
}

std::vector<float> film_variance(FilmParts parts, std::size_t pixels, const std::vector<float>& film) {
    std::vector<float> plane(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* moments = first_float(parts, film, i) + 8 * 2 * parts.sums();
        const double count = moments[16];
        plane[i] = count < 2.0 ? std::numeric_limits<float>::infinity()
                               : static_cast<float>(double{moments[8]} / (count - 1.0) / count);
    }
    return plane;
}

std::vector<std::uint32_t> film_samples(FilmParts parts, std::size_t pixels, const std::vector<float>& film) {
    std::vector<std::uint32_t> plane(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        plane[i] = static_cast<std::uint32_t>(first_float(parts, film, i)[8 * (2 * parts.sums() + 2)]);
    return plane;
}

void check_film(const DeviceInfo& device, const RenderOptions& options) {
    const FilmParts parts = film_parts(options.light.integrator);
    const std::uint64_t pixels = std::uint64_t{options.width} * options.height;
    constexpr std::uint64_t most_pixels = std::numeric_limits<std::int32_t>::max();
    if (pixels > most_pixels) throw CapacityError("pixels of a picture", pixels, most_pixels);
    const std::string picture = std::to_string(options.width) + " x " + std::to_string(options.height) + " pixels";
    const std::uint64_t film = sizeof(float) * film_size(parts, pixels);
    const std::uint64_t most = std::min({device.largest_buffer_bytes, device.global_bytes,
                                         sizeof(float) * most_pixels}); // elements are counted in 31 bits
    if (film > most) throw CapacityError("device memory for the film of " + picture + ", in bytes", film, most);
    if (!device.cpu) return;
    // A copy of the film, and the means and the picture, or what is written of it.
    const std::uint64_t planes = sizeof(float) * pixels * (parts.sums() + 3 + channels(options.aovs));
    const std::uint64_t all = film + std::max(film + planes, 2 * film);
    if (all > device.global_bytes)
        throw CapacityError("memory for film and picture of " + picture + ", in bytes", all, device.global_bytes);
}

void check_film(const Device& device, const RenderOptions& options) { check_film(device.info(), options); }

} // namespace boxwood
