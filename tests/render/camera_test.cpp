// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

glm::dvec3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

std::vector<Ray> make_rays(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    Guarded<Ray> rays(test_device(), std::size_t{width} * height);
    primary_rays(test_device(), camera, width, height, rays.view());
    CHECK(rays.intact());
    return rays.values();
}

/// Somewhere, turned, with a scale that must not matter.
Camera turned_camera(bool perspective) {
    Camera camera;
    camera.to_world = glm::scale(
        glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(3, -2, 7)), 1.1f, glm::normalize(glm::vec3(1, 2, -0.5f))),
        glm::vec3(2.0f));
    camera.perspective = perspective;
    camera.vertical_fov = 1.0f;
    camera.half_height = 2.5f;
    return camera;
}

Scene box_scene(float size, const glm::vec3& middle) {
    Scene scene;
    Mesh mesh{"m", {}, {{0, 1, 2}, {4, 5, 6}}};
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(glm::vec3((i & 1) ? 1 : -1, (i & 2) ? 2 : -2, (i & 4) ? 0.5f : -0.5f));
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"i", 0, glm::scale(glm::translate(glm::mat4(1.0f), middle), glm::vec3(size))});
    return scene;
}

} // namespace

TEST_CASE("camera: perspective rays go through the pixel centres") {
    // Neither square nor even, and more rays than one slice holds.
    constexpr std::uint32_t width = 37, height = 23;
    const Camera camera = turned_camera(true);
    const glm::dmat4 to_world(camera.to_world);
    const std::vector<Ray> rays = make_rays(camera, width, height);
    const double tangent = std::tan(0.5 * double(camera.vertical_fov));
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const Ray& ray = rays[y * width + x];
            const double across = (2.0 * (x + 0.5) / width - 1.0) * tangent * width / height;
            const double upward = (1.0 - 2.0 * (y + 0.5) / height) * tangent;
            const glm::dvec3 expected = glm::normalize(glm::dvec3(to_world * glm::dvec4(across, upward, -1.0, 0.0)));
            // A handful of roundings of numbers below 2.
            CHECK(glm::length(vector(ray.direction) - expected) < 8 * 0x1p-23);
            CHECK(vector(ray.origin) == glm::dvec3(to_world[3]));
            CHECK(ray.t_min == 0.0f);
            CHECK(ray.t_max == std::numeric_limits<float>::infinity());
        }
    }
}

TEST_CASE("camera: orthographic rays are parallel") {
    constexpr std::uint32_t width = 5, height = 8;
    const Camera camera = turned_camera(false);
    const glm::dmat4 to_world(camera.to_world);
    const std::vector<Ray> rays = make_rays(camera, width, height);
    const glm::dvec3 right = glm::normalize(glm::dvec3(to_world[0])), up = glm::normalize(glm::dvec3(to_world[1]));
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const Ray& ray = rays[y * width + x];
            const double half = double(camera.half_height);
            const glm::dvec3 expected = glm::dvec3(to_world[3]) +
                                        (2.0 * (x + 0.5) / width - 1.0) * half * width / height * right +
                                        (1.0 - 2.0 * (y + 0.5) / height) * half * up;
            CHECK(glm::length(vector(ray.origin) - expected) < 16 * 0x1p-23);
            CHECK(glm::length(vector(ray.direction) + glm::normalize(glm::dvec3(to_world[2]))) < 4 * 0x1p-23);
        }
    }
}

TEST_CASE("camera: one pixel looks straight ahead, no pixel gives no ray, a wrong size is refused") {
    const std::vector<Ray> one = make_rays(Camera{}, 1, 1);
    CHECK(vector(one[0].direction) == glm::dvec3(0, 0, -1));
    CHECK(make_rays(Camera{}, 0, 5).empty());
    const Buffer<Ray> rays = make_buffer<Ray>(test_device(), 6, "rays");
    CHECK_THROWS_AS(primary_rays(test_device(), Camera{}, 2, 2, rays), InputError);
    CHECK_THROWS_AS(primary_rays(test_device(), Camera{}, (1u << 23) + 1, 0, rays.prefix(0)), InputError);
}

TEST_CASE("camera: a sample lies inside its pixel's square, and a picture without pixels has a finite record") {
    const float nan = std::nanf("");
    for (const float jitter : {1.0f, -1.0f, 2.0f, nan})
        for (const glm::vec2 at : {glm::vec2(jitter, 0.0f), glm::vec2(0.0f, jitter)})
            CHECK_THROWS_AS(upload_camera(test_device(), Camera{}, 4, 4, at), InputError);
    CHECK_NOTHROW(upload_camera(test_device(), Camera{}, 4, 4, glm::vec2(0x1.fffffep-1f, -0x1.fffffep-1f)));
    const CameraRecord none = download(test_device(), upload_camera(test_device(), Camera{}, 4, 0))[0];
    CHECK(std::isfinite(none.up[1]));
}

TEST_CASE("camera: the default camera sees all corners from outside") {
    for (const float size : {0x1p-30f, 1.0f, 0x1p40f}) {
        CAPTURE(size);
        const Scene scene = box_scene(size, size * glm::vec3(4, -5, 6));
        const Camera camera = default_camera(scene);
        const glm::dmat4 to_camera = glm::inverse(glm::dmat4(camera.to_world));
        const double tangent = std::tan(0.5 * double(camera.vertical_fov));
        double fullest = 0.0;
        for (const glm::vec3& position : scene.meshes[0].positions) {
            const glm::dvec4 world = glm::dmat4(scene.instances[0].transform) * glm::dvec4(position, 1.0);
            const glm::dvec4 local = to_camera * world;
            REQUIRE(local.z < 0.0);
            fullest = std::max({fullest, std::abs(local.x / local.z), std::abs(local.y / local.z)});
        }
        CHECK(fullest < tangent);
        CHECK(fullest > 0.85 * tangent); // and fills the picture
        const glm::dvec3 forward = -glm::dvec3(camera.to_world[2]);
        CHECK(glm::length(forward - glm::normalize(glm::dvec3(-1, -0.6, -1.2))) < 4 * 0x1p-23);
    }
}

TEST_CASE("camera: an empty scene and a scene of one point have a view") {
    const Camera empty = default_camera(Scene{});
    CHECK(glm::length(glm::vec3(empty.to_world[3])) > 1.0f);
    Scene point = box_scene(1.0f, glm::vec3(0));
    for (glm::vec3& position : point.meshes[0].positions) position = glm::vec3(9, 8, 7);
    const Camera camera = default_camera(point);
    CHECK(glm::length(glm::vec3(camera.to_world[3]) - glm::vec3(9, 8, 7)) > 1.0f);
    CHECK(default_light(Scene{}) == glm::vec3(0.0f));
    CHECK(default_light(box_scene(1.0f, glm::vec3(1, 2, 3))) == glm::vec3(1.0f, 3.8f, 3.0f));
}

TEST_CASE("camera: a scene scaled by a power of two gives the same rays, scaled") {
    const Scene scene = box_scene(1.0f, glm::vec3(4, -5, 6));
    const std::vector<Ray> rays = make_rays(default_camera(scene), 16, 16);
    for (const int k : {-60, 60}) {
        const float scale = std::ldexp(1.0f, k);
        const std::vector<Ray> scaled =
            make_rays(default_camera(box_scene(scale, scale * glm::vec3(4, -5, 6))), 16, 16);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            CHECK(vector(scaled[i].origin) == double(scale) * vector(rays[i].origin));
            CHECK(vector(scaled[i].direction) == vector(rays[i].direction));
        }
    }
}
