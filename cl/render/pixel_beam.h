// SPDX-License-Identifier: MIT
// The beam of a pixel (Igehy 1999; dissertation 3.7.6).
#ifndef BOXWOOD_RENDER_PIXEL_BEAM_H
#define BOXWOOD_RENDER_PIXEL_BEAM_H
#include "render/shading_point.h"
#include "shared/camera.h"

/// Where the camera's rays along `direction` meet surfaces at distances t, `fraction` of a pixel wide. The directions
/// are between rays that are not normalised, so that the image plane lies along the camera's axis.
INLINE void pixel_beam(global const CameraRecord* camera, const Vector* direction, real t, float fraction, Beam* beam) {
    real width = 2.0f * fraction;
    Vector forward;
    spread3(vload3(0, camera->forward), &forward);
    if (camera->perspective) width *= t * dot3(direction, &forward);
    spread3(vload3(0, camera->right), &beam->x);
    spread3(vload3(0, camera->up), &beam->y);
    scale3(width, &beam->x);
    scale3(width, &beam->y);
    beam->exact_light = (mask)(0);
    beam->sharp = (mask)(-1);
}

#endif
