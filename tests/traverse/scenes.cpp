// SPDX-License-Identifier: MIT
#include "traverse/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

namespace boxwood::test {

namespace {

glm::vec3 random_point(Random& random, float reach) {
    const float x = random.uniform(-reach, reach);
    const float y = random.uniform(-reach, reach);
    return {x, y, random.uniform(-reach, reach)};
}

} // namespace

Mesh random_mesh(Random& random, std::uint32_t triangles, float size) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const glm::vec3 centre = random_point(random, 1.0f - size);
        for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(centre + random_point(random, size));
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return mesh;
}

Scene single(Mesh mesh) {
    Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"only", 0, glm::mat4(1.0f)});
    return scene;
}

Scene instanced_scene(Random& random, std::uint32_t meshes, std::uint32_t instances, std::uint32_t triangles) {
    Scene scene;
    for (std::uint32_t i = 0; i < meshes; ++i) scene.meshes.push_back(random_mesh(random, triangles + i, 0.3f));
    for (std::uint32_t i = 0; i < instances; ++i) {
        glm::mat4 transform(1.0f);
        for (int column = 0; column < 3; ++column) {
            transform[column] = glm::vec4(random_point(random, 0.4f), 0.0f);
            transform[column][column] += i % 2 == 0 ? 1.0f : -0.7f;
        }
        transform[3] = glm::vec4(random_point(random, 2.0f), 1.0f);
        if (i == 0) transform = glm::mat4(1.0f);
        scene.instances.push_back({"instance " + std::to_string(i), random.below(meshes), transform});
    }
    return scene;
}

std::vector<Ray> random_rays(Random& random, std::uint32_t count, float reach) {
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 origin = random_point(random, 2.0f * reach);
        glm::vec3 direction = random_point(random, reach) - origin;
        if (i % 8 == 0) direction[(i / 8) % 3] = 0.0f;
        if (i % 16 == 0) direction[(i / 16 + 1) % 3] = 0.0f;
        Ray ray{{origin.x, origin.y, origin.z},
                0.0f,
                {direction.x, direction.y, direction.z},
                std::numeric_limits<float>::infinity()};
        if (i % 4 == 1) {
            ray.t_min = random.uniform(0.0f, 1.0f);
            ray.t_max = ray.t_min + random.uniform(0.0f, 1.0f);
        }
        rays.push_back(ray);
    }
    return rays;
}

std::vector<Hit> trace(const TreeImage& image, const std::vector<Ray>& rays, const TraceOptions& options) {
    Device& device = test_device();
    const Tree tree = upload(device, image);
    const Buffer<Ray> source = upload(device, rays, "test rays");
    const Guarded<Hit> hits(device, rays.size());
    closest_hit(device, tree, source, hits.view(), options);
    CHECK(hits.intact());
    return hits.values();
}

std::vector<Hit> trace(const TreeImage& image, const std::vector<Ray>& rays, std::vector<RayStatistics>& statistics,
                       const TraceOptions& options) {
    Device& device = test_device();
    const Tree tree = upload(device, image);
    const Buffer<Ray> source = upload(device, rays, "test rays");
    const Guarded<Hit> hits(device, rays.size());
    const Guarded<RayStatistics> counts(device, rays.size());
    closest_hit(device, tree, source, hits.view(), counts.view(), options);
    CHECK(hits.intact());
    CHECK(counts.intact());
    statistics = counts.values();
    return hits.values();
}

std::vector<std::uint32_t> trace_any(const TreeImage& image, const std::vector<Ray>& rays,
                                     const TraceOptions& options) {
    Device& device = test_device();
    const Tree tree = upload(device, image);
    const Buffer<Ray> source = upload(device, rays, "test rays");
    const Guarded<std::uint32_t> hits(device, rays.size());
    any_hit(device, tree, source, hits.view(), options);
    CHECK(hits.intact());
    return hits.values();
}

std::size_t count_different(const std::vector<Hit>& a, const std::vector<Hit>& b) {
    std::size_t different = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (!(a[i].t == b[i].t && a[i].u == b[i].u && a[i].v == b[i].v && a[i].primitive == b[i].primitive &&
              a[i].instance == b[i].instance))
            ++different;
    return different;
}

std::string words(const Kind& kind) {
    return std::string(kind.layout == Layout::wide8 ? "wide8" : "binary") +
           (kind.levels == Levels::two ? ", two levels, " : ", one level, ") + std::string(name(kind.bounds));
}

} // namespace boxwood::test
