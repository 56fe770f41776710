// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_RASTER_H
#define BOXWOOD_SHARED_RASTER_H
#include "shared/triangle.h"

// Pixels across a tile, and down.
#define BOXWOOD_TILE 16

BOXWOOD_SHARED_BEGIN

/// A placed triangle as the rasteriser sees it. With X and Y the offsets of a pixel (see CameraRecord), its ray is
/// where the three determinants of ((X, Y, 1), corner j, corner k) have the same sign, in front of the eye or behind
/// it.
typedef struct ScreenTriangle {
    Triangle surface; ///< For the ray test, in the space that rays are tested in; `primitive` is that of hits.
    /// Homogeneous, in half pixels: corner (x, y, w) is seen at X = x / w, Y = y / w. All times one power of two.
    float corners[3][3];
    uint instance; ///< Of hits.
    float nearest; ///< No point of it that a ray meets is as near as this.
    int left;      ///< The pixels that it may cover, both ends included.
    int right;
    int top;
    int bottom;
} ScreenTriangle;
BOXWOOD_SHARED_SIZE(ScreenTriangle, 108)

BOXWOOD_SHARED_END
#endif
