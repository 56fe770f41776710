// SPDX-License-Identifier: MIT
#include "render/ambient.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "boxwood/trace.hpp"
#include "render/environment.hpp"
#include "render/light_tree.hpp"
#include "render/scene_arrays.hpp"

namespace boxwood {

namespace {

constexpr double pi = std::numbers::pi;

/// The polynomials of the coefficients, and the squares of what makes them orthonormal on the sphere.
std::array<double, 9> basis(const glm::dvec3& n) {
    return {1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y};
}
constexpr std::array<double, 9> squared_norms = {1.0 / (4 * pi),  3.0 / (4 * pi),  3.0 / (4 * pi),
                                                 3.0 / (4 * pi),  15.0 / (4 * pi), 15.0 / (4 * pi),
                                                 5.0 / (16 * pi), 15.0 / (4 * pi), 15.0 / (16 * pi)};
/// What a Lambert surface makes of each degree, over pi.
constexpr std::array<double, 9> lambert = {1.0, 2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25, 0.25, 0.25, 0.25, 0.25};

Defines ambient_defines(const Device& device, const World& world, const LightOptions& options, bool lights,
                        EnvironmentKind environment) {
    Defines defines = scene_defines(device, world.geometry, world.appearance.requirements, options.filter);
    defines["LIGHTS"] = flag(lights);
    defines["ENVIRONMENT"] = std::to_string(static_cast<int>(environment));
    defines["SAMPLER"] = std::to_string(2 - static_cast<int>(options.sampler));
    return defines;
}

/// Memory of the paths of a batch.
struct Paths {
    Buffer<Ray> rays, shadow_rays;
    Buffer<Hit> hits;
    Buffer<std::uint32_t> blocked;
    Buffer<float> throughputs, pending;

