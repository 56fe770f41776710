// SPDX-License-Identifier: MIT
#include "oracles/brute_force.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
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

/// A ray in the space of the triangles it is tested against: what the documentation of cl/traverse promises, in other
/// words.
struct BruteForce::Local {
    glm::vec3 o, d;
    float t_min;
    std::array<std::size_t, 3> axis; ///< The last is that along which the ray is fastest.
    glm::vec3 slope;                 ///< The direction by those axes, scaled.
    float scale, depth;

    /// `magnification` is the power of two of lengths.
    Local(const glm::vec3& origin, const glm::vec3& direction, int magnification, float first);
};

namespace {

constexpr std::size_t batch = 128;
/// More triangles than these are skipped by batches that are far from a ray.
constexpr std::size_t many = 512;

float largest(const glm::vec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

/// floor(log2 x) of what float stores as normal, -126 below.
int power(float x) { return x < 0x1p-126f ? -126 : std::ilogb(x); }

float limited_power(int exponent) { return std::ldexp(1.0f, std::clamp(exponent, -126, 126)); }

/// One triangle in a batch: nine columns, and the ray.
struct Point {
    float t, u, v;
};

/// p q - r s by Kahan.
inline float difference(float p, float q, float r, float s) {
    const float product = r * s;
    return __builtin_fmaf(p, q, -product) - __builtin_fmaf(r, s, -product);
}

inline float least(float a, float b) { return a < b ? a : b; }
inline float most(float a, float b) { return a > b ? a : b; }

/// What of a ray a crossing needs, in plain numbers for the compiler to make vectors of.
struct Plain {
    float ox, oy, oz, dx, dy, dz, scale, depth;
};

/// Where a ray hits a triangle whose corners have the coordinates ax, ay, az (z last, see Local::axis) ...; t =
/// infinity where it does not.
inline Point cross(const Plain& ray, float ax, float ay, float az, float bx, float by, float bz, float cx, float cy,
                   float cz) {
    const float z0 = az - ray.oz, z1 = bz - ray.oz, z2 = cz - ray.oz;
    const float x0 = __builtin_fmaf(ax - ray.ox, ray.dz, -(z0 * ray.dx));
    const float x1 = __builtin_fmaf(bx - ray.ox, ray.dz, -(z1 * ray.dx));
    const float x2 = __builtin_fmaf(cx - ray.ox, ray.dz, -(z2 * ray.dx));
    const float y0 = __builtin_fmaf(ay - ray.oy, ray.dz, -(z0 * ray.dy));
    const float y1 = __builtin_fmaf(by - ray.oy, ray.dz, -(z1 * ray.dy));
    const float y2 = __builtin_fmaf(cy - ray.oy, ray.dz, -(z2 * ray.dy));
    const float u = difference(x2, y1, y2, x1), v = difference(x0, y2, y0, x2), w = difference(x1, y0, y1, x0);
    const float sum = u + v + w;
    const bool front = bool(int(u >= 0) & int(v >= 0) & int(w >= 0));
    const bool back = bool(int(u <= 0) & int(v <= 0) & int(w <= 0));
    const bool inside = bool((int(front) | int(back)) & int(std::fabs(sum) >= 0x1p-60f));
    const float d0 = z0 * ray.scale, d1 = z1 * ray.scale, d2 = z2 * ray.scale;
    const float end = least(least(d0, d1), d2) * sum, start = most(most(d0, d1), d2) * sum;
    const float weighted = __builtin_fmaf(d0, sum, __builtin_fmaf(v, d1 - d0, w * (d2 - d0)));
    const float within = least(most(weighted, least(end, start)), most(end, start));
    const float inverse = 1.0f / sum;
    return {inside ? within / (sum * ray.depth) : std::numeric_limits<float>::infinity(), v * inverse, w * inverse};
}

/// Whether no part of the ray up to `limit` comes near the ball: within one and a half times its radius and 2^-12 of
/// its distance, where roundings of a crossing are some 2^-20 of the distances. False for what is no number.
bool is_far(const glm::dvec3& to_middle, double radius, const glm::dvec3& direction, double limit) {
    const double square = glm::dot(direction, direction), along = glm::dot(to_middle, direction);
    const double distance = glm::dot(to_middle, to_middle), reach = 1.5 * radius + 0x1p-12 * std::sqrt(distance);
    const double slack = reach * std::sqrt(square);
    return distance * square - along * along > slack * slack || along < -slack || along - slack > limit * square;
}

/// The sum of two numbers as two.
struct Pair {
    float high, low;
};

Pair sum_of(float a, float b) {
    const float high = a + b, part = high - a;
    return {high, (a - (high - part)) + (b - part)};
}

Pair step_on(const Pair& from, float step, float direction) {
    const float product = step * direction;
    const Pair sum = sum_of(from.high, product);
    return sum_of(sum.high, from.low + (sum.low + std::fma(step, direction, -product)));
}

bool is_outside(const glm::vec3& p, const SceneSphere& sphere) {
    return largest(p - glm::vec3(sphere.center[0], sphere.center[1], sphere.center[2])) > 8.0f * sphere.radius;
}

/// Moves the origin of a ray from far away to two radii or more before the sphere. False when it misses it.
bool approach(glm::vec3& origin, const glm::vec3& d, const SceneSphere& sphere, Pair& way) {
    std::array<Pair, 3> p = {{{origin.x, 0}, {origin.y, 0}, {origin.z, 0}}};
    const float square = std::fma(d.x, d.x, std::fma(d.y, d.y, d.z * d.z));
    for (int i = 0; i < 16; ++i) {
        const glm::vec3 to(sphere.center[0] - p[0].high, sphere.center[1] - p[1].high, sphere.center[2] - p[2].high);
        const float whole = std::fma(to.x, d.x, std::fma(to.y, d.y, to.z * d.z)) / square - 2.0f * sphere.radius;
        const float step = std::bit_cast<float>(std::bit_cast<std::uint32_t>(whole) & 0xffff8000u);
        if (i == 0 && !(step >= 0.0f)) return false;
        if (std::fabs(step) <= 0.25f * sphere.radius) break;
        for (int axis = 0; axis < 3; ++axis)
            p[static_cast<std::size_t>(axis)] = step_on(p[static_cast<std::size_t>(axis)], step, d[axis]);
        way = step_on(way, step, 1.0f);
    }
    origin = {p[0].high, p[1].high, p[2].high};
    return !is_outside(origin, sphere);
}

} // namespace

bool is_collinear(const std::array<glm::vec3, 3>& triangle) {
    const auto area = [&](int i, int j) {
        __float128 sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 &p = triangle[k], &q = triangle[(k + 1) % 3];
            sum += __float128{p[i]} * q[j] - __float128{p[j]} * q[i];
        }
        return sum;
    };
    return area(0, 1) == 0 && area(1, 2) == 0 && area(2, 0) == 0;
}

