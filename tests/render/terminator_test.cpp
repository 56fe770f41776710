// SPDX-License-Identifier: MIT
// Light on coarse meshes whose normals make them smooth, where triangles are turned away from it.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/build.hpp"
#include "boxwood/render.hpp"
#include "path_picture.hpp"
#include "path_scenes.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

Scene of_mesh(Mesh mesh, float albedo, const glm::mat4& transform = glm::mat4(1.0f)) {
    Scene scene;
    scene.materials = {matt(glm::vec3(albedo))};
    mesh.materials.assign(mesh.triangles.size(), 0);
    scene.meshes = {mesh};
    scene.instances = {{"mesh", 0, transform}};
    return scene;
}

Scene under_sun(Scene scene, const glm::vec3& towards) {
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = -glm::normalize(towards);
    scene.lights = {sun};
    return scene;
}

Camera camera_in_front(float half, float scale = 1.0f) {
    return {"front", look_at({0, 0, 8.0 * scale}, {0, 0, 0}), false, 0.8f, half * scale};
}

const std::vector<float>& plane(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return std::get<std::vector<float>>(channel.samples);
    throw std::runtime_error("no channel " + name);
}

/// Of the pixels whose normals for shading are turned to a sun at +x by more than a pixel's width changes, the fraction
/// that is black.
double black_share(const Scene& scene, Integrator integrator, float half, std::uint32_t across, float scale = 1.0f) {
    RenderOptions options;
    options.light.integrator = integrator;
    options.light.samples = 1;
    options.light.depth = 1;
    options.width = options.height = across;
    options.aovs = {Aov::normal, Aov::direct};
    Device& device = test_device();
    const Image image = render(device, scene, build(device, scene), {}, camera_in_front(half, scale), options);
    const std::vector<float>&light = plane(image, "direct.R"), &normal = plane(image, "normal.X");
    double lit = 0.0, black = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (!(normal[i] > 4.0f * half / static_cast<float>(across))) continue;
        ++lit;
        if (light[i] == 0.0f) ++black;
    }
    REQUIRE(lit > 0.0);
    return black / lit;
}

/// A cube whose vertices have one normal each.
Mesh rounded_cube() {
    Mesh mesh{"cube", {}, {}};
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
        mesh.normals.push_back(glm::normalize(mesh.positions.back()));
    }
    mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {1, 0, 2}, {1, 2, 3}, {5, 1, 3}, {5, 3, 7},
                      {0, 4, 6}, {0, 6, 2}, {6, 7, 3}, {6, 3, 2}, {0, 1, 5}, {0, 5, 4}};
    return mesh;
}

} // namespace

TEST_CASE("terminator: a smooth sphere of 8 x 16 is lit wherever its normals are turned to the sun") {
    const std::uint32_t across = small_sizes() ? 16 : 128;
    const Scene sphere = under_sun(of_mesh(sphere_mesh(8, true), 0.5f), {1, 0, 0});
    for (const Integrator integrator : {Integrator::path, Integrator::ambient})
        CHECK(black_share(sphere, integrator, 1.05f, across) < 0.003);
    // Finer, turned, stretched and mirrored.
    CHECK(black_share(under_sun(of_mesh(sphere_mesh(32, true), 0.5f), {1, 0, 0}), Integrator::path, 1.05f, across) <
          0.003);
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    for (const glm::vec3 scale : {glm::vec3(1, 0.5f, 2), glm::vec3(-1, 1, 1)})
        CHECK(black_share(under_sun(of_mesh(sphere_mesh(8, true), 0.5f, turned * glm::scale(glm::mat4(1.0f), scale)),
                                    {1, 0, 0}),
                          Integrator::path, 2.1f, across) < 0.006);
    for (const float k : {-40.0f, 40.0f})
        CHECK(black_share(scaled(sphere, std::exp2(k)), Integrator::path, 1.05f, across, std::exp2(k)) ==
              black_share(sphere, Integrator::path, 1.05f, across));
}

TEST_CASE("terminator: a smooth white sphere in a white world cannot be seen") {
    // Its triangles lose nothing at their edges, and nothing is added.
    const Scene sphere = of_mesh(sphere_mesh(8, true), 1.0f);
    Environment constant, picture;
    constant.radiance = glm::vec3(1.0f);
    picture.width = 16;
    picture.height = 8;
    picture.pixels.assign(128, glm::vec3(1.0f));
    for (const Environment* around : {&constant, &picture})
        for (const Strategy strategy : {Strategy::mis, Strategy::bsdf}) {
            CAPTURE(around->width);
            CAPTURE(static_cast<int>(strategy));
            const LitScene lit(test_device(), sphere, *around);
            LightOptions options;
            options.strategy = strategy;
            options.samples = 4;
            options.seed = test_seed();
            const std::uint32_t across = small_sizes() ? 8 : 32, repeats = small_sizes() ? 8 : 24;
            const Estimate found =
                estimate(test_device(), lit, camera_in_front(0.6f), {across, across}, options, repeats);
            CHECK(std::abs(found.mean - 1.0) < found.margin());
            CHECK(found.error < (small_sizes() ? 0.1 : 2e-3));
        }
}

TEST_CASE("terminator: edges stay edges, and shadows shadows") {
    // Normals of a cube's corners are 55 degrees off its faces: the front is black under a sun from behind.
    const Scene cube = under_sun(of_mesh(rounded_cube(), 0.5f), {1, 0, -0.1f});
    CHECK(black_share(cube, Integrator::path, 0.9f, 16) == 1.0);
    // A plate in the way of the sun leaves nothing of its light on the sphere.
    Scene shaded = under_sun(of_mesh(sphere_mesh(8, true), 0.5f), {1, 0, 0});
    add_quad(shaded, {1.2f, -2, -2}, {0, 4, 0}, {0, 0, 4}, matt(glm::vec3(0.5f)));
    CHECK(black_share(shaded, Integrator::path, 1.05f, 32) == 1.0);
}

TEST_SUITE_END();
