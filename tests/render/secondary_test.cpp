// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

glm::vec3 vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
glm::dvec3 dvec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

Ray ray_of(const glm::vec3& origin, const glm::vec3& direction) {
    return {{origin.x, origin.y, origin.z},
            0.0f,
            {direction.x, direction.y, direction.z},
            std::numeric_limits<float>::infinity()};
}

constexpr Hit miss = {std::numeric_limits<float>::infinity(), 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};

/// A scene with one ray and its hit per triangle or more.
struct Case {
    Scene scene;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
};

glm::dvec3 world_corner(const Case& c, const Hit& hit, int corner) {
    const Instance& instance = c.scene.instances[hit.instance];
    const Mesh& mesh = c.scene.meshes[instance.mesh];
    const glm::vec3 position = mesh.positions[mesh.triangles[hit.primitive][corner]];
    return glm::dvec3(glm::dmat4(instance.transform) * glm::dvec4(position, 1.0));
}

/// A ray from `side` of the surface to a random point of the triangle, as a traversal would report it.
void add_hit(Case& c, std::uint32_t instance, std::uint32_t primitive, Random& random) {
    float u = random.uniform(0.01f, 0.98f), v = random.uniform(0.01f, 0.98f);
    if (u + v > 0.99f) u = 0.5f * (1.0f - u), v = 0.5f * (1.0f - v);
    const Hit hit{1.0f, u, v, primitive, instance};
    const glm::dvec3 p0 = world_corner(c, hit, 0), p1 = world_corner(c, hit, 1), p2 = world_corner(c, hit, 2);
    const glm::dvec3 point = p0 + double(u) * (p1 - p0) + double(v) * (p2 - p0);
    const double size = glm::length(p1 - p0);
    glm::dvec3 normal = glm::normalize(glm::cross((p1 - p0) / size, (p2 - p0) / size));
    if (random.bits() & 1) normal = -normal;
    const glm::dvec3 sideways = glm::normalize(p1 - p0) * double(random.uniform(-2, 2));
    const glm::vec3 origin(point + size * (normal + sideways));
    c.rays.push_back(ray_of(origin, glm::vec3(point - glm::dvec3(origin))));
    c.hits.push_back(hit);
}

/// Random triangles (none a sliver: the longest side is at most 6 times the height over it) under random turned,
/// stretched, mirrored and moved instances, all times `scale`.
Case random_case(float scale, std::size_t triangles, bool identity) {
    Random random(identity ? 21 : 22);
    Case c;
    Mesh mesh{"m", {}, {}};
    const auto point = [&](float r) {
        const float x = random.uniform(-r, r), y = random.uniform(-r, r), z = random.uniform(-r, r);
        return glm::vec3(x, y, z);
    };
    while (mesh.triangles.size() < triangles) {
        const glm::vec3 base = point(20.0f), e1 = point(1.0f), e2 = point(1.0f);
        const float longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
        if (longest * longest > 6.0f * glm::length(glm::cross(e1, e2))) continue;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : {base, base + e1, base + e2}) mesh.positions.push_back(scale * p);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    c.scene.meshes.push_back(mesh);
    const std::uint32_t instances = identity ? 1 : 16;
    for (std::uint32_t i = 0; i < instances; ++i) {
        glm::mat4 transform(1.0f);
        if (!identity) {
            transform = glm::rotate(transform, random.uniform(0, 6), glm::normalize(point(1.0f)));
            transform = glm::scale(transform, glm::vec3(random.uniform(0.5f, 2), random.uniform(-2, -0.5f), 1.5f));
            transform[3] = glm::vec4(scale * point(200.0f), 1.0f);
        }
        c.scene.instances.push_back({"i", 0, transform});
        for (std::uint32_t t = 0; t < triangles; ++t) add_hit(c, i, t, random);
    }
    return c;
}

std::vector<Ray> diffuse(const Case& c, std::uint64_t seed) {
    Device& device = test_device();
    const Geometry geometry = upload(device, c.scene);
    const Buffer<Ray> rays = upload(device, c.rays, "rays");
    const Buffer<Hit> hits = upload(device, c.hits, "hits");
    Guarded<Ray> out(device, c.rays.size());
    diffuse_rays(device, geometry, rays, hits, seed, out.view());
    CHECK(out.intact());
    return out.values();
}