BruteForce::Local::Local(const glm::vec3& origin, const glm::vec3& direction, int magnification, float first)
    : o(origin), d(direction), t_min(first) {
    const glm::vec3 size = glm::abs(d);
    const std::size_t z = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
    axis = {(z + 1) % 3, (z + 2) % 3, z};
    scale = limited_power(magnification);
    const float unit = std::ldexp(1.0f, -std::min(power(largest(d)), 126));
    for (int k = 0; k < 3; ++k) slope[k] = d[static_cast<int>(axis[static_cast<std::size_t>(k)])] * unit * scale;
    depth = d[static_cast<int>(z)] * scale;
}

/// t of `batch` triangles from `first` on; returns how many are in (t_min, limit].
BOXWOOD_CLONES int count_hits(const std::array<const float*, 9>& columns, const Plain& plain, float t_min, float limit,
                              float* __restrict t);

BOXWOOD_CLONES int count_hits(const std::array<const float*, 9>& columns, const Plain& plain, float t_min, float limit,
                              float* __restrict t) {
    const Plain ray = plain;
    const float *a = columns[0], *b = columns[1], *c = columns[2], *d = columns[3], *e = columns[4], *f = columns[5],
                *g = columns[6], *h = columns[7], *k = columns[8];
    int count = 0;
    for (std::size_t i = 0; i < batch; ++i) {
        t[i] = cross(ray, a[i], b[i], c[i], d[i], e[i], f[i], g[i], h[i], k[i]).t;
        count += int(t[i] > t_min) & int(t[i] <= limit);
    }
    return count;
}

/// Around the middle of each batch's box.
std::vector<BruteForce::Ball> BruteForce::make_balls(const std::vector<std::array<glm::vec3, 3>>& triangles) {
    std::vector<Ball> balls;
    for (std::size_t first = 0; first < triangles.size(); first += batch) {
        const std::size_t end = std::min(first + batch, triangles.size());
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
    const std::size_t padded = (triangles.size() + batch - 1) / batch * batch;
    for (auto& column : soup.columns) column.assign(padded, 0.0f);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& [v0, v1, v2] = triangles[i];
        const bool flat = is_collinear(triangles[i]);
        const glm::vec3 rows[3] = {v0, flat ? v0 : v1, flat ? v0 : v2};
        for (int row = 0; row < 3; ++row)
            for (int axis = 0; axis < 3; ++axis)
                soup.columns[static_cast<std::size_t>(3 * row + axis)][i] = rows[row][axis];
    }
    if (soup.count > many) soup.balls = make_balls(triangles);
    return soup;
}

