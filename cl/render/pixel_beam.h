// SPDX-License-Identifier: MIT
// The beam of a pixel (Igehy 1999; dissertation 3.7.6).
#ifndef BOXWOOD_RENDER_PIXEL_BEAM_H
#define BOXWOOD_RENDER_PIXEL_BEAM_H
#include "render/shading_point.h"
#include "shared/camera.h"

/// Where the camera's ray along `direction` meets a surface at distance t, `share` of a pixel wide. The directions are between rays that are not
/// normalised, so that the image plane lies along the camera's axis.
INLINE void pixel_beam(global const CameraRecord* camera, float3 direction, float t, float share, Beam* beam) {
    float width = 2.0f * share;
    if (camera->perspective) width *= t * dot(direction, vload3(0, camera->forward));
    beam->x = width * vload3(0, camera->right);
    beam->y = width * vload3(0, camera->up);
}

#endif
