// SPDX-License-Identifier: MIT
// Where each mesh begins in the array of all triangles: meshes as segments of it.
// compile:
#include "shared/instance.h"

/// offsets[m] = first triangle of mesh m; the last entry is the number of triangles. One work-item per entry.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void mesh_offsets(global const MeshRange* meshes, global uint* offsets, uint triangles, uint count) {
    const uint m = (uint)get_global_id(0);
    if (m > count) return;
    offsets[m] = m < count ? meshes[m].first_triangle : triangles;
}
