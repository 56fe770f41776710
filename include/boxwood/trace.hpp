// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "boxwood/buffer.hpp"
#include "boxwood/tree.hpp"
#include "shared/ray.h"

namespace boxwood {

/// How a ray is tested against a triangle.
enum class Intersector {
    watertight, ///< No ray passes at an edge or vertex of a closed surface, and answers do not depend on the tree.
    moeller_trumbore, ///< The test of 1997, which takes about as long; neither holds, by roundings.
};

/// The words used in options, reports and on the command line. to_intersector throws InputError listing them.
std::string_view name(Intersector intersector);
Intersector to_intersector(std::string_view word);

/// How traversal kernels are specialised.
struct TraceOptions {
    Intersector intersector = Intersector::watertight;
    bool portable_lanes = false; ///< Portable mask reduction in place of the device's own instruction.
};

/// For every ray the closest hit: the smallest t, and among equal t the lowest (instance, primitive), so that the
/// answer does not depend on the tree. One launch. `hits` has rays.size() elements.
void closest_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
                 const TraceOptions& options = {});

/// closest_hit that also counts the volumes and primitives tested, by a program of its own.
void closest_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
                 BufferView<RayStatistics> statistics, const TraceOptions& options = {});

/// For every ray 1 when it hits anything in its interval, else 0.
void any_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<std::uint32_t> hits,
             const TraceOptions& options = {});

} // namespace boxwood
