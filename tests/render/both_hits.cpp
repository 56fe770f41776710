// SPDX-License-Identifier: MIT
#include "render/both_hits.hpp"

#include <cstring>

#include "render/camera.hpp"

namespace boxwood::test {

std::size_t BothHits::hits() const {
    std::size_t count = 0;
    for (const Hit& hit : traced) count += hit.primitive != BOXWOOD_NONE;
    return count;
}

std::size_t BothHits::different() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < traced.size(); ++i) count += std::memcmp(&traced[i], &drawn[i], sizeof(Hit)) != 0;
    return count;
}

std::vector<BuildOptions> tree_options() {
    std::vector<BuildOptions> all;
    for (const Levels levels : {Levels::one, Levels::two})
        for (const Layout layout : {Layout::wide8, Layout::binary}) {
            BuildOptions options;
            options.levels = levels;
            options.layout = layout;
            all.push_back(options);
        }
    return all;
}

BothHits both_hits(Device& device, const Scene& scene, const BuildOptions& options, const Camera& camera,
                   std::uint32_t width, std::uint32_t height, glm::vec2 jitter) {
    const std::size_t pixels = std::size_t{width} * height;
    const Tree tree = build(device, scene, options);
    const Geometry geometry = upload(device, scene);
    const Rasteriser rasteriser(device, scene, tree, geometry);
    const Buffer<CameraRecord> record = upload_camera(device, camera, width, height, jitter);
    Buffer<Ray> rays = make_buffer<Ray>(device, pixels, "rays");
    Buffer<Hit> traced = make_buffer<Hit>(device, pixels, "hits"), drawn = make_buffer<Hit>(device, pixels, "hits");
    primary_rays(device, record, 0, rays);
    closest_hit(device, tree, rays, traced);
    rasteriser.draw(record, width, height, 0, rays, drawn);
    return {download(device, rays), download(device, traced), download(device, drawn)};
}

} // namespace boxwood::test
