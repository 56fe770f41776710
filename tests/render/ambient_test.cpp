// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "boxwood/build.hpp"
#include "boxwood/render.hpp"
#include "render/ambient.hpp"
#include "render/path_picture.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

constexpr double pi = std::numbers::pi;

/// A square in the plane through `middle` with these edges, of a matt `color`.
void add_square(Scene& scene, const glm::vec3& middle, const glm::vec3& u, const glm::vec3& v, const glm::vec3& color) {
    Material material;
    material.base_color = glm::vec4(color, 1.0f);
    material.metallic = 0.0f;
    material.specular = 0.0f;
    const auto index = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    Mesh mesh{"square", {middle - u - v, middle + u - v, middle + u + v, middle - u + v}, {{0, 1, 2}, {0, 2, 3}}};
    mesh.materials = {index, index};
    scene.instances.push_back({"square", static_cast<std::uint32_t>(scene.meshes.size()), glm::mat4(1.0f)});
    scene.meshes.push_back(std::move(mesh));
}

/// The floor y = 0, 2000 wide, seen straight down by an orthographic camera over the square of `half` around `x`, 0.
Scene floor_scene() {
    Scene scene;
    add_square(scene, {0, 0, 0}, {1000, 0, 0}, {0, 0, -1000}, {0.5f, 0.25f, 0.75f});
    return scene;
}
Camera down_camera(float x, float half) {
    Camera camera;
    camera.perspective = false;
    camera.half_height = half;
    camera.to_world = glm::mat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, x, 0.5f, 0, 1);
    return camera;
}

Image picture(const Scene& scene, const Camera& camera, const RenderOptions& options, const glm::vec3& radiance) {
    Device& device = test_device();
    Environment environment;
    environment.radiance = radiance;
    return render(device, scene, build(device, scene), environment, camera, options);
}

RenderOptions options_of(Integrator integrator, std::uint32_t size, std::uint32_t samples) {
    RenderOptions options;
    options.light.integrator = integrator;
    options.light.samples = samples;
    options.light.depth = 2;
    options.width = options.height = size;
    options.ao_distance = 1.0f;
    for (const Aov aov : all_aovs())
        if (has(integrator, aov)) options.aovs.push_back(aov);
    return options;
}

const std::vector<float>& plane(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return std::get<std::vector<float>>(channel.samples);
    throw std::runtime_error("no channel " + name);
}

double mean(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) sum += double{value};
    return sum / static_cast<double>(values.size());
}

/// The mean, over the cosine-distributed rays of a point at distance `x` from a wall of infinite width and height, of 1
/// - e^-t. By the midpoint rule over the hemisphere, 1000 x 1000.
double open_beside_wall(double x) {
    constexpr int steps = 1000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double radius = std::sqrt((i + 0.5) / steps), turn = 2 * pi * (j + 0.5) / steps;
            const double towards = -radius * std::cos(turn); // of the direction's component to the wall
            sum += towards > 0.0 ? 1.0 - std::exp(-x / towards) : 1.0;
        }
    return sum / steps / steps;
}

} // namespace

TEST_CASE("ambient: nothing occludes a plane") {
    for (const Integrator integrator : {Integrator::ao, Integrator::ambient}) {
        const Image image = picture(floor_scene(), down_camera(0, 1), options_of(integrator, 8, 4), {2, 4, 1});
        for (const float open : plane(image, "ao.A")) CHECK(open == 1.0f);
        if (integrator == Integrator::ao) {
            for (const float value : plane(image, "G")) CHECK(value == 1.0f);
            continue;
        }
        // Albedo times radiance: a constant ambient light has the coefficient 0 alone.
        for (std::size_t i = 0; i < 64; ++i) {
            CHECK(plane(image, "R")[i] == 1.0f);
            CHECK(plane(image, "G")[i] == 1.0f);
            CHECK(plane(image, "ambient.B")[i] == 0.75f);
            CHECK(plane(image, "direct.B")[i] == 0.0f);
            CHECK(plane(image, "indirect.B")[i] == 0.0f);
        }
    }
}

TEST_CASE("ambient: occlusion beside a wall is the integral of 1 - e^-t") {
    // The wall x = 0 is 2000 wide and 1000 high, endless for t in units of 1. A pixel column at x = 0.25, thin against
    // it.
    Scene scene = floor_scene();
    add_square(scene, {0, 0, 0}, {0, 0, 1000}, {0, 1000, 0}, {1, 1, 1});
    const std::uint32_t samples = small_sizes() ? 16 : 256;
    for (const float x : {0.25f, 1.0f}) {
        RenderOptions options = options_of(Integrator::ao, 8, samples);
        const Image image = picture(scene, down_camera(x, 1e-3f), options, {0, 0, 0});
        // Of 64 pixels with values in [0, 1]: the standard error of independent samples, three times.
        const double error = 3.0 * 0.5 / std::sqrt(64.0 * samples);
        CHECK(std::abs(mean(plane(image, "ao.A")) - open_beside_wall(double{x})) < error);
        // In other units of t the same point is as far from the wall as another one.
        options.ao_distance = x;
        CHECK(std::abs(mean(plane(picture(scene, down_camera(x, 1e-3f), options, {0, 0, 0}), "ao.A")) -
                       open_beside_wall(1.0)) < error);
    }
}

