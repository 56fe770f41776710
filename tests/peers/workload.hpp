// SPDX-License-Identifier: MIT
// What both sides are measured on: one mesh and three batches of rays.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"
#include "boxwood/tree.hpp"
#include "shared/ray.h"

namespace boxwood::peers {

/// Wall-clock milliseconds of one call.
template <class Work>
double milliseconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The scene of a glTF file, or of a procedural kind of that name, flattened to one mesh.
Scene load_flat(const std::string& name);

/// A batch of rays with its name in the report. Rays that hit nothing by definition are left out.
struct Batch {
    std::string name;
    std::vector<Ray> rays;
};

/// primary: 1024 x 1024 from the scene's first camera, or the default one; bounce: cosine-distributed, from their hits;
/// shadow: from their hits to the default light.
std::vector<Batch> make_batches(Device& device, const Scene& flat, const Tree& tree);

} // namespace boxwood::peers
