// SPDX-License-Identifier: MIT
#include "cli/rays.hpp"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

#include "boxwood/rays.hpp"
#include "scene/random.hpp"

namespace boxwood::cli {

namespace {

Buffer<Ray> without_null_rays(Device& device, const Buffer<Ray>& rays) {
    std::vector<Ray> kept = download(device, rays);
    std::erase_if(kept, [](const Ray& ray) {
        const float sum = std::abs(ray.direction[0]) + std::abs(ray.direction[1]) + std::abs(ray.direction[2]);
        return !(sum > 0.0f); // also where a triangle without area has no normal
    });
    return upload(device, kept, "rays");
}

/// Hits in the middles of random triangles as seen in the scene, from random sides.
void random_hits(const Scene& scene, std::uint64_t seed, std::vector<Ray>& rays, std::vector<Hit>& hits) {
    std::vector<std::uint64_t> ends; // of the instances' triangles
    for (const Instance& instance : scene.instances)
        ends.push_back((ends.empty() ? 0 : ends.back()) + scene.meshes[instance.mesh].triangles.size());
    if (ends.empty() || ends.back() == 0) {
        rays.clear();
        hits.clear();
        return;
    }
    Random random(seed);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::uint64_t chosen = random.below(ends.back());
        const auto instance = static_cast<std::size_t>(std::ranges::upper_bound(ends, chosen) - ends.begin());
        const std::uint64_t first = instance == 0 ? 0 : ends[instance - 1];
        const glm::dvec3 direction = random_point(random, 2.0) - 1.0;
        const auto third = 1.0f / 3.0f;
        rays[i] = {{}, 0.0f, {float(direction.x), float(direction.y), float(direction.z)}, INFINITY};
        hits[i] = {0.0f, third, third, static_cast<std::uint32_t>(chosen - first),
                   static_cast<std::uint32_t>(instance)};
    }
}

Buffer<Ray> near_rays(Device& device, const Scene& scene, const RayChoice& choice) {
    const std::size_t count = std::size_t{choice.resolution.width} * choice.resolution.height;
    std::vector<Ray> rays(count);
    std::vector<Hit> hits(count);
    random_hits(scene, choice.seed, rays, hits);
    Buffer<Ray> out = make_buffer<Ray>(device, rays.size(), "near rays");
    diffuse_rays(device, upload(device, scene), upload(device, rays, "rays"), upload(device, hits, "hits"), choice.seed,
                 out);
    return without_null_rays(device, out);
}

} // namespace

void add_ray_options(CLI::App& command, RayChoice& choice) {
    add_view(command, choice.view);
    add_resolution(command, choice.resolution);
    command.add_option("--seed", choice.seed, "Seed of diffuse and near rays (default: 1)")
        ->check(CLI::NonNegativeNumber);
}

Buffer<Ray> make_rays(Device& device, const Input& input, const Tree& tree, const RayChoice& choice) {
    const Stage stage(device, "rays");
    if (choice.kind == "near") return near_rays(device, input.scene, choice);
    const Resolution& size = choice.resolution;
    Buffer<Ray> primary = make_buffer<Ray>(device, std::size_t{size.width} * size.height, "rays");
    primary_rays(device, choose_camera(input, choice.view, size), size.width, size.height, primary);
    if (choice.kind == "primary") return primary;

    const Geometry geometry = upload(device, input.scene);
    Buffer<Hit> hits = make_buffer<Hit>(device, primary.size(), "hits");
    Buffer<Ray> secondary = make_buffer<Ray>(device, primary.size(), "secondary rays");
    closest_hit(device, tree, primary, hits);
    if (choice.kind == "diffuse")
        diffuse_rays(device, geometry, primary, hits, choice.seed, secondary);
    else
        shadow_rays(device, geometry, primary, hits, default_light(input.scene), secondary);
    return without_null_rays(device, secondary);
}

void add_intersector(CLI::App& command, TraceOptions& options) {
    command
        .add_option_function<std::string>(
            "--intersector", [&options](const std::string& word) { options.intersector = to_intersector(word); },
            "Ray against triangle: watertight (default), or moeller-trumbore, by which rays pass at shared edges and "
            "answers may depend on the tree")
        ->check(CLI::IsMember({"watertight", "moeller-trumbore"}))
        ->type_name("NAME");
}

RayWork count_work(Device& device, const Tree& tree, const Buffer<Ray>& rays, const TraceOptions& options) {
    if (rays.size() == 0) return {};
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "hits");
    Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, rays.size(), "ray statistics");
    closest_hit(device, tree, rays, hits, statistics, options);
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