TEST_CASE("ambient: a point light on a plane is n . l / r^2, with a shadow") {
    Scene scene; // of coordinates up to 4
    add_square(scene, {0, 0, 0}, {4, 0, 0}, {0, 0, -4}, {0.5f, 0.25f, 0.75f});
    Light light;
    light.intensity = {10, 20, 40};
    light.position = {0, 2, 0};
    scene.lights.push_back(light);
    const std::uint32_t size = 9;
    const Image image = picture(scene, down_camera(0, 3), options_of(Integrator::ambient, size, 1), {0, 0, 0});
    for (std::uint32_t i = 0; i < size * size; ++i) {
        const double x = 6.0 * ((i % size) + 0.5) / size - 3.0, z = 6.0 * ((i / size) + 0.5) / size - 3.0;
        const double square = x * x + z * z + 4.0;
        const double cosine = 2.0 / std::sqrt(square);
        const double expected = 0.5 / pi * 10 * cosine / square;
        // Some 64 roundings: of the point, by which it changes no faster than the point does, and of the formula. And
        // the clearance: the point is 20 roundoffs of the triangle's extent, 8, nearer to a light that is at least 2
        // away.
        CHECK(std::abs(plane(image, "direct.R")[i] - expected) < (64 + 160) * 0x1p-24 * expected);
        CHECK(plane(image, "R")[i] == plane(image, "direct.R")[i]);
        CHECK(plane(image, "ambient.R")[i] == 0.0f);
    }
    // A square between light and floor throws the shadow twice as large as it is.
    Scene shaded = scene;
    add_square(shaded, {0, 1, 0}, {0.5f, 0, 0}, {0, 0, -0.5f}, {1, 1, 1});
    Camera below = down_camera(0, 3); // looks from y = 0.5, under the square
    const Image shadow = picture(shaded, below, options_of(Integrator::ambient, size, 1), {0, 0, 0});
    for (std::uint32_t i = 0; i < size * size; ++i) {
        const double x = std::abs(6.0 * ((i % size) + 0.5) / size - 3.0),
                     z = std::abs(6.0 * ((i / size) + 0.5) / size - 3.0);
        CHECK((plane(shadow, "direct.G")[i] == 0.0f) == (std::max(x, z) < 1.0));
    }
}

TEST_CASE("ambient: direct light is that of the path tracer on Lambert surfaces") {
    // A wall, two lights of different power and a sun: the path tracer's direct light of 1 bounce, as an independent
    // estimate.
    Scene scene = floor_scene();
    add_square(scene, {-1, 0, 0}, {0, 0, 2}, {0, 1, 0}, {0.8f, 0.8f, 0.8f});
    for (const float x : {0.5f, 2.0f}) {
        Light light;
        light.intensity = glm::vec3(4.0f * x);
        light.position = {x, 1, 0.5f};
        scene.lights.push_back(light);
    }
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(glm::vec3(1, -1, 0.2f));
    scene.lights.push_back(sun);
    // Several pictures each, so that the spread of the differences tells their standard error.
    const std::uint32_t repeats = small_sizes() ? 3 : 12;
    std::vector<double> differences(repeats);
    double sum = 0.0, indirect = 0.0;
    for (std::uint32_t r = 0; r < repeats; ++r)
        for (const Integrator integrator : {Integrator::ambient, Integrator::direct}) {
            RenderOptions options = options_of(integrator, 12, small_sizes() ? 2 : 8);
            options.light.seed = test_seed() + r;
            const Image image = picture(scene, down_camera(0, 2), options, {0, 0, 0});
            const bool path = integrator == Integrator::direct;
            const double found = mean(plane(image, "direct.G"));
            differences[r] += path ? found : -found;
            sum += found / repeats;
            if (!path) indirect += mean(plane(image, "indirect.G"));
        }
    const Estimate difference = estimate_of(differences);
    CHECK(std::abs(difference.mean) < difference.margin() + 64 * 0x1p-24 * sum);
    CHECK(indirect > 0.0); // of the wall on the floor
}

