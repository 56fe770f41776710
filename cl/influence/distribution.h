// SPDX-License-Identifier: MIT
// The distribution of rays that a builder assumes, and the probability that one of those rays meets a box.
#ifndef BOXWOOD_INFLUENCE_DISTRIBUTION_H
#define BOXWOOD_INFLUENCE_DISTRIBUTION_H
#include "influence/projected_area.h"
#include "bounds/box.h"
#include "shared/influence.h"

/// The rays of one tree: those of the areas by their shares, and the others, which come from everywhere.
typedef struct Distribution {
    global const InfluenceRecord* areas;
    uint area_count;
    float isotropic; ///< Share of the rays that follow no area: 1 less the areas' shares.
    Box root;        ///< The box of the tree, which every isotropic ray meets.
} Distribution;

/// Half the surface of the box in units of the root's largest extent.
INLINE float half_surface(float3 size) { return size.x * size.y + size.y * size.z + size.z * size.x; }

/// The probability that a ray from everywhere that meets the root meets `box`, inside it: surface over surface, in [0,
/// 1]. 1 for a root without surface.
static inline float surface_measure(const Distribution* distribution, Box box) {
    const float3 root = extent_of(distribution->root);
    const float longest = fmax(root.x, fmax(root.y, root.z));
    if (!(longest > 0.0f)) return 1.0f;
    const float whole = half_surface(root / longest);
    const float3 size = extent_of(box);
    if (!(size.x >= 0.0f && size.y >= 0.0f && size.z >= 0.0f)) return 0.0f; // empty
    return whole > 0.0f ? fmin(half_surface(size / longest) / whole, 1.0f) : 1.0f;
}

/// Sum over the areas of share * probability, culled to what their rays can meet; `shares` becomes the sum of the
/// shares.
static inline float shared_probability(const Distribution* distribution, Box box, float* shares) {
    float sum = 0.0f, all = 0.0f;
    for (uint i = 0; i < distribution->area_count; ++i) {
        const InfluenceRecord area = distribution->areas[i];
        sum += area.share * area_probability(&area, box, true);
        all += area.share;
    }
    *shares = all;
    return sum;
}

/// The probability that a ray of one of the areas meets `box`, in [0, 1]. Areas without shares count alike; without
/// areas it is surface_measure.
static inline float projected_measure(const Distribution* distribution, Box box) {
    if (distribution->area_count == 0) return surface_measure(distribution, box);
    float shares;
    const float sum = shared_probability(distribution, box, &shares);
    if (shares > 0.0f) return fmin(sum / shares, 1.0f);
    float even = 0.0f;
    for (uint i = 0; i < distribution->area_count; ++i) {
        const InfluenceRecord area = distribution->areas[i];
        even += area_probability(&area, box, true);
    }
    return fmin(even / (float)distribution->area_count, 1.0f);
}

/// The probability that a ray of the whole distribution meets `box`.
static inline float expected_measure(const Distribution* distribution, Box box) {
    float shares;
    const float sum = shared_probability(distribution, box, &shares);
    return sum + distribution->isotropic * surface_measure(distribution, box);
}

/// The rays of tree `tree`: those of the areas [area_starts[tree], area_starts[tree + 1]), all others isotropic.
static inline void rays_of_tree(global const Aabb* tree_bounds, global const InfluenceRecord* areas,
                                global const uint* area_starts, uint tree, Distribution* rays) {
    const uint first = area_starts[tree];
    rays->areas = areas + first;
    rays->area_count = area_starts[tree + 1] - first;
    rays->isotropic = 1.0f;
    for (uint i = 0; i < rays->area_count; ++i) rays->isotropic -= rays->areas[i].share;
    rays->isotropic = fmax(rays->isotropic, 0.0f);
    rays->root = load_box(tree_bounds + tree);
}

#endif