BruteForce::BruteForce(const Scene& scene, Levels levels) : sphere_(scene_sphere(scene)) {
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
    const glm::dvec3 origin(ray.o), direction(ray.d);
    const auto& o = ray.o;
    const auto [x, y, z] = ray.axis;
    const auto at = [](const glm::vec3& v, std::size_t i) { return v[static_cast<int>(i)]; };
    const Plain plain{at(o, x), at(o, y), at(o, z), ray.slope.x, ray.slope.y, ray.slope.z, ray.scale, ray.depth};
    std::array<float, batch> t;
    for (std::size_t first = 0; first < soup.count; first += batch) {
        if (!soup.balls.empty()) {
            const Ball& ball = soup.balls[first / batch];
            if (is_far(ball.middle - origin, ball.radius, direction, double{best.t})) continue;
        }
        std::array<const float*, 9> c;
        for (std::size_t i = 0; i < 9; ++i) c[i] = soup.columns[i / 3 * 3 + ray.axis[i % 3]].data() + first;
        const float limit = std::min(best.t, std::numeric_limits<float>::max());
        if (count_hits(c, plain, ray.t_min, limit, t.data()) == 0) continue;
        for (std::size_t i = 0; i < batch; ++i) {
            // The first of equal distances is the lowest (instance, primitive).
            if (!(t[i] > ray.t_min && t[i] <= limit && (t[i] < best.t || best.primitive == BOXWOOD_NONE))) continue;
            const Point p =
                cross(plain, c[0][i], c[1][i], c[2][i], c[3][i], c[4][i], c[5][i], c[6][i], c[7][i], c[8][i]);
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

    const int size = sphere_.radius < 0x1p-126f ? -127 : std::ilogb(sphere_.radius);
    glm::vec3 origin(ray.origin[0], ray.origin[1], ray.origin[2]);
    glm::vec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
    const int length = power(largest(direction)),
              unit = std::clamp(std::clamp(size, -60, 60), length - 126, length + 126);
    const int scale = length - unit;
    float t_min = std::ldexp(std::fabs(ray.t_min), scale);
    float t_max = std::min(std::ldexp(std::min(ray.t_max, std::numeric_limits<float>::max()), scale),
                           std::numeric_limits<float>::max());
    Pair way{0, 0};
    if (is_outside(origin, sphere_)) {
        if (!approach(origin, direction * std::ldexp(1.0f, -std::min(length, 126)), sphere_, way)) return miss;
        way.high = std::ldexp(way.high, -unit), way.low = std::ldexp(way.low, -unit);
        t_min = std::max((t_min - way.high) - way.low, 0.0f);
        t_max = (t_max - way.high) - way.low;
        if (!(t_max >= 0.0f)) return miss;
    }
    direction *= std::ldexp(1.0f, -scale);
    Hit best = miss;
    best.t = t_max;
    const Local world(origin, direction, 30 - size, t_min);
    for (std::uint32_t instance = 0; instance < soup_of_.size(); ++instance) {
        if (records_.empty()) {
            search(world, instance, best);
            continue;
        }
        glm::vec3 o, d;
        const float* place = records_[instance].to_world;
        const glm::vec3 p = world.o - glm::vec3(place[3], place[7], place[11]), &q = world.d;
        float growth = 0.0f;
        for (int row = 0; row < 3; ++row) {
            const float* m = &records_[instance].to_object[4 * row];
            o[row] = std::fma(m[0], p.x, std::fma(m[1], p.y, m[2] * p.z));
            d[row] = std::fma(m[0], q.x, std::fma(m[1], q.y, m[2] * q.z));
            growth = std::max(growth, largest({m[0], m[1], m[2]}));
        }
        search(Local(o, d, 30 - size - power(growth), t_min), instance, best);
    }
    if (best.primitive == BOXWOOD_NONE) return miss;
    const float t = std::ldexp(way.high + (way.low + best.t), -scale);
    best.t = std::min(std::max(t, std::nextafter(std::fabs(ray.t_min), miss.t)), ray.t_max);
    return best;
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
