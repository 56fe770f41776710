// SPDX-License-Identifier: MIT
#include "oracles/brute_force.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "oracles/reference_builder.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define BOXWOOD_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define BOXWOOD_CLONES
#endif

namespace boxwood::test {

/// A ray in the space of the triangles it is tested against.
struct BruteForce::Local {
    float o[3];
    float d[3];
    float t_min;
};

namespace {

constexpr std::size_t block = 128;
/// More triangles than these are skipped by blocks that are far from a ray.
constexpr std::size_t many = 512;

struct Point {
    float t, u, v;
};

/// What cl/traverse/ray_triangle.h computes; t = infinity where the triangle is missed.
template <class Ray>
inline Point cross(const Ray& ray, float v0x, float v0y, float v0z, float ax, float ay, float az, float bx, float by,
                   float bz) {
    const float cx = v0x - ray.o[0], cy = v0y - ray.o[1], cz = v0z - ray.o[2];
    const float nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const float* d = ray.d;
    const float determinant = __builtin_fmaf(d[0], nx, __builtin_fmaf(d[1], ny, d[2] * nz));
    const float sx = __builtin_fmaf(cy, d[2], -(cz * d[1]));
    const float sy = __builtin_fmaf(cz, d[0], -(cx * d[2]));
    const float sz = __builtin_fmaf(cx, d[1], -(cy * d[0]));
    const float sign = determinant < 0.0f ? -1.0f : 1.0f;
    const float u = sign * __builtin_fmaf(bx, sx, __builtin_fmaf(by, sy, bz * sz));
    const float v = -sign * __builtin_fmaf(ax, sx, __builtin_fmaf(ay, sy, az * sz));
    const float size = std::fabs(determinant);
    const float inverse = 1.0f / determinant;
    const float t = __builtin_fmaf(cx, nx * inverse, __builtin_fmaf(cy, ny * inverse, cz * (nz * inverse)));
    const bool inside = bool(int(u >= 0.0f) & int(v >= 0.0f) & int(u + v <= size) & int(size > 0.0f));
    return {inside ? t : std::numeric_limits<float>::infinity(), u * std::fabs(inverse), v * std::fabs(inverse)};
}

struct Plain {
    float o[3];
    float d[3];
};

/// Whether no part of the ray up to `limit` comes near the ball: within one and a half times its radius and 2^-12 of its
/// distance, where roundings of a crossing are some 2^-20 of the distances. False for what is no number.
bool is_far(const glm::dvec3& to_middle, double radius, const glm::dvec3& direction, double limit) {
    const double square = glm::dot(direction, direction), along = glm::dot(to_middle, direction);
    const double distance = glm::dot(to_middle, to_middle), reach = 1.5 * radius + 0x1p-12 * std::sqrt(distance);
    const double slack = reach * std::sqrt(square);
    return distance * square - along * along > slack * slack || along < -slack || along - slack > limit * square;
}

} // namespace

/// t of `block` triangles from `first` on; returns how many are in (t_min, limit].
BOXWOOD_CLONES int crossings(const std::array<const float*, 9>& columns, const float* origin, const float* direction,
                             float t_min, float limit, float* __restrict t);

BOXWOOD_CLONES int crossings(const std::array<const float*, 9>& columns, const float* origin, const float* direction,
                             float t_min, float limit, float* __restrict t) {
    const Plain ray{{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}};
    const float *a = columns[0], *b = columns[1], *c = columns[2], *d = columns[3], *e = columns[4], *f = columns[5],
                *g = columns[6], *h = columns[7], *k = columns[8];
    int count = 0;
    for (std::size_t i = 0; i < block; ++i) {
        t[i] = cross(ray, a[i], b[i], c[i], d[i], e[i], f[i], g[i], h[i], k[i]).t;
        count += int(t[i] > t_min) & int(t[i] <= limit);
    }
    return count;
}

/// Around the middle of each block's box.
std::vector<BruteForce::Ball> BruteForce::make_balls(const std::vector<std::array<glm::vec3, 3>>& triangles) {
    std::vector<Ball> balls;
    for (std::size_t first = 0; first < triangles.size(); first += block) {
        const std::size_t end = std::min(first + block, triangles.size());
        glm::dvec3 low = triangles[first][0], high = low;
        for (std::size_t i = first; i < end; ++i)
            for (const glm::vec3& p : triangles[i])
                low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
        balls.push_back({0.5 * (low + high), 0.5 * glm::length(high - low)});
    }
    return balls;
}

BruteForce::Soup BruteForce::make_soup(const std::vector<std::array<glm::vec3, 3>>& triangles) {
    Soup soup;
    soup.count = triangles.size();
    const std::size_t padded = (triangles.size() + block - 1) / block * block;
    for (auto& column : soup.columns) column.assign(padded, 0.0f);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& [v0, v1, v2] = triangles[i];
        const glm::vec3 rows[3] = {v0, v1 - v0, v2 - v0};
        for (int row = 0; row < 3; ++row)
            for (int axis = 0; axis < 3; ++axis)
                soup.columns[static_cast<std::size_t>(3 * row + axis)][i] = rows[row][axis];
    }
    if (soup.count > many) soup.balls = make_balls(triangles);
    return soup;
}

