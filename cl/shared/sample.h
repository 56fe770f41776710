// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_SAMPLE_H
#define BOXWOOD_SHARED_SAMPLE_H
#include "types.h"

BOXWOOD_SHARED_BEGIN

/// Which sample of a picture a launch computes, and for which of its pixels.
typedef struct SampleSettings {
    ulong seed;
    uint sample;  ///< Its number, below `samples`.
    uint samples; ///< That the picture will have.
    uint depth;   ///< Most bounces.
    uint first_pixel;
} SampleSettings;
BOXWOOD_SHARED_SIZE(SampleSettings, 24)

BOXWOOD_SHARED_END
#endif
