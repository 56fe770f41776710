// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "render/camera.hpp"
#include "render/jitter.hpp"
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

TEST_CASE("camera: a jitter moves all rays by the same part of a pixel") {
    constexpr std::uint32_t width = 11, height = 7;
    const glm::vec2 jitter(0.625f, -0.875f);
    for (const bool perspective : {true, false}) {
        const Camera camera = turned_camera(perspective);
        const glm::dmat4 to_world(camera.to_world);
        const glm::dvec3 right = glm::normalize(glm::dvec3(to_world[0])), up = glm::normalize(glm::dvec3(to_world[1])),
                         back = glm::normalize(glm::dvec3(to_world[2]));
        Buffer<Ray> rays = make_buffer<Ray>(test_device(), width * height, "rays");
        primary_rays(test_device(), upload_camera(test_device(), camera, width, height, jitter), 0, rays);
        const std::vector<Ray> found = download(test_device(), rays);
        const double half = perspective ? std::tan(0.5 * double(camera.vertical_fov)) : double(camera.half_height);
        for (std::uint32_t i = 0; i < width * height; ++i) {
            // In half pixels from the picture's middle, to the right and up.
            const double across = 2.0 * (i % width) + 1.0 + double(jitter.x) - width;
            const double upward = height - 2.0 * (i / width) - 1.0 + double(jitter.y);
            const glm::dvec3 offset = half / height * (across * right + upward * up);
            const glm::dvec3 origin = glm::dvec3(to_world[3]) + (perspective ? glm::dvec3(0.0) : offset);
            const glm::dvec3 direction = perspective ? glm::normalize(offset - back) : -back;
            // Some roundings of numbers below 2, of coordinates below 16.
            CHECK(glm::length(vector(found[i].direction) - direction) < 8 * 0x1p-23);
            CHECK(glm::length(vector(found[i].origin) - origin) < 16 * 0x1p-23);
        }
    }
}

TEST_CASE("camera: the jitters of a sequence cover the pixel") {
    LightOptions options;
    for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::stratified})
        for (const std::uint64_t seed : {std::uint64_t{0}, test_seed()}) {
            options.sampler = sampler;
            options.seed = seed;
            // Any 2^k points that follow one another from a multiple of 2^k: one in each box of 2^-k of the pixel's
            // area, whatever its shape (a (0, 2)-sequence in base 2). A digital shift moves boxes onto boxes.
            for (const std::uint32_t k : {4u, 8u})
                for (const std::uint32_t first : {0u, 3u << k})
                    for (std::uint32_t wide = 0; wide <= k; ++wide) {
                        CAPTURE(first);
                        CAPTURE(wide);
                        std::vector<int> count(std::size_t{1} << k);
                        glm::dvec2 sum(0.0);
                        for (std::uint32_t i = 0; i < count.size(); ++i) {
                            const glm::dvec2 jitter(camera_jitter(options, first + i));
                            REQUIRE((std::abs(jitter.x) < 1.0 && std::abs(jitter.y) < 1.0));
                            const auto column = static_cast<std::size_t>(std::ldexp(0.5 + 0.5 * jitter.x, int(wide)));
                            const auto row = static_cast<std::size_t>(std::ldexp(0.5 + 0.5 * jitter.y, int(k - wide)));
                            ++count[(row << wide) + column];
                            sum += jitter;
                        }
                        CHECK(std::count(count.begin(), count.end(), 1) == static_cast<int>(count.size()));
                        // One in each of n columns 2/n wide, at most half of that from its middle.
                        CHECK(std::abs(sum.x) <= 1.0);
                        CHECK(std::abs(sum.y) <= 1.0);
                    }
        }
}

