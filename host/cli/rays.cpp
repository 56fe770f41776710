// SPDX-License-Identifier: MIT
#include "cli/rays.hpp"

#include "boxwood/rays.hpp"

namespace boxwood::cli {

namespace {

Buffer<Ray> without_null_rays(Device& device, const Buffer<Ray>& rays) {
    std::vector<Ray> kept = download(device, rays);
    std::erase_if(kept, [](const Ray& ray) {
        return ray.direction[0] == 0.0f && ray.direction[1] == 0.0f && ray.direction[2] == 0.0f;
    });
    return upload(device, kept, "rays");
}

} // namespace

void add_ray_options(CLI::App& command, RayChoice& choice) {
    add_view(command, choice.view);
    add_resolution(command, choice.resolution);
    command.add_option("--seed", choice.seed, "Seed of diffuse rays (default: 1)")->check(CLI::NonNegativeNumber);
}

Buffer<Ray> make_rays(Device& device, const Input& input, const Tree& tree, const RayChoice& choice) {
    const Stage stage(device, "rays");
    const Resolution& size = choice.resolution;
    Buffer<Ray> primary = make_buffer<Ray>(device, std::size_t{size.width} * size.height, "rays");
    primary_rays(device, choose_camera(input, choice.view), size.width, size.height, primary);
    if (choice.kind == "primary") return primary;

    const Geometry geometry = upload(device, input.scene);
    const Buffer<Hit> hits = make_buffer<Hit>(device, primary.size(), "hits");
    const Buffer<Ray> secondary = make_buffer<Ray>(device, primary.size(), "secondary rays");
    closest_hit(device, tree, primary, hits);
    if (choice.kind == "diffuse")
        diffuse_rays(device, geometry, primary, hits, choice.seed, secondary);
    else
        shadow_rays(device, geometry, primary, hits, default_light(input.scene), secondary);
    return without_null_rays(device, secondary);
}

RayWork count_work(Device& device, const Tree& tree, const Buffer<Ray>& rays) {
    if (rays.size() == 0) return {};
    const Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "hits");
    const Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, rays.size(), "ray statistics");
    closest_hit(device, tree, rays, hits, statistics);
    RayWork work;
    std::uint64_t volumes = 0, primitives = 0;
    for (const RayStatistics& each : download(device, statistics)) {
        volumes += each.volumes;
        primitives += each.primitives;
        work.affine_rays += each.areas != 0;
        work.answered_locally += each.areas == 2;
    }
    const auto count = static_cast<double>(rays.size());
    work.volumes_per_ray = static_cast<double>(volumes) / count;
    work.primitives_per_ray = static_cast<double>(primitives) / count;
    return work;
}

double mrays_per_s(std::size_t rays, double ms) { return ms > 0.0 ? static_cast<double>(rays) / ms * 1e-3 : 0.0; }

} // namespace boxwood::cli
