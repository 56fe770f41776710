// SPDX-License-Identifier: MIT
#include "boxwood/trace.hpp"
#include "traverse/specialise.hpp"

namespace boxwood {

void any_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<std::uint32_t> hits,
             const TraceOptions& options) {
    if (tree.empty()) return fill(device, hits, 0u);
    launch_traversal(device, traversal_kernel(tree, Query::any, options), "any hit", tree, rays, hits);
}

} // namespace boxwood
