// SPDX-License-Identifier: MIT
// Rays of a scene for the commands that trace them, and how they are timed and counted.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "boxwood/trace.hpp"
#include "cli/view.hpp"

namespace boxwood::cli {

/// Which rays to trace.
struct RayChoice {
    std::string kind = "primary"; ///< primary, diffuse, shadow or near.
    View view;
    std::uint64_t seed = 1;
    Resolution resolution;
};

/// Those of the view, --resolution and --seed.
void add_ray_options(CLI::App& command, RayChoice& choice);

/// --intersector.
void add_intersector(CLI::App& command, TraceOptions& options);

/// Camera rays, those that leave their hits, or as many that leave random triangles as diffuse rays do, wherever the
/// camera looks; rays that a miss would leave empty are left out, as they would flatter the rate. They do not depend on
/// the tree, as hits do not.
Buffer<Ray> make_rays(Device& device, const Input& input, const Tree& tree, const RayChoice& choice);

/// What rays cost on average.
struct RayWork {
    double volumes_per_ray = 0.0;
    double primitives_per_ray = 0.0;
    std::uint64_t affine_rays = 0;      ///< That searched the tree of an influence area first.
    std::uint64_t answered_locally = 0; ///< Of those, that needed no other.
};

/// By a program of its own, so that counting costs a timed one nothing. Zeros for no rays.
RayWork count_work(Device& device, const Tree& tree, const Buffer<Ray>& rays, const TraceOptions& options = {});

/// 0 for no time.
double mrays_per_s(std::size_t rays, double ms);

/// Wall clock of what `work` enqueues, in milliseconds, with nothing else enqueued.
template <class Work>
double timed_ms(Device& device, const Work& work) {
    device.finish();
    const auto start = std::chrono::steady_clock::now();
    work();
    device.finish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace boxwood::cli
