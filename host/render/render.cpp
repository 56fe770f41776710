// SPDX-License-Identifier: MIT
#include "boxwood/render.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

constexpr std::array<std::string_view, 5> aov_names = {"depth", "normal", "instance", "primitive", "cost"};

/// What the kernels of film.cl read.
struct Film {
    Device& device;
    const Geometry& geometry;
    BufferView<const Ray> rays;
    BufferView<const Hit> hits;
    Slices slices;

    std::uint32_t pixels() const { return static_cast<std::uint32_t>(hits.size()); }
    KernelRef kernel(const char* name) const { return {"render/film.cl", name}; }
};

/// Three planes made of the surfaces, one channel each.
void add_surface_planes(const Film& film, const char* kernel, const char* label,
                        const std::array<const char*, 3>& names, Image& image) {
    const Buffer<float> planes = make_scratch<float>(film.device, 3 * film.hits.size(), "film planes");
    const Geometry& geometry = film.geometry;
    launch(film.device, film.kernel(kernel), label, film.slices.slices, geometry.positions, geometry.triangles,
           geometry.meshes, geometry.instances, film.rays, film.hits, film.pixels(), film.slices.length, planes);
    const std::vector<float> values = download<float>(film.device, planes);
    const auto pixels = static_cast<std::ptrdiff_t>(film.hits.size());
    for (int c = 0; c < 3; ++c)
        image.channels.push_back(
            {names[c], std::vector<float>(values.begin() + c * pixels, values.begin() + (c + 1) * pixels)});
}

/// One plane made of the hits.
template <class T>
void add_hit_plane(const Film& film, const char* kernel, const char* label, const char* name, Image& image) {
    const Buffer<T> plane = make_scratch<T>(film.device, film.hits.size(), "film plane");
    launch(film.device, film.kernel(kernel), label, film.slices.slices, film.hits, film.pixels(), film.slices.length,
           plane);
    image.channels.push_back({name, download<T>(film.device, plane)});
}

void add_costs(const Film& film, BufferView<const RayStatistics> statistics, Image& image) {
    const auto volumes = make_scratch<std::uint32_t>(film.device, film.hits.size(), "film plane");
    const auto primitives = make_scratch<std::uint32_t>(film.device, film.hits.size(), "film plane");
    launch(film.device, film.kernel("film_costs"), "film costs", film.slices.slices, statistics, film.pixels(),
           film.slices.length, volumes, primitives);
    image.channels.push_back({"cost.volumes", download<std::uint32_t>(film.device, volumes)});
    image.channels.push_back({"cost.primitives", download<std::uint32_t>(film.device, primitives)});
}

void add_aov(const Film& film, Aov aov, BufferView<const RayStatistics> statistics, Image& image) {
    switch (aov) {
    case Aov::depth:
        return add_hit_plane<float>(film, "film_depth", "film depth", "depth.Z", image);
    case Aov::normal:
        return add_surface_planes(film, "film_normals", "film normals", {"normal.X", "normal.Y", "normal.Z"}, image);
    case Aov::instance:
        return add_hit_plane<std::uint32_t>(film, "film_instances", "film instances", "instance.id", image);
    case Aov::primitive:
        return add_hit_plane<std::uint32_t>(film, "film_primitives", "film primitives", "primitive.id", image);
    case Aov::cost:
        return add_costs(film, statistics, image);
    }
}

/// Each AOV once, in the order of the enumeration.
std::vector<Aov> without_repetition(std::vector<Aov> aovs) {
    std::sort(aovs.begin(), aovs.end());
    aovs.erase(std::unique(aovs.begin(), aovs.end()), aovs.end());
    return aovs;
}

} // namespace

std::string_view name(Aov aov) { return aov_names.at(static_cast<std::size_t>(aov)); }

std::vector<Aov> all_aovs() { return {Aov::depth, Aov::normal, Aov::instance, Aov::primitive, Aov::cost}; }

Aov to_aov(std::string_view word) {
    std::string known;
    for (const Aov aov : all_aovs()) {
        if (name(aov) == word) return aov;
        known += (known.empty() ? "" : ", ") + std::string(name(aov));
    }
    throw InputError("aov", std::string(word), "unknown; there are " + known);
}

Image render(Device& device, const Tree& tree, const Geometry& geometry, const Camera& camera,
             const RenderOptions& options) {
    const Stage stage(device, "render");
    const std::vector<Aov> aovs = without_repetition(options.aovs);
    const std::size_t pixels = std::size_t{options.width} * options.height;
    if (pixels == 0) throw InputError("render", "resolution", "width and height must be at least 1");

    const Buffer<Ray> rays = make_scratch<Ray>(device, pixels, "rays");
    const Buffer<Hit> hits = make_scratch<Hit>(device, pixels, "hits");
    Buffer<RayStatistics> statistics;
    primary_rays(device, camera, options.width, options.height, rays);
    if (std::find(aovs.begin(), aovs.end(), Aov::cost) != aovs.end()) {
        statistics = make_scratch<RayStatistics>(device, pixels, "ray statistics");
        closest_hit(device, tree, rays, hits, statistics, options.trace);
    } else {
        closest_hit(device, tree, rays, hits, options.trace);
    }

    Image image{options.width, options.height, {}};
    const Film film{device, geometry, rays, hits, cut(device, pixels)};
    add_surface_planes(film, "film_shading", "film shading", {"R", "G", "B"}, image);
    for (const Aov aov : aovs) add_aov(film, aov, statistics, image);
    return image;
}

} // namespace boxwood