TEST_CASE("camera: random jitters are independent, another seed gives others, one sample takes the centre") {
    LightOptions options;
    options.sampler = SamplerKind::random;
    options.seed = test_seed();
    constexpr std::uint32_t count = 1u << 14, cells = 8;
    std::vector<double> in_cell(cells * cells);
    glm::dvec2 sum(0.0);
    double product = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec2 jitter(camera_jitter(options, i));
        REQUIRE((std::abs(jitter.x) < 1.0 && std::abs(jitter.y) < 1.0));
        sum += jitter;
        product += jitter.x * jitter.y;
        ++in_cell[cells * std::size_t(cells * (0.5 + 0.5 * jitter.y)) + std::size_t(cells * (0.5 + 0.5 * jitter.x))];
    }
    // Uniform in (-1, 1): variance 1/3, of a product 1/9. Five standard errors.
    CHECK(std::abs(sum.x) < 5.0 * std::sqrt(count / 3.0));
    CHECK(std::abs(sum.y) < 5.0 * std::sqrt(count / 3.0));
    CHECK(std::abs(product) < 5.0 * std::sqrt(count / 9.0));
    // chi^2 of 63 degrees of freedom, whose variance is 126: neither clumped nor stratified.
    double squares = 0.0;
    for (const double n : in_cell) squares += std::pow(n - count / 64.0, 2) / (count / 64.0);
    CHECK(std::abs(squares - 63.0) < 5.0 * std::sqrt(126.0));

    for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::stratified, SamplerKind::random}) {
        LightOptions one = options, other = options;
        one.sampler = other.sampler = sampler;
        ++other.seed;
        CHECK(camera_jitter(one, 5) == camera_jitter(one, 5));
        CHECK(camera_jitter(one, 5) != camera_jitter(one, 6));
        CHECK(camera_jitter(one, 5) != camera_jitter(other, 5));
        one.samples = 1;
        CHECK(camera_jitter(one, 0) == glm::vec2(0.0f));
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
    Buffer<Ray> rays = make_buffer<Ray>(test_device(), 6, "rays");
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

TEST_CASE("camera: the default camera sees everything from the front, and fills the picture") {
    const glm::dvec3 wanted(0, -std::sin(glm::radians(15.0)), -std::cos(glm::radians(15.0)));
    for (const float size : {0x1p-30f, 1.0f, 0x1p40f})
        for (const float aspect : {1.0f, 16.0f / 9, 0.5f, 40.0f})
            for (const bool twice : {false, true}) {
                CAPTURE(size);
                CAPTURE(aspect);
                CAPTURE(twice);
                Scene scene = box_scene(size, size * glm::vec3(4, -5, 6));
                if (twice) scene.instances.push_back(scene.instances[0]);
                const Camera camera = default_camera(scene, aspect);
                const glm::dmat4 to_camera = glm::inverse(glm::dmat4(camera.to_world));
                const double tangent = std::tan(0.5 * double(camera.vertical_fov));
                glm::dvec2 low(1.0), high(-1.0);
                for (const glm::vec3& position : scene.meshes[0].positions) {
                    const glm::dvec4 world = glm::dmat4(scene.instances[0].transform) * glm::dvec4(position, 1.0);
                    const glm::dvec4 local = to_camera * world;
                    REQUIRE(local.z < 0.0);
                    const glm::dvec2 at = glm::dvec2(local) / -local.z / glm::dvec2(tangent * aspect, tangent);
                    low = glm::min(low, at);
                    high = glm::max(high, at);
                }
                // From edge to edge along one axis, but for 5 %, and within along the other.
                const int full = high.x - low.x > high.y - low.y ? 0 : 1;
                CHECK(std::abs(high[full] - 1.0 / 1.05) < 1e-4);
                CHECK(std::abs(low[full] + 1.0 / 1.05) < 1e-4);
                CHECK(high[1 - full] < 1.0 / 1.05 + 1e-4);
                CHECK(low[1 - full] > -1.0 / 1.05 - 1e-4);
                CHECK(glm::length(-glm::dvec3(camera.to_world[2]) - wanted) < 4 * 0x1p-23);
            }
    for (const float aspect : {0.0f, -1.0f, std::nanf(""), std::numeric_limits<float>::infinity()})
        CHECK_THROWS_AS(default_camera(Scene{}, aspect), InputError);
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