    Paths(Device& device, std::size_t count)
        : rays(make_scratch<Ray>(device, count, "rays of paths")),
          shadow_rays(make_scratch<Ray>(device, count, "shadow rays")),
          hits(make_scratch<Hit>(device, count, "hits of paths")),
          blocked(make_scratch<std::uint32_t>(device, count, "blocked shadow rays")),
          throughputs(make_scratch<float>(device, 3 * count, "throughputs")),
          pending(make_scratch<float>(device, 6 * count, "pending light")) {}
};

} // namespace

std::array<glm::dvec3, 9> ambient_coefficients(const Environment& environment) {
    std::array<glm::dvec3, 9> coefficients{};
    if (environment.width == 0 || environment.height == 0) {
        coefficients[0] = glm::dvec3(environment.radiance);
        return coefficients;
    }
    const double row_angle = pi / environment.height, column_angle = 2 * pi / environment.width;
    for (std::uint32_t y = 0; y < environment.height; ++y) {
        const double top = y * row_angle;
        const double solid_angle = column_angle * (std::cos(top) - std::cos(top + row_angle));
        const double down = top + 0.5 * row_angle;
        for (std::uint32_t x = 0; x < environment.width; ++x) {
            // The middle is +x, the right of it +z; a rotation is counter-clockwise as seen from above.
            const double turn = (x + 0.5) * column_angle - pi - double{environment.rotation};
            const auto values =
                basis({std::sin(down) * std::cos(turn), std::cos(down), std::sin(down) * std::sin(turn)});
            const glm::dvec3 light =
                solid_angle * glm::dvec3(environment.pixels[std::size_t{y} * environment.width + x]);
            for (std::size_t k = 0; k < 9; ++k) coefficients[k] += squared_norms[k] * lambert[k] * values[k] * light;
        }
    }
    return coefficients;
}

AmbientLight make_ambient_light(Device& device, const Appearance& appearance, const Environment& environment) {
    AmbientLight light;
    std::vector<float> coefficients;
    for (const glm::dvec3& coefficient : ambient_coefficients(environment))
        for (int c = 0; c < 3; ++c) coefficients.push_back(static_cast<float>(coefficient[c]));
    light.coefficients = upload(device, coefficients, "ambient light");
    if (appearance.lights.size() == 0) return light;
    std::vector<LightBounds> bounds;
    bool bright = false;
    for (const LightRecord& record : download(device, appearance.lights)) {
        if (record.kind == BOXWOOD_TRIANGLE_LIGHT) break; // they come last
        bounds.push_back(punctual_bounds(record));
        bright |= bounds.back().strength > 0.0;
    }
    if (!bright) return light;
    light.punctual = static_cast<std::uint32_t>(bounds.size());
    light.nodes = upload(device, light_tree(bounds), "punctual lights");
    return light;
}

void trace_ambient(Device& device, const World& world, const AmbientLight& around, const LightOptions& options,
                   float distance, std::uint32_t sample, const PrimaryHits& primary, const AmbientSample& light) {
    const auto count = static_cast<std::uint32_t>(primary.rays.size());
    const Slices slices = cut(device, count);
    Paths paths(device, count);
    const Appearance& appearance = world.appearance;
    const EnvironmentMap& map = world.environment;
    const Defines defines = ambient_defines(device, world, options, around.punctual > 0, map.kind);
    // Without a bounce, the first one shows what is seen; what it leaves pending is not gathered.
    for (std::uint32_t bounce = 0; bounce == 0 || bounce < options.depth; ++bounce) {
        {
            const Stage stage(device, "shade");
            const BufferView<const Ray> rays = bounce == 0 ? primary.rays : BufferView<const Ray>(paths.rays);
            const BufferView<const Hit> hits = bounce == 0 ? primary.hits : BufferView<const Hit>(paths.hits);
            launch_shading(device, {"render/ambient.cl", "ambient_bounce", defines}, "ambient bounce", slices.slices,
                           world.geometry, appearance, appearance.lights, around.nodes, around.punctual, map.record,
                           map.texels, map.rows, map.columns, around.coefficients, primary.camera, options.seed, sample,
                           options.samples, primary.first_pixel, bounce, rays, hits, count, slices.length,
                           paths.throughputs, paths.rays, paths.shadow_rays, paths.pending, light.direct,
                           light.indirect, light.ambient);
        }
        if (options.depth == 0) return fill(device, light.ao, 1.0f);
        if (around.punctual > 0) {
            const Stage stage(device, "shadow");
            any_hit(device, world.tree, paths.shadow_rays, paths.blocked, options.trace);
        }
        {
            const Stage stage(device, "trace");
            closest_hit(device, world.tree, paths.rays, paths.hits, options.trace);
        }
        const Stage stage(device, "accumulate");
        launch(device, {"render/ambient.cl", "ambient_gather", defines}, "ambient gather", slices.slices, paths.blocked,
               paths.hits, paths.pending, distance, bounce, count, slices.length, light.direct, light.indirect,
               light.ambient, light.ao);
    }
}

void trace_occlusion(Device& device, const World& world, const LightOptions& options, float distance,
                     std::uint32_t sample, const PrimaryHits& primary, BufferView<float> light, BufferView<float> ao) {
    const auto count = static_cast<std::uint32_t>(primary.rays.size());
    const Slices slices = cut(device, count);
    const Defines defines = ambient_defines(device, world, options, false, EnvironmentKind::none);
    Buffer<Ray> rays = make_scratch<Ray>(device, count, "rays of paths");
    Buffer<Hit> hits = make_scratch<Hit>(device, count, "hits of paths");
    {
        const Stage stage(device, "shade");
        launch_shading(device, {"render/ambient.cl", "occlusion_rays", defines}, "occlusion rays", slices.slices,
                       world.geometry, world.appearance, primary.camera, options.seed, sample, options.samples,
                       primary.first_pixel, primary.rays, primary.hits, count, slices.length, rays);
    }
    {
        const Stage stage(device, "trace");
        closest_hit(device, world.tree, rays, hits, options.trace);
    }
    const Stage stage(device, "accumulate");
    launch(device, {"render/ambient.cl", "occlusion_light", defines}, "occlusion", slices.slices, hits, distance, count,
           slices.length, light, ao);
}

} // namespace boxwood