TEST_CASE("ambient: a corner by the formula, summed over rays on the host") {
    // Floor and wall of albedo a and b under a constant ambient light of 1, no other: at a point of the floor
    //     ambient = a open(x),    indirect = a sum over the rays that meet the wall of b open(where),
    // with open() of the wall's point seen from its side: its distance from the floor, its height.
    Scene scene = floor_scene();
    const double a = 0.25, b = 0.5;
    add_square(scene, {0, 0, 0}, {0, 0, 1000}, {0, 1000, 0}, {1, 0.5f, 1});
    const std::uint32_t samples = small_sizes() ? 16 : 256;
    const double x = 0.5;
    const Image image =
        picture(scene, down_camera(0.5f, 1e-3f), options_of(Integrator::ambient, 8, samples), {1, 1, 1});
    double indirect = 0.0;
    constexpr int steps = 60;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double radius = std::sqrt((i + 0.5) / steps), turn = 2 * pi * (j + 0.5) / steps;
            const double towards = -radius * std::cos(turn);
            if (towards <= 0.0) continue;
            const double up = std::sqrt(1.0 - radius * radius) * x / towards;
            // open_beside_wall costs too much for each ray: of a logarithm's grid it is near enough.
            static std::array<double, 41> grid = [] {
                std::array<double, 41> values{};
                for (std::size_t k = 0; k < values.size(); ++k)
                    values[k] = open_beside_wall(std::exp2((static_cast<double>(k) - 24.0) / 3.0));
                return values;
            }();
            const double place = std::clamp(3.0 * std::log2(up) + 24.0, 0.0, 39.999);
            const auto k = static_cast<std::size_t>(place);
            indirect += a * b * std::lerp(grid[k], grid[k + 1], place - std::floor(place)) / steps / steps;
        }
    const double error = 3.0 * 0.5 / std::sqrt(64.0 * samples);
    CHECK(std::abs(mean(plane(image, "ambient.G")) - a * open_beside_wall(x)) < error * a);
    CHECK(std::abs(mean(plane(image, "indirect.G")) - indirect) < error * a * b);
    CHECK(mean(plane(image, "G")) ==
          doctest::Approx(mean(plane(image, "ambient.G")) + mean(plane(image, "indirect.G"))));
}

TEST_CASE("ambient: what the ambient light is for a normal") {
    // Harmonics of the second degree hold light from one side, 1 + y, exactly: its irradiance over pi is 1 + 2/3 y.
    Environment environment;
    environment.width = 64;
    environment.height = 32;
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            environment.pixels.push_back(glm::vec3(static_cast<float>(1.0 + std::cos(pi * (y + 0.5) / 32))));
    const auto c = ambient_coefficients(environment);
    CHECK(std::abs(c[0].x - 1.0) < 2e-3); // the midpoint rule of 32 rows
    CHECK(std::abs(c[1].x - 2.0 / 3) < 2e-3);
    for (std::size_t k = 2; k < 9; ++k) CHECK(std::abs(c[k].x) < 3e-3);
    // A small bright light at +x, the picture's middle, and another at +z: by n . l / pi.
    std::fill(environment.pixels.begin(), environment.pixels.end(), glm::vec3(0.0f));
    environment.pixels[16 * 64 + 32] = {1, 0, 0};
    environment.pixels[16 * 64 + 48] = {0, 1, 0};
    const auto lamps = ambient_coefficients(environment);
    CHECK(lamps[3].x > 0.0);
    CHECK(lamps[2].y > 0.0);
    CHECK(std::abs(lamps[2].x) < 0.1 * std::abs(lamps[3].x));
    CHECK(std::abs(lamps[3].y) < 0.1 * std::abs(lamps[2].y));
    // Turned by a quarter, counter-clockwise as seen from above, the first is at -z.
    environment.rotation = static_cast<float>(0.5 * pi);
    const auto turned = ambient_coefficients(environment);
    CHECK(turned[2].x == doctest::Approx(-lamps[3].x).epsilon(1e-6));
    CHECK(turned[3].y == doctest::Approx(lamps[2].y).epsilon(1e-6));
    environment = {};
    environment.radiance = {3, 2, 1};
    CHECK(ambient_coefficients(environment)[0] == glm::dvec3(3, 2, 1));
}

TEST_CASE("ambient: without a bounce only what is seen as it is; a lamp and an unlit surface are") {
    Scene scene = floor_scene();
    scene.materials[0].emission = {1, 2, 3};
    RenderOptions options = options_of(Integrator::ambient, 4, 2);
    options.light.depth = 0;
    Image image = picture(scene, down_camera(0, 1), options, {1, 1, 1});
    for (const float value : plane(image, "B")) CHECK(value == 3.0f);
    scene.materials[0].unlit = true;
    options.light.depth = 2;
    image = picture(scene, down_camera(0, 1), options, {1, 1, 1});
    for (const float value : plane(image, "B")) CHECK(value == 0.75f);
}

TEST_SUITE_END();
