// SPDX-License-Identifier: MIT
// The `binary` layout with oriented boxes: as collapse_binary.cl, with the volumes of OrientedNode.
// TRIANGLE_LEAVES: see layout/children.h.
// compile: TRIANGLE_LEAVES=1
// compile: TRIANGLE_LEAVES=0
#include "runtime/numerics.h"
#include "layout/children.h"
#include "shared/node.h"
#include "shared/obb.h"

/// Writes one slot of a node and returns its reference. Nothing is an empty aligned box.
inline uint write_child(uint child, global const Aabb* volumes, global const Obb* boxes, global const uint* order,
                        uint count, global float* volume) {
    if (child != BOXWOOD_NONE && boxes[child].aligned == 0) {
        for (int k = 0; k < 3; ++k) {
            volume[k] = boxes[child].center[k];
            volume[3 + k] = boxes[child].extent[k];
            for (int row = 0; row < 3; ++row) volume[6 + 3 * k + row] = boxes[child].axes[3 * row + k];
        }
        return reference_to(child, order, count);
    }
    for (int k = 0; k < 3; ++k) {
        volume[k] = child == BOXWOOD_NONE ? INFINITY : volumes[child].min[k];
        volume[3 + k] = child == BOXWOOD_NONE ? -INFINITY : volumes[child].max[k];
    }
    for (int k = 6; k < 15; ++k) volume[k] = 0.0f;
    return child == BOXWOOD_NONE ? BOXWOOD_NONE : BOXWOOD_ALIGNED | reference_to(child, order, count);
}

/// nodes[i] for every slot of every tree; one that nothing refers to is an empty node.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void oriented_nodes(global const Aabb* volumes, global const Obb* boxes, global const uint2* children,
                    global const uint* parents, global const uint* order, global OrientedNode* nodes, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const uint2 below = children_of(i, children, parents, count);
    nodes[i].child[0] = write_child(below.x, volumes, boxes, order, count, nodes[i].volume[0]);
    nodes[i].child[1] = write_child(below.y, volumes, boxes, order, count, nodes[i].volume[1]);
}
