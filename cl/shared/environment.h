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
    uint reserved[2]; ///< Zero.
} EnvironmentRecord;
BOXWOOD_SHARED_SIZE(EnvironmentRecord, 32)

BOXWOOD_SHARED_END
#endif
