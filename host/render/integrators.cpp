// SPDX-License-Identifier: MIT
#include "render/integrators.hpp"

#include <algorithm>

#include "boxwood/gbuffer.hpp"
#include "render/camera.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

std::uint32_t count_of(const PrimaryHits& primary) { return static_cast<std::uint32_t>(primary.hits.size()); }

void find_hits(Device& device, const Scenery& scenery, const RenderOptions& options, const PixelBatch& pixels,
               BufferView<const Ray> rays, BufferView<Hit> hits) {
    if (scenery.rasteriser)
        scenery.rasteriser->draw(pixels.camera, options.width, options.height, pixels.first_pixel, rays, hits);
    else
        closest_hit(device, scenery.world.tree, rays, hits, options.light.trace);
}

void show_normals(Device& device, const World& world, const LightOptions& options, const PrimaryHits& primary,
                  BufferView<float> light) {
    const Slices slices = cut(device, primary.hits.size());
    GBuffer planes;
    planes.shading_normals = light;
    g_buffer(device, world.geometry, world.appearance, primary.camera, primary.rays, primary.hits, options.filter,
             options.samples, planes);
    launch(device, {"render/views.cl", "normal_light"}, "normals", slices.slices, primary.hits, count_of(primary),
           slices.length, light);
}

void show_cost(Device& device, const World& world, const LightOptions& options, const PrimaryHits& primary,
               BufferView<Hit> hits, BufferView<float> light) {
    const Slices slices = cut(device, primary.hits.size());
    auto statistics = make_scratch<RayStatistics>(device, count_of(primary), "ray statistics");
    closest_hit(device, world.tree, primary.rays, hits, statistics, options.trace);
    launch(device, {"render/views.cl", "cost_light"}, "cost", slices.slices, statistics, count_of(primary),
           slices.length, light);
}

} // namespace

SampleBuffers make_sample_buffers(Device& device, FilmParts parts, std::uint32_t pixels) {
    SampleBuffers buffers{make_scratch<Ray>(device, pixels, "rays"), make_scratch<Hit>(device, pixels, "hits"), {}, {}};
    for (std::uint32_t k = 0; k < parts.lights; ++k)
        buffers.lights[k] = make_scratch<float>(device, std::size_t{3} * pixels, "light of a sample");
    if (parts.ao) buffers.ao = make_scratch<float>(device, pixels, "occlusion of a sample");
    return buffers;
}

FilmSample take_sample(Device& device, const Scenery& scenery, const RenderOptions& options, std::uint32_t sample,
                       const PixelBatch& pixels, SampleBuffers& buffers) {
    const World& world = scenery.world;
    const BufferView<Ray> rays = buffers.rays.prefix(pixels.count);
    const BufferView<Hit> hits = buffers.hits.prefix(pixels.count);
    const PrimaryHits primary{pixels.camera, rays, hits, pixels.first_pixel};
    const auto light = [&](std::size_t part) { return buffers.lights[part].prefix(std::size_t{3} * pixels.count); };
    LightOptions chosen = options.light;
    primary_rays(device, pixels.camera, pixels.first_pixel, rays);
    if (chosen.integrator != Integrator::cost) find_hits(device, scenery, options, pixels, rays, hits);
    switch (chosen.integrator) {
    case Integrator::direct:
        chosen.depth = std::min(chosen.depth, 1u);
        [[fallthrough]];
    case Integrator::path:
        trace_paths(device, world, chosen, sample, primary, {light(0), light(1)});
        break;
    case Integrator::normals:
        show_normals(device, world, chosen, primary, light(0));
        break;
    case Integrator::cost:
        show_cost(device, world, chosen, primary, hits, light(0));
        break;
    case Integrator::ambient:
        trace_ambient(device, world, scenery.ambient, chosen, options.ao_distance, sample, primary,
                      {light(0), light(1), light(2), buffers.ao.prefix(pixels.count)});
        break;
    case Integrator::ao:
        trace_occlusion(device, world, chosen, options.ao_distance, sample, primary, light(0),
                        buffers.ao.prefix(pixels.count));
        break;
    }
    return {{buffers.lights[0], buffers.lights[1], buffers.lights[2]}, buffers.ao, pixels.first_pixel, pixels.count};
}

} // namespace boxwood
