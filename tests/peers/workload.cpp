// SPDX-License-Identifier: MIT
#include "workload.hpp"

#include "boxwood/geometry.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"

namespace boxwood::peers {

Scene load_flat(const std::string& name) {
    for (const ProceduralKind& kind : procedural_kinds())
        if (kind.name == name) return flatten(make_procedural(name));
    return flatten(load_gltf(name));
}

std::vector<Batch> make_batches(Device& device, const Scene& flat, const Tree& tree) {
    constexpr std::uint32_t side = 1024;
    constexpr std::uint64_t seed = 1;
    const Camera camera = flat.cameras.empty() ? default_camera(flat) : flat.cameras.front();
    const Geometry geometry = upload(device, flat);
    Buffer<Ray> primary = make_buffer<Ray>(device, side * side, "primary rays");
    Buffer<Ray> secondary = make_buffer<Ray>(device, side * side, "secondary rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, side * side, "primary hits");
    primary_rays(device, camera, side, side, primary);
    closest_hit(device, tree, primary, hits);

    const auto present = [&](const Buffer<Ray>& source) {
        std::vector<Ray> rays = download(device, source);
        std::erase_if(rays, [](const Ray& ray) {
            return ray.direction[0] == 0.0f && ray.direction[1] == 0.0f && ray.direction[2] == 0.0f;
        });
        return rays;
    };
    std::vector<Batch> batches{{"primary", present(primary)}};
    diffuse_rays(device, geometry, primary, hits, seed, secondary);
    batches.push_back({"bounce", present(secondary)});
    shadow_rays(device, geometry, primary, hits, default_light(flat), secondary);
    batches.push_back({"shadow", present(secondary)});
    return batches;
}

} // namespace boxwood::peers
