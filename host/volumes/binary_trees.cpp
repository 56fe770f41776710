// SPDX-License-Identifier: MIT
#include "volumes/binary_trees.hpp"

#include "boxwood/reduce.hpp"
#include "boxwood/segmented_reduce.hpp"

namespace boxwood {

Buffer<Aabb> bounds_of_trees(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets) {
    const std::size_t trees = offsets.size() - 1;
    Buffer<Aabb> bounds = make_scratch<Aabb>(device, trees, "bounds of trees");
    if (trees == 1)
        reduce(device, boxes, Operator::sum, bounds);
    else
        segmented_reduce(device, boxes, offsets, Operator::sum, bounds);
    return bounds;
}

} // namespace boxwood
