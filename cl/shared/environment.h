// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_ENVIRONMENT_H
#define BOXWOOD_SHARED_ENVIRONMENT_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// Light from infinitely far away as the device sees it: the same everywhere, or a picture (see Environment).
typedef struct EnvironmentRecord {
    float radiance[3]; ///< Without a picture.
    uint width;        ///< 0: no picture.
    uint height;
    float irradiance; ///< From the half of all directions that a surface sees, in the mean.
    // Where surfaces draw directions, too, those of a picture are drawn by what is brighter than its mean (MIS
    // compensation).
    float floor; ///< The mean luminance.
    float irradiance_above_floor;
    float turn; ///< Of the picture, in turns about +y; in [0, 1).
} EnvironmentRecord;
BOXWOOD_SHARED_SIZE(EnvironmentRecord, 36)

BOXWOOD_SHARED_END
#endif
