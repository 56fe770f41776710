// SPDX-License-Identifier: MIT
#include "render/raster_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/camera.hpp"

namespace boxwood::test {

namespace {

glm::dvec3 dvec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

double largest(const glm::dvec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

struct Corner {
    glm::dvec3 world;
    double magnitude; ///< The largest that meets in it.
};

Corner corner_of(const Scene& scene, const Hit& hit, int i) {
    const Instance& instance = scene.instances[hit.instance];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dvec3 p(mesh.positions[mesh.triangles[hit.primitive][i]]);
    const glm::dmat4 m(instance.transform);
    glm::dmat3 sizes(m);
    for (int c = 0; c < 3; ++c) sizes[c] = glm::abs(sizes[c]);
    return {glm::dvec3(m * glm::dvec4(p, 1.0)), largest(sizes * glm::abs(p) + glm::abs(glm::dvec3(m[3])))};
}

struct Distance {
    double pixels = std::numeric_limits<double>::infinity();
    double rounding = 0.0; ///< What roundings may amount to there, in pixels.
};

/// From the ray to the nearest line of the triangle's edges, in pixels at the depth where they are closest.
Distance to_nearest_edge(const Scene& scene, const Camera& camera, std::uint32_t height, const Ray& ray,
                         const Hit& hit) {
    Distance nearest;
    if (hit.primitive == BOXWOOD_NONE) return nearest;
    const glm::dvec3 origin = dvec(ray.origin), direction = glm::normalize(dvec(ray.direction));
    const double pixel =
        camera.perspective ? 2.0 * std::tan(0.5 * camera.vertical_fov) / height : 2.0 * camera.half_height / height;
    for (int i = 0; i < 3; ++i) {
        const Corner a = corner_of(scene, hit, i), b = corner_of(scene, hit, (i + 1) % 3);
        const glm::dvec3 p = a.world - origin, q = b.world - origin;
        const glm::dvec3 across = glm::cross(direction, q - p);
        if (glm::length(across) == 0.0) continue;
        const double away = std::fabs(glm::dot(direction, glm::cross(p, q))) / glm::length(across);
        const double size = camera.perspective ? pixel * std::fabs(double(hit.t)) : pixel;
        // Ray and corners are rounded to float, transformed, subtracted and multiplied: tens of roundings.
        const double rounding = 64 * 0x1p-24 * (std::max(a.magnitude, b.magnitude) + largest(origin) + hit.t) / size;
        if (away / size < nearest.pixels) nearest = {away / size, rounding};
    }
    return nearest;
}

bool same_place(const Scene& scene, const Hit& a, const Hit& b) {
    return std::fabs(a.t - b.t) <= 0x1p-15f * std::fabs(a.t) && std::fabs(a.u - b.u) <= 0x1p-6f &&
           std::fabs(a.v - b.v) <= 0x1p-6f && scene.instances.size() > a.instance;
}

} // namespace

BothHits both_hits(Device& device, const Scene& scene, const BuildOptions& options, const Camera& camera,
                   std::uint32_t width, std::uint32_t height, glm::vec2 jitter) {
    const std::size_t pixels = std::size_t{width} * height;
    const Tree tree = build(device, scene, options);
    const Geometry geometry = upload(device, scene);
    const Rasteriser rasteriser(device, scene, tree, geometry);
    const Buffer<CameraRecord> record = upload_camera(device, camera, width, height, jitter);
    const Buffer<Ray> rays = make_buffer<Ray>(device, pixels, "rays");
    const Buffer<Hit> traced = make_buffer<Hit>(device, pixels, "hits"),
                      drawn = make_buffer<Hit>(device, pixels, "hits");
    primary_rays(device, record, 0, rays);
    closest_hit(device, tree, rays, traced);
    rasteriser.draw(record, width, height, 0, rays, drawn);
    return {download(device, rays), download(device, traced), download(device, drawn)};
}

Agreement agreement(const Scene& scene, const Camera& camera, std::uint32_t height, const BothHits& both) {
    Agreement result;
    result.pixels = both.rays.size();
    for (std::size_t i = 0; i < both.rays.size(); ++i) {
        const Hit& a = both.traced[i];
        const Hit& b = both.drawn[i];
        if (a.primitive != BOXWOOD_NONE) ++result.hits;
        if (a.primitive == b.primitive && a.instance == b.instance) {
            if (a.primitive != BOXWOOD_NONE && !same_place(scene, a, b)) ++result.wrong;
            continue;
        }
        ++result.different;
        const Distance first = to_nearest_edge(scene, camera, height, both.rays[i], a);
        const Distance second = to_nearest_edge(scene, camera, height, both.rays[i], b);
        const Distance& nearest = first.pixels < second.pixels ? first : second;
        if (nearest.pixels > nearest.rounding) ++result.off_edge;
        result.farthest = std::max(result.farthest, nearest.pixels);
    }
    return result;
}

} // namespace boxwood::test
