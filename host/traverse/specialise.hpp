// SPDX-License-Identifier: MIT
// Which traversal program a tree and a query need, and how its rays are cut.
#pragma once

#include "boxwood/trace.hpp"
#include "layout/tree_arrays.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

/// What is asked of each ray.
enum class Query { closest, closest_with_statistics, any };

/// At least `needed` entries of a traversal stack: 64 times a power of 8, so that scenes share programs. Throws
/// CapacityError for more than 2 MiB a ray.
std::uint32_t stack_entries(std::uint64_t needed);

/// Stack entries that a traversal of `tree` never exceeds (proof in cl/traverse/traversal_state.h).
std::uint32_t stack_size(const Tree& tree);

/// The kernel for a query on a tree that is not empty.
KernelRef traversal_kernel(const Tree& tree, Query query, const TraceOptions& options);

/// Rays per work-item: those of the device's tuning, but short enough that uneven rays leave no work-item behind.
Slices cut_rays(const Device& device, std::size_t count);

/// Launches a traversal kernel for `rays` on a tree that is not empty: its first parameters are TREE_PARAMETERS
/// (cl/traverse/traversal.h) and the rays, the others `arguments`.
template <class... Arguments>
void launch_traversal(Device& device, const KernelRef& kernel, const char* label, const Tree& tree,
                      BufferView<const Ray> rays, Arguments&&... arguments) {
    const Slices slices = cut_rays(device, rays.size());
    const TreeArrays& arrays = tree.arrays();
    visit_layout(arrays, [&](const auto& bottom, const auto& top) {
        launch(device, kernel, label, slices.slices, bottom.nodes, bottom.leaves, top.nodes, arrays.instances,
               arrays.areas, arrays.area_nodes, arrays.area_items, arrays.sphere, rays,
               static_cast<std::uint32_t>(rays.size()), slices.length, arguments...);
    });
}

} // namespace boxwood
