// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_INFLUENCE_H
#define BOXWOOD_SHARED_INFLUENCE_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// An influence area as the device sees it. Rays run along its lines either way: shadow rays run towards a light. A
/// point p has the coordinates x, y, z = dot(p - origin, right | up | forward). Plane: rays leave the rectangle |x| <=
/// half_width, |y| <= half_height, z = 0 along forward; the region is the box over it up to z = far. Point: rays leave
/// the rectangle |x| <= near * half_width, |y| <= near * half_height, z = near in the direction from the origin; the
/// region is the frustum |x| <= z * half_width, |y| <= z * half_height, near <= z <= far.
typedef struct InfluenceRecord {
    float origin[3];  ///< Plane: centre of the rectangle. Point: the eye.
    uint point;       ///< 1: point area; 0: plane area.
    float right[3];   ///< right, up and forward are orthonormal.
    float half_width; ///< Plane: half extent. Point: tangent of half the horizontal field of view.
    float up[3];
    float half_height;
    float forward[3];
    float near; ///< 0 for plane areas.
    float far;  ///< Above near.
    /// Sine of the largest angle, up to 90 degrees, between an affine ray and the area's through its origin.
    float sin_tolerance;
    float share;   ///< Of all rays: those that follow this area, in [0, 1].
    uint reserved; ///< Zero.
} InfluenceRecord;
BOXWOOD_SHARED_SIZE(InfluenceRecord, 80)

BOXWOOD_SHARED_END
#endif
