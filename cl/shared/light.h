// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_LIGHT_H
#define BOXWOOD_SHARED_LIGHT_H
#include "shared/types.h"

// LightRecord::kind
#define BOXWOOD_POINT_LIGHT 0u
#define BOXWOOD_SPOT_LIGHT 1u
#define BOXWOOD_DIRECTIONAL_LIGHT 2u
#define BOXWOOD_TRIANGLE_LIGHT 3u

BOXWOOD_SHARED_BEGIN

/// One light that a surface may be lit by: a punctual one, or a triangle that emits.
typedef struct LightRecord {
    float position[3]; ///< World space. Point, spot; of a triangle its first vertex.
    uint kind;
    float direction[3]; ///< Where the light goes, normalised. Spot, directional; of a triangle its front's unit normal.
    float range;        ///< Point, spot.
    float intensity
        [3];    ///< Per steradian (point, spot), irradiance (directional), radiance (triangle, before its texture).
    float area; ///< Triangle, world space.
    float edges[2][3]; ///< Triangle: from the first vertex to the others, world space.
    float cone_scale;  ///< Spot: intensity times clamp(cosine * scale + offset)^2, as KHR_lights_punctual has it.
    float cone_offset;
    uint instance;  ///< Triangle: index into Scene::instances.
    uint primitive; ///< Triangle: index within its mesh.
    uint two_sided; ///< Triangle.
    float clearance; ///< Triangle: what takes a point clear of it (render/surface.h: surface_clearance).
} LightRecord;
BOXWOOD_SHARED_SIZE(LightRecord, 96)

BOXWOOD_SHARED_END
#endif
