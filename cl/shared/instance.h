// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_INSTANCE_H
#define BOXWOOD_SHARED_INSTANCE_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// One placed mesh as the device sees it. Matrices are affine, 3 rows of 4, row-major: p' = M[r][0..2] . p + M[r][3].
typedef struct InstanceRecord {
    /// World to object. Rays take its linear part, after the translation of to_world is subtracted.
    float to_object[12];
    float to_world[12]; ///< Object to world.
    uint mesh;          ///< Index into Scene::meshes.
    uint root;          ///< Root node of the mesh's bottom-level tree.
    uint reserved[2];   ///< Zero.
} InstanceRecord;
BOXWOOD_SHARED_SIZE(InstanceRecord, 112)

/// Where a mesh lies in the concatenated arrays of all meshes.
typedef struct MeshRange {
    uint first_vertex;
    uint vertex_count;
    uint first_triangle;
    uint triangle_count;
} MeshRange;
BOXWOOD_SHARED_SIZE(MeshRange, 16)

BOXWOOD_SHARED_END
#endif
