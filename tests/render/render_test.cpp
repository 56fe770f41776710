// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/render.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

// Odd, so that a pixel lies in the middle, and small.
constexpr std::uint32_t width = 33, height = 21;

/// Two squares before a camera at the origin: instance 0 faces it from the left half of z = -3; instance 1, mirrored
/// and stretched, is tilted and covers a part of the right half. Miss around them.
Scene two_squares(float scale) {
    Scene scene;
    scene.meshes.push_back({"square", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    const glm::mat4 world = glm::scale(glm::mat4(1.0f), glm::vec3(scale));
    const glm::mat4 left = glm::translate(glm::mat4(1.0f), glm::vec3(-1.25f, 0, -3));
    glm::mat4 right = glm::translate(glm::mat4(1.0f), glm::vec3(1.25f, 0, -4));
    right = glm::scale(right, glm::vec3(1, 1, 0.25f)); // after the turn: what tells the inverse transpose apart
    right = glm::rotate(right, 0.75f, glm::vec3(0, 1, 0));
    right = glm::scale(right, glm::vec3(-1, 1, 1));
    scene.instances.push_back({"left", 0, world * left});
    scene.instances.push_back({"right", 0, world * right});
    return scene;
}

Image picture(const Scene& scene, const std::vector<Aov>& aovs, const BuildOptions& options = {}) {
    Device& device = test_device();
    Camera camera;
    camera.vertical_fov = 1.2f;
    const Tree tree = build(device, scene, options);
    return render(device, tree, upload(device, scene), camera, {width, height, aovs, {}});
}

template <class T>
const std::vector<T>& plane(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return std::get<std::vector<T>>(channel.samples);
    throw std::runtime_error("no channel " + name);
}

bool has(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return true;
    return false;
}

struct Expected {
    double t = std::numeric_limits<double>::infinity();
    glm::dvec3 normal{0.0};
    std::uint32_t instance = BOXWOOD_NONE;
    std::uint32_t primitive = BOXWOOD_NONE;
    bool near_edge = false; ///< Where rounding may decide.
};

/// The square met by the ray from the origin along `direction`, in double, by intersecting its plane.
Expected intersect(const Scene& scene, const glm::dvec3& direction) {
    Expected best;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const glm::dmat4 inverse = glm::inverse(glm::dmat4(scene.instances[i].transform));
        const glm::dvec3 o(inverse * glm::dvec4(0, 0, 0, 1)), d(inverse * glm::dvec4(direction, 0));
        const double t = -o.z / d.z;
        const glm::dvec3 p = o + t * d;
        const double outside = std::max(std::abs(p.x), std::abs(p.y)) - 1.0;
        if (std::abs(outside) < 1e-4 || std::abs(p.x - p.y) < 1e-4) best.near_edge = true;
        if (outside > 0.0 || t <= 0.0 || t >= best.t) continue;
        best.t = t;
        best.instance = i;
        best.primitive = p.x > p.y ? 0 : 1;
        const glm::dvec3 n = glm::normalize(glm::dvec3(glm::transpose(inverse) * glm::dvec4(0, 0, 1, 0)));
        best.normal = glm::dot(n, direction) > 0.0 ? -n : n;
    }
    return best;
}

glm::dvec3 pixel_direction(std::uint32_t x, std::uint32_t y) {
    const double tangent = std::tan(0.5 * double(1.2f));
    return glm::normalize(glm::dvec3((2.0 * (x + 0.5) / width - 1.0) * tangent * width / height,
                                     (1.0 - 2.0 * (y + 0.5) / height) * tangent, -1.0));
}

} // namespace

