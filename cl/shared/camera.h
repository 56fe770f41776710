// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_CAMERA_H
#define BOXWOOD_SHARED_CAMERA_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// A camera and the grid of its pixels. With X = 2 x + 1 - width + jitter[0] and Y = height - 2 y - 1 + jitter[1] the
/// pixel (x, y), x to the right and y down from the top left, has the offset X * right + Y * up.
typedef struct CameraRecord {
    float origin[3];
    uint perspective; ///< 1: rays go from the origin along forward + offset. 0: from origin + offset along forward.
    float forward[3]; ///< Normalised.
    uint width;       ///< Pixels, 1 to 2^23.
    float right[3];   ///< Half a pixel, on the image plane at distance 1 (perspective) or in world units.
    uint height;
    float up[3];
    float jitter[2];  ///< (-1, 1): where in its square a pixel is sampled, 0 being the centre.
    uint reserved[3]; ///< Zero.
} CameraRecord;
BOXWOOD_SHARED_SIZE(CameraRecord, 80)

BOXWOOD_SHARED_END
#endif