std::vector<Ray> shadow(const Case& c, const glm::vec3& light) {
    Device& device = test_device();
    const Geometry geometry = upload(device, c.scene);
    const Buffer<Ray> rays = upload(device, c.rays, "rays");
    const Buffer<Hit> hits = upload(device, c.hits, "hits");
    Guarded<Ray> out(device, c.rays.size());
    shadow_rays(device, geometry, rays, hits, light, out.view());
    CHECK(out.intact());
    return out.values();
}

/// World normal of the triangle of a hit, towards the origin of its ray.
glm::dvec3 facing_normal(const Case& c, std::size_t i) {
    const glm::dvec3 p0 = world_corner(c, c.hits[i], 0);
    const glm::dvec3 e1 = world_corner(c, c.hits[i], 1) - p0, e2 = world_corner(c, c.hits[i], 2) - p0;
    const glm::dvec3 normal = glm::normalize(glm::cross(glm::normalize(e1), glm::normalize(e2)));
    return glm::dot(normal, dvec(c.rays[i].direction)) > 0.0 ? -normal : normal;
}

/// t of the ray against the triangle, as a traversal in float finds it in object space; none for a miss.
std::optional<float> float_hit(const Case& c, const Hit& hit, const Ray& ray, const InstanceRecord& record) {
    const auto apply = [&](const glm::vec3& p, float w) {
        glm::vec3 result;
        for (int r = 0; r < 3; ++r)
            result[r] = record.to_object[4 * r] * p.x + record.to_object[4 * r + 1] * p.y +
                        record.to_object[4 * r + 2] * p.z + record.to_object[4 * r + 3] * w;
        return result;
    };
    const glm::vec3 origin = apply(vec(ray.origin), 1.0f), direction = apply(vec(ray.direction), 0.0f);
    const Mesh& mesh = c.scene.meshes[c.scene.instances[hit.instance].mesh];
    const glm::uvec3 corner = mesh.triangles[hit.primitive];
    const glm::vec3 v0 = mesh.positions[corner.x];
    const glm::vec3 e1 = mesh.positions[corner.y] - v0, e2 = mesh.positions[corner.z] - v0;
    const glm::vec3 p = glm::cross(direction, e2), t = origin - v0, q = glm::cross(t, e1);
    const float det = glm::dot(e1, p);
    const float u = glm::dot(t, p) / det, v = glm::dot(direction, q) / det, distance = glm::dot(e2, q) / det;
    if (det == 0.0f || u < 0.0f || v < 0.0f || u + v > 1.0f || !(distance > ray.t_min) || distance > ray.t_max)
        return std::nullopt;
    return distance;
}

std::size_t small(std::size_t count) { return small_sizes() ? 8 : count; }

} // namespace

TEST_CASE("secondary: diffuse directions are on the ray's side and cosine-distributed") {
    const Case c = random_case(1.0f, small(4096), false);
    const std::vector<Ray> out = diffuse(c, 7);
    const double n = static_cast<double>(out.size());
    double cosine = 0.0, cosine_square = 0.0;
    glm::dvec2 sideways(0.0);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const glm::dvec3 normal = facing_normal(c, i), direction = dvec(out[i].direction);
        const double height = glm::dot(normal, direction);
        REQUIRE(height > 0.0);
        REQUIRE(std::abs(glm::length(direction) - 1.0) < 16 * 0x1p-24);
        CHECK(out[i].t_min == 0.0f);
        CHECK(out[i].t_max == std::numeric_limits<float>::infinity());
        cosine += height / n;
        cosine_square += height * height / n;
        const glm::dvec3 axis = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 tangent = glm::normalize(glm::cross(axis, normal));
        sideways += glm::dvec2(glm::dot(direction, tangent), glm::dot(direction, glm::cross(normal, tangent))) / n;
    }
    // Density cos / pi: mean 2/3 and variance 1/18 of the cosine, mean 1/2 and variance 1/12 of its square, mean 0 and
    // variance 1/4 of each tangential part. Five standard deviations: one failure in 1.7 million seeds each.
    CHECK(std::abs(cosine - 2.0 / 3.0) < 5.0 * std::sqrt(1.0 / 18.0 / n));
    CHECK(std::abs(cosine_square - 0.5) < 5.0 * std::sqrt(1.0 / 12.0 / n));
    CHECK(std::abs(sideways.x) < 5.0 * std::sqrt(0.25 / n));
    CHECK(std::abs(sideways.y) < 5.0 * std::sqrt(0.25 / n));
}

