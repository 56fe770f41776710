// SPDX-License-Identifier: MIT
// Closest hits without a tree: every ray against every triangle that is not far from its line.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "boxwood/scene.hpp"
#include "boxwood/tree_image.hpp"
#include "shared/ray.h"

namespace boxwood::test {

/// The triangles of a scene in the order that hits name them: world space for one level, object space per mesh for two.
class BruteForce {
public:
    /// `levels` is one (vertices transformed to world space in double and rounded once) or two (rays transformed by the
    /// float records of instances).
    BruteForce(const Scene& scene, Levels levels);

    /// Triangle tests that one ray takes.
    std::uint64_t tests_per_ray() const;

    /// The hit that the documentation of closest_hit promises. The arithmetic is that of the kernels in the same order,
    /// so t, u and v have the same bits where a ray meets a triangle in both.
    Hit closest_hit(const Ray& ray) const;
    /// On all cores.
    std::vector<Hit> closest_hits(std::span<const Ray> rays) const;

private:
    /// A sphere around a batch of triangles.
    struct Ball {
        glm::dvec3 middle;
        double radius;
    };
    /// Vertices as structure of arrays: three corners, each x, y, z. Padded with zero-area triangles.
    struct Soup {
        std::size_t count = 0;
        std::array<std::vector<float>, 9> columns;
        std::vector<Ball> balls; ///< Of consecutive batches; none when every ray is to meet all triangles.
    };
    struct Local;

    static std::vector<Ball> make_balls(const std::vector<std::array<glm::vec3, 3>>& triangles);
    static Soup make_soup(const std::vector<std::array<glm::vec3, 3>>& triangles);
    void search(const Local& ray, std::uint32_t instance, Hit& best) const;

    SceneSphere sphere_;
    std::vector<Soup> soups_;
    std::vector<std::uint32_t> soup_of_;  ///< Per instance.
    std::vector<InstanceRecord> records_; ///< For two levels.
};

/// Whether a triangle's vertices are on one line: exactly, for coordinates whose last bits are within 2^-60 of the
/// largest.
bool is_collinear(const std::array<glm::vec3, 3>& triangle);

/// Where the line of `ray` meets a triangle, in double precision: t, u, v. Nothing when the triangle has no area, lies
/// edge-on, or is missed. The ray's interval is not looked at.
std::optional<std::array<double, 3>> intersect_in_double(const Ray& ray, const std::array<glm::vec3, 3>& triangle);

} // namespace boxwood::test