BruteForce::BruteForce(const Scene& scene, Levels levels) {
    if (levels == Levels::two) {
        for (const Mesh& mesh : scene.meshes) soups_.push_back(make_soup(corners(mesh)));
        records_ = reference_records(scene);
        for (const Instance& instance : scene.instances) soup_of_.push_back(instance.mesh);
        return;
    }
    for (const Instance& instance : scene.instances) {
        soup_of_.push_back(static_cast<std::uint32_t>(soups_.size()));
        soups_.push_back(make_soup(world_corners(scene, instance)));
    }
}

std::uint64_t BruteForce::tests_per_ray() const {
    std::uint64_t tests = 0;
    for (const std::uint32_t soup : soup_of_) tests += soups_[soup].count;
    return tests;
}

void BruteForce::search(const Local& ray, std::uint32_t instance, Hit& best) const {
    const Soup& soup = soups_[soup_of_[instance]];
    const glm::dvec3 origin(ray.o[0], ray.o[1], ray.o[2]), direction(ray.d[0], ray.d[1], ray.d[2]);
    std::array<float, block> t;
    for (std::size_t first = 0; first < soup.count; first += block) {
        if (!soup.balls.empty()) {
            const Ball& ball = soup.balls[first / block];
            if (is_far(ball.middle - origin, ball.radius, direction, double{best.t})) continue;
        }
        std::array<const float*, 9> columns;
        for (std::size_t i = 0; i < 9; ++i) columns[i] = soup.columns[i].data() + first;
        const float limit = std::min(best.t, std::numeric_limits<float>::max());
        if (crossings(columns, ray.o, ray.d, ray.t_min, limit, t.data()) == 0) continue;
        for (std::size_t i = 0; i < block; ++i) {
            // The first of equal distances is the lowest (instance, primitive).
            if (!(t[i] > ray.t_min && t[i] <= limit && (t[i] < best.t || best.primitive == BOXWOOD_NONE))) continue;
            const auto& c = columns;
            const Point p = cross(ray, c[0][i], c[1][i], c[2][i], c[3][i], c[4][i], c[5][i], c[6][i], c[7][i], c[8][i]);
            best = {p.t, p.u, p.v, static_cast<std::uint32_t>(first + i), instance};
        }
    }
}

Hit BruteForce::closest_hit(const Ray& ray) const {
    const Hit miss{std::numeric_limits<float>::infinity(), 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
    bool valid = ray.t_min >= 0.0f && ray.t_min <= ray.t_max && std::isfinite(ray.t_min);
    for (int axis = 0; axis < 3; ++axis)
        valid = valid && std::isfinite(ray.origin[axis]) && std::isfinite(ray.direction[axis]);
    if (!valid || (ray.direction[0] == 0 && ray.direction[1] == 0 && ray.direction[2] == 0)) return miss;

    Hit best = miss;
    best.t = ray.t_max;
    const float(&o)[3] = ray.origin;
    const float(&d)[3] = ray.direction;
    for (std::uint32_t instance = 0; instance < soup_of_.size(); ++instance) {
        Local local{{o[0], o[1], o[2]}, {d[0], d[1], d[2]}, ray.t_min};
        if (!records_.empty()) {
            for (int row = 0; row < 3; ++row) {
                const float* m = &records_[instance].to_object[4 * row];
                local.o[row] = std::fma(m[0], o[0], std::fma(m[1], o[1], std::fma(m[2], o[2], m[3])));
                local.d[row] = std::fma(m[0], d[0], std::fma(m[1], d[1], m[2] * d[2]));
            }
        }
        search(local, instance, best);
    }
    return best.primitive == BOXWOOD_NONE ? miss : best;
}

std::vector<Hit> BruteForce::closest_hits(std::span<const Ray> rays) const {
    std::vector<Hit> hits(rays.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < rays.size(); i = next++) hits[i] = closest_hit(rays[i]);
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
    work();
    threads.clear();
    return hits;
}

std::optional<std::array<double, 3>> intersect_in_double(const Ray& ray, const std::array<glm::vec3, 3>& triangle) {
    const glm::dvec3 origin(ray.origin[0], ray.origin[1], ray.origin[2]);
    const glm::dvec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
    const glm::dvec3 v0 = triangle[0];
    const glm::dvec3 edge1 = glm::dvec3(triangle[1]) - v0;
    const glm::dvec3 edge2 = glm::dvec3(triangle[2]) - v0;
    const glm::dvec3 p = glm::cross(direction, edge2);
    const double determinant = glm::dot(edge1, p);
    if (determinant == 0.0) return std::nullopt;
    const glm::dvec3 from_v0 = origin - v0;
    const glm::dvec3 q = glm::cross(from_v0, edge1);
    const double u = glm::dot(from_v0, p) / determinant;
    const double v = glm::dot(direction, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
    return std::array<double, 3>{glm::dot(edge2, q) / determinant, u, v};
}

} // namespace boxwood::test
