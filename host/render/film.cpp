// SPDX-License-Identifier: MIT
#include "render/film.hpp"

#include <algorithm>
#include <limits>

#include "boxwood/error.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

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

Buffer<float> make_film(Device& device, FilmParts parts, std::size_t pixels) {
    Buffer<float> film = make_buffer<float>(device, pixels * parts.floats(), "film");
    fill(device, film.view(), 0.0f);
    return film;
}

void add_sample(Device& device, FilmParts parts, const FilmSample& sample, BufferView<float> film) {
    const Slices slices = cut(device, sample.count);
    launch(device,
           {"render/film.cl", "film_add", {{"LIGHTS", std::to_string(parts.lights)}, {"AO", parts.ao ? "1" : "0"}}},
           "film add", slices.slices, sample.lights[0], sample.lights[1], sample.lights[2], sample.ao,
           sample.first_pixel, sample.count, slices.length, film);
}

std::vector<std::vector<float>> film_means(FilmParts parts, const std::vector<float>& film) {
    const std::uint32_t sums = parts.sums();
    std::vector<std::vector<float>> planes(sums, std::vector<float>(film.size() / parts.floats()));
    for (std::size_t i = 0; i < planes[0].size(); ++i) {
        const float* pixel = &film[i * parts.floats()];
        const double count = std::max(1.0, double{pixel[2 * sums + 2]});
        for (std::uint32_t k = 0; k < sums; ++k)
            planes[k][i] = static_cast<float>((double{pixel[k]} - double{pixel[sums + k]}) / count);
    }
    return planes;
}

std::vector<float> film_variance(FilmParts parts, const std::vector<float>& film) {
    std::vector<float> plane(film.size() / parts.floats());
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const float* moments = &film[i * parts.floats() + 2 * parts.sums()];
        const double count = moments[2];
        plane[i] = count < 2.0 ? std::numeric_limits<float>::infinity()
                               : static_cast<float>(double{moments[1]} / (count - 1.0) / count);
    }
    return plane;
}

std::vector<std::uint32_t> film_samples(FilmParts parts, const std::vector<float>& film) {
    std::vector<std::uint32_t> plane(film.size() / parts.floats());
    for (std::size_t i = 0; i < plane.size(); ++i)
        plane[i] = static_cast<std::uint32_t>(film[i * parts.floats() + 2 * parts.sums() + 2]);
    return plane;
}

void check_film(const Device& device, const RenderOptions& options) {
    const std::uint64_t pixels = std::uint64_t{options.width} * options.height;
    const std::uint64_t floats = pixels * film_parts(options.light.integrator).floats();
    constexpr std::uint64_t most_pixels = std::numeric_limits<std::int32_t>::max();
    if (pixels > most_pixels) throw CapacityError("pixels of a picture", pixels, most_pixels);
    const std::uint64_t most = std::min({device.info().largest_buffer_bytes, device.info().global_bytes,
                                         sizeof(float) * most_pixels}); // elements are counted in 31 bits
    if (floats * sizeof(float) > most)
        throw CapacityError("device memory for the film of " + std::to_string(options.width) + " x " +
                                std::to_string(options.height) + " pixels, in bytes",
                            floats * sizeof(float), most);
}

} // namespace boxwood
