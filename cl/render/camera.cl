// SPDX-License-Identifier: MIT
// Rays through the pixels of a camera.
//
// GROUP_SIZE  work-items per work-group.
// compile:
#include "render/pixel_offset.h"
#include "runtime/products.h"
#include "shared/ray.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

inline Ray pixel_ray(global const CameraRecord* camera, int x, int y) {
    const float3 offset =
        offset_across(camera, x) * vload3(0, camera->right) + offset_upward(camera, y) * vload3(0, camera->up);
    float3 origin = vload3(0, camera->origin);
    float3 direction = vload3(0, camera->forward);
    if (camera->perspective) {
        direction += offset;
        direction /= sqrt(dot_float3(direction, direction));
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

/// rays[y * width + x - first] = the ray through pixel (x, y). A work-item makes `length` consecutive rays of the
/// `count`; `rays` has `count` <= width * height - first elements. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void primary_rays(global const CameraRecord* camera, uint first, uint count, uint length, global Ray* rays) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const uint pixel = first + (uint)i;
        const uint y = pixel / camera->width;
        rays[i] = pixel_ray(camera, (int)(pixel - y * camera->width), (int)y);
    }
}
