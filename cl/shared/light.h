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
    /// Per steradian (point, spot), irradiance (directional), or radiance before its texture (triangle).
    float intensity[3];
    float inverse_size; ///< Triangle: 1 / sqrt(area), world space.
    float edges[2][3];  ///< Triangle: from the first vertex to the others, world space.
    // Spot: intensity times clamp((1 - scale^2 (1 - cosine)) * edge, 0, 1)^2, as KHR_lights_punctual has it, written so
    // that narrow cones lose no digits.
    float cone_scale; ///< 1 / sqrt(1 - cos outer).
    float cone_edge;  ///< 1 / (1 - (1 - cos inner) / (1 - cos outer)).
    uint instance;    ///< Triangle: index into Scene::instances.
    uint primitive;   ///< Triangle: index within its mesh.
    uint two_sided;   ///< Triangle.
    float clearance;  ///< Triangle: what takes a point clear of it (render/surface.h: surface_clearance).
} LightRecord;
BOXWOOD_SHARED_SIZE(LightRecord, 96)

/// A node of the tree over lights: what those below it may send to a place.
typedef struct LightNode {
    float center[3];     ///< World space.
    float radius;        ///< Of a sphere that holds the lights.
    float axis[3];       ///< Unit vector: they shine within a cone about it, and from there on as the cosine.
    float amplitude;     ///< Root of the intensity along the axis, or, when distant, of the irradiance; 0: no light.
    float spread_cosine; ///< Of the angle from the axis to the cone's edge,
    float spread_sine;   ///< and its sine.
    uint distant;        ///< 1: directional lights alone, which send the same everywhere.
    uint children[2];    ///< Indices of nodes; of a leaf twice its own.
    uint parent;         ///< Index of a node; of the root its own, 0.
    uint reserved[2];    ///< Zero.
} LightNode;
BOXWOOD_SHARED_SIZE(LightNode, 64)

BOXWOOD_SHARED_END
#endif
