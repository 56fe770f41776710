// SPDX-License-Identifier: MIT
#include "oracles/exact_ray.hpp"

#include <limits>

namespace boxwood::test {

namespace {

using Number = __float128;
using Triple = std::array<Number, 3>;

Triple cross(const Triple& a, const Triple& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Number dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

} // namespace

ExactIntersection exact_intersection(const Ray& ray, const Corners& corners) {
    std::array<Triple, 3> p;
    Triple d;
    for (std::size_t k = 0; k < 3; ++k) {
        d[k] = ray.direction[k];
        for (std::size_t i = 0; i < 3; ++i) p[i][k] = Number{corners[i][static_cast<int>(k)]} - Number{ray.origin[k]};
    }
    const Number u = dot(d, cross(p[2], p[1])), v = dot(d, cross(p[0], p[2])), w = dot(d, cross(p[1], p[0]));
    const Number sum = u + v + w;
    ExactIntersection hit;
    if (sum == 0) return hit;
    hit.inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    Triple q, r;
    for (std::size_t k = 0; k < 3; ++k) q[k] = p[1][k] - p[0][k], r[k] = p[2][k] - p[0][k];
    const Triple normal = cross(q, r);
    hit.t = dot(normal, p[0]) / dot(normal, d);
    return hit;
}

ExactHit exact_hit(const Ray& ray, std::span<const Corners> triangles) {
    ExactHit best;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const ExactIntersection hit = exact_intersection(ray, triangles[i]);
        if (!hit.inside || !(hit.t > Number{ray.t_min}) || hit.t > Number{ray.t_max}) continue;
        if (best.t < 0 || hit.t < best.t) best = {hit.t, i};
    }
    return best;
}

} // namespace boxwood::test