TEST_CASE("secondary: directions depend on seed and index alone") {
    Case c = random_case(1.0f, small(1024), true);
    const std::vector<Ray> all = diffuse(c, 7), other = diffuse(c, 8);
    const Tuning tuning = test_device().tuning();
    test_device().set_tuning({1, 3, 1});
    const std::vector<Ray> cut_otherwise = diffuse(c, 7);
    test_device().set_tuning(tuning);
    const std::size_t half = c.rays.size() / 2;
    c.rays.resize(half);
    c.hits.resize(half);
    const std::vector<Ray> first = diffuse(c, 7);
    std::size_t different = 0;
    for (std::size_t i = 0; i < half; ++i) {
        CHECK(vec(first[i].direction) == vec(all[i].direction));
        CHECK(vec(cut_otherwise[i].direction) == vec(all[i].direction));
        if (vec(other[i].direction) != vec(all[i].direction)) ++different;
    }
    CHECK(different == half);
}

TEST_CASE("secondary: no new ray hits the triangle it leaves") {
    for (const bool identity : {true, false}) {
        for (const int k : {-40, 0, 40}) {
            CAPTURE(identity);
            CAPTURE(k);
            const Case c = random_case(std::ldexp(1.0f, k), small(2048), identity);
            const std::vector<InstanceRecord> records = instance_records(c.scene);
            const std::vector<Ray> out = diffuse(c, 3);
            std::size_t own_hits = 0;
            double farthest = 0.0;
            for (std::size_t i = 0; i < out.size(); ++i) {
                const Hit& hit = c.hits[i];
                if (float_hit(c, hit, out[i], records[hit.instance])) ++own_hits;
                const glm::dvec3 origin = dvec(out[i].origin), p0 = world_corner(c, hit, 0);
                const double height = glm::dot(facing_normal(c, i), origin - p0);
                REQUIRE(height > 0.0);
                farthest = std::max(farthest, height / glm::length(glm::abs(origin) + glm::abs(p0)));
            }
            CHECK(own_hits == 0);
            CHECK(farthest < 2e-5);
        }
    }
}

TEST_CASE("secondary: a scene scaled by a power of two gives the same rays, scaled") {
    const Case c = random_case(1.0f, small(256), false);
    const glm::vec3 light(3, 400, -5);
    const std::vector<Ray> bounced = diffuse(c, 5), shadowed = shadow(c, light);
    for (const int k : {-50, 50}) {
        const float scale = std::ldexp(1.0f, k);
        const Case scaled_case = random_case(scale, small(256), false);
        const std::vector<Ray> scaled = diffuse(scaled_case, 5), scaled_shadow = shadow(scaled_case, scale * light);
        for (std::size_t i = 0; i < bounced.size(); ++i) {
            CHECK(vec(scaled[i].origin) == scale * vec(bounced[i].origin));
            CHECK(vec(scaled[i].direction) == vec(bounced[i].direction));
            CHECK(vec(scaled_shadow[i].origin) == scale * vec(shadowed[i].origin));
            CHECK(vec(scaled_shadow[i].direction) == scale * vec(shadowed[i].direction));
        }
    }
}

TEST_CASE("secondary: shadow segments end at the light, which they leave out") {
    const Case c = random_case(1.0f, small(512), false);
    const glm::vec3 light(3, 400, -5);
    const std::vector<Ray> out = shadow(c, light);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const glm::dvec3 end = dvec(out[i].origin) + dvec(out[i].direction);
        // One rounding of the difference per component, of numbers below 1000.
        CHECK(glm::length(end - glm::dvec3(light)) < 1000 * 0x1p-23);
        CHECK(out[i].t_min == 0.0f);
        CHECK(out[i].t_max == std::nextafter(1.0f, 0.0f));
        CHECK(glm::dot(facing_normal(c, i), dvec(out[i].origin) - world_corner(c, c.hits[i], 0)) > 0.0);
    }
}

TEST_CASE("secondary: misses give rays that hit nothing; no rays give none; sizes must agree") {
    Case c = random_case(1.0f, 4, true);
    c.hits[1] = miss;
    for (const std::vector<Ray>& out : {diffuse(c, 1), shadow(c, glm::vec3(0, 9, 0))}) {
        CHECK(vec(out[1].direction) == glm::vec3(0.0f));
        CHECK(vec(out[0].direction) != glm::vec3(0.0f));
        CHECK(vec(out[2].direction) != glm::vec3(0.0f));
    }
    c.rays.clear();
    c.hits.clear();
    CHECK(diffuse(c, 1).empty());
    CHECK(shadow(c, glm::vec3(0)).empty());
    c.hits.push_back(miss);
    CHECK_THROWS_AS(diffuse(c, 1), InputError);
}
