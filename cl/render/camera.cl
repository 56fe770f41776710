// SPDX-License-Identifier: MIT
// Rays through the pixels of a camera.
//
// GROUP_SIZE  work-items per work-group.
// compile:
#include "runtime/numerics.h"
#include "shared/camera.h"
#include "shared/ray.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

inline Ray pixel_ray(global const CameraRecord* camera, int x, int y) {
    // Odd integers below 2^24 but for the jitter: exact, and exactly opposite on opposite sides of the picture.
    const float across = (float)(2 * x + 1 - (int)camera->width) + camera->jitter[0];
    const float upward = (float)((int)camera->height - 2 * y - 1) + camera->jitter[1];
    const float3 offset = across * vload3(0, camera->right) + upward * vload3(0, camera->up);
    float3 origin = vload3(0, camera->origin);
    float3 direction = vload3(0, camera->forward);
    if (camera->perspective) {
        direction += offset;
        direction /= sqrt(dot(direction, direction));
    } else {
        origin += offset;
    }
    Ray ray;
    vstore3(origin, 0, ray.origin);
    ray.t_min = 0.0f;
    vstore3(direction, 0, ray.direction);
    ray.t_max = INFINITY;
    return ray;
}

/// rays[y * width + x - first] = the ray through pixel (x, y). A work-item makes `length` consecutive rays of the `count`;
/// `rays` has `count` <= width * height - first elements. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
primary_rays(global const CameraRecord* camera, uint first, uint count, uint length, global Ray* rays) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const uint pixel = first + (uint)i;
        const uint y = pixel / camera->width;
        rays[i] = pixel_ray(camera, (int)(pixel - y * camera->width), (int)y);
    }
}