TEST_CASE("render: every channel holds what its pixel's ray meets") {
    const Scene scene = two_squares(1.0f);
    for (const Levels levels : {Levels::one, Levels::two}) {
        for (const Bounds bounds : {Bounds::aabb, Bounds::obb_points}) {
            const Image image = picture(scene, all_aovs(), {.levels = levels, .bounds = {.kind = bounds}});
            CHECK(image.channels.size() == 3 + 1 + 3 + 1 + 1 + 2);
            std::size_t seen[3] = {};
            for (std::uint32_t i = 0; i < width * height; ++i) {
                CAPTURE(i);
                const Expected expected = intersect(scene, pixel_direction(i % width, i / width));
                if (expected.near_edge) continue;
                const std::uint32_t instance = plane<std::uint32_t>(image, "instance.id")[i];
                REQUIRE(instance == expected.instance);
                ++seen[std::min(instance, 2u)];
                CHECK(plane<std::uint32_t>(image, "primitive.id")[i] == expected.primitive);
                const glm::dvec3 normal(plane<float>(image, "normal.X")[i], plane<float>(image, "normal.Y")[i],
                                        plane<float>(image, "normal.Z")[i]);
                CHECK(glm::length(normal - expected.normal) < 1e-5);
                const float depth = plane<float>(image, "depth.Z")[i];
                if (instance == BOXWOOD_NONE) {
                    CHECK(depth == std::numeric_limits<float>::infinity());
                } else {
                    CHECK(std::abs(depth - expected.t) < 1e-5 * expected.t);
                    CHECK(plane<std::uint32_t>(image, "cost.primitives")[i] >= 1);
                }
            }
            // Enough of each kind to mean something.
            for (const std::size_t count : seen) CHECK(count > 30);
        }
    }
}

TEST_CASE("render: costs are the statistics of the same rays") {
    Device& device = test_device();
    const Scene scene = two_squares(1.0f);
    for (const Bounds bounds : {Bounds::aabb, Bounds::obb_moments}) {
        const BuildOptions options{.bounds = {.kind = bounds}};
        const Image image = picture(scene, {Aov::cost}, options);
        const Tree tree = build(device, scene, options);
        Camera camera;
        camera.vertical_fov = 1.2f;
        const Buffer<Ray> rays = make_buffer<Ray>(device, width * height, "rays");
        const Buffer<Hit> hits = make_buffer<Hit>(device, width * height, "hits");
        const Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, width * height, "statistics");
        primary_rays(device, camera, width, height, rays);
        closest_hit(device, tree, rays, hits, statistics);
        const std::vector<RayStatistics> expected = download(device, statistics);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            CHECK(plane<std::uint32_t>(image, "cost.volumes")[i] == expected[i].volumes);
            CHECK(plane<std::uint32_t>(image, "cost.primitives")[i] == expected[i].primitives);
        }
    }
}

TEST_CASE("render: only what is asked for is there, once") {
    const Scene scene = two_squares(1.0f);
    const Image plain = picture(scene, {});
    CHECK(plain.channels.size() == 3);
    const Image repeated = picture(scene, {Aov::depth, Aov::depth});
    CHECK(repeated.channels.size() == 4);
    CHECK(has(repeated, "depth.Z"));
    CHECK_FALSE(has(repeated, "cost.volumes"));
}

TEST_CASE("render: an empty scene renders the background") {
    const Image image = picture(Scene{}, all_aovs());
    for (std::uint32_t i = 0; i < width * height; ++i) {
        REQUIRE(plane<std::uint32_t>(image, "instance.id")[i] == BOXWOOD_NONE);
        REQUIRE(plane<float>(image, "depth.Z")[i] == std::numeric_limits<float>::infinity());
        REQUIRE(plane<std::uint32_t>(image, "cost.volumes")[i] == 0);
        REQUIRE(plane<float>(image, "B")[i] > 0.0f);
        REQUIRE(plane<float>(image, "B")[i] < 1.0f);
    }
    CHECK(plane<float>(image, "B").front() > plane<float>(image, "B").back()); // brighter above
}

TEST_CASE("render: a scene scaled by a power of two gives the same picture, its depth scaled") {
    const Image image = picture(two_squares(1.0f), all_aovs());
    for (const int k : {-30, 30}) {
        const float scale = std::ldexp(1.0f, k);
        const Image scaled = picture(two_squares(scale), all_aovs());
        for (std::size_t c = 0; c < image.channels.size(); ++c) {
            CAPTURE(image.channels[c].name);
            if (image.channels[c].name != "depth.Z") CHECK(scaled.channels[c].samples == image.channels[c].samples);
        }
        const auto &depth = plane<float>(image, "depth.Z"), &scaled_depth = plane<float>(scaled, "depth.Z");
        for (std::size_t i = 0; i < depth.size(); ++i) CHECK(scaled_depth[i] == scale * depth[i]);
    }
}

TEST_CASE("render: words and sizes are checked") {
    for (const Aov aov : all_aovs()) CHECK(to_aov(name(aov)) == aov);
    CHECK_THROWS_AS(to_aov("albedo"), InputError);
    Device& device = test_device();
    const Scene scene;
    CHECK_THROWS_AS(render(device, build(device, scene), upload(device, scene), Camera{}, {0, 5, {}, {}}), InputError);
}
