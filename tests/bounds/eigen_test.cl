// SPDX-License-Identifier: MIT
// Eigenvectors and moments on arrays of records (bounds/lanes_of.h). Macros: LANES.
// compile: LANES=1
// compile: LANES=8
#include "bounds/eigen.h"
#include "bounds/lanes_of.h"
#include "bounds/moments.h"

/// Matrices xx, yy, zz, xy, xz, yz to the rows of frames.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void eigen_test(global const float* matrices, global float* frames, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    real v[6];
    load_components(matrices, count, at, v, 6);
    const Symmetric matrix = {v[0], v[1], v[2], v[3], v[4], v[5]};
    Frame frame;
    eigenvectors(&matrix, &frame);
    store_rows(&frame, frames, count, at);
}

#define POINTS 8

static void moments_of_point(const real* p, Moments* m) {
    const Moments point = {{p[0], p[1], p[2]}, {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}};
    *m = point;
}

/// From sets of POINTS points of equal weight, a reference and a factor: mean less the reference and covariance, after
/// the points were merged one by one about the first point (first 9 results), and in pairs, moved to the reference and
/// scaled by the factor (the other 9).
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void moments_test(global const float* sets, global float* results, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    real v[3 * POINTS + 4];
    load_components(sets, count, at, v, 3 * POINTS + 4);
    const Vector first = {v[0], v[1], v[2]};
    for (int k = 0; k < POINTS; ++k) {
        v[3 * k] -= first.x;
        v[3 * k + 1] -= first.y;
        v[3 * k + 2] -= first.z;
    }
    Moments one_by_one, pairs[POINTS];
    moments_of_point(v, &one_by_one);
    for (int k = 0; k < POINTS; ++k) {
        moments_of_point(v + 3 * k, &pairs[k]);
        if (k > 0) merge_moments((real)(1.0f / (float)(k + 1)), &pairs[k], &one_by_one);
    }
    for (int step = 1; step < POINTS; step *= 2)
        for (int k = 0; k < POINTS; k += 2 * step) merge_moments((real)(0.5f), &pairs[k + step], &pairs[k]);
    const real factor = v[3 * POINTS + 3];
    const Vector shift = {(first.x - v[3 * POINTS]) * factor, (first.y - v[3 * POINTS + 1]) * factor,
                          (first.z - v[3 * POINTS + 2]) * factor};
    move_moments(factor, &shift, &pairs[0]);
    for (int k = 0; k < 2; ++k) {
        const Moments* m = k == 0 ? &one_by_one : &pairs[0];
        const real values[9] = {m->mean.x,        m->mean.y,        m->mean.z,
                                m->covariance.xx, m->covariance.yy, m->covariance.zz,
                                m->covariance.xy, m->covariance.xz, m->covariance.yz};
        store_components(values, results + 9 * k * count, count, at, 9);
    }
}
