// SPDX-License-Identifier: MIT
// Where on the image plane a pixel is sampled, in half pixels from the middle.
#ifndef BOXWOOD_RENDER_PIXEL_OFFSET_H
#define BOXWOOD_RENDER_PIXEL_OFFSET_H
#include "runtime/numerics.h"
#include "shared/camera.h"

// Odd integers below 2^24 but for the jitter: exact, and exactly opposite on opposite sides of the picture.
inline float offset_across(global const CameraRecord* camera, int x) {
    return (float)(2 * x + 1 - (int)camera->width) + camera->jitter[0];
}

inline float offset_upward(global const CameraRecord* camera, int y) {
    return (float)((int)camera->height - 2 * y - 1) + camera->jitter[1];
}

#endif
