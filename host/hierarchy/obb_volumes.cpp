// SPDX-License-Identifier: MIT
#include "boxwood/volumes.hpp"

#include "runtime/launch.hpp"

namespace boxwood {

namespace {

Buffer<Obb> aligned(Device& device, BufferView<const Aabb> aabbs) {
    Buffer<Obb> boxes = make_scratch<Obb>(device, aabbs.size(), "oriented boxes of nodes");
    launch(device, {"hierarchy/obb_volumes.cl", "aligned_boxes"}, "aligned boxes", aabbs.size(), aabbs, boxes,
           static_cast<std::uint32_t>(aabbs.size()));
    return boxes;
}

} // namespace

Buffer<Obb> obb_volumes(Device& device, const Topology&, BufferView<const Aabb> aabbs, const Geometry&,
                        const BoundsOptions&) {
    return aligned(device, aabbs);
}

Buffer<Obb> obb_volumes(Device& device, const Topology&, BufferView<const Aabb> aabbs,
                        BufferView<const InstanceRecord>, BufferView<const Obb>, const BoundsOptions&) {
    return aligned(device, aabbs);
}

} // namespace boxwood
