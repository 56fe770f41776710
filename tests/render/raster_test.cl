// SPDX-License-Identifier: MIT
// Exact coverage (render/raster.h) by brute force.
// compile:
#include "render/raster.h"

/// covered[i] = how many triangles have pixel i, turns[i] = those that show it one side less those that show the other.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
coverage_test(global const CameraRecord* camera, global const ScreenTriangle* triangles, global const ulong* tiles,
              uint count, uint pixels, global uint* covered, global int* turns) {
    const uint i = (uint)get_global_id(0);
    if (i >= pixels) return;
    const int column = (int)(i % camera->width), row = (int)(i / camera->width);
    const float x = offset_across(camera, column), y = offset_upward(camera, row);
    covered[i] = 0;
    turns[i] = 0;
    for (uint k = 0; k < count; ++k) {
        global const ScreenTriangle* t = triangles + k;
        if (tiles[k] == 0 || column < t->left || column > t->right || row < t->top || row > t->bottom) continue;
        const int side = side_shown(t, x, y);
        covered[i] += side != 0;
        turns[i] += side;
    }
}

/// signs[i] = side_of_point for the 8 numbers i: x, y, a, b.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void side_test(global const float* numbers, uint count,
                                                                              global int* signs) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    float a[3], b[3];
    vstore3(vload3(0, numbers + 8 * i + 2), 0, a);
    vstore3(vload3(0, numbers + 8 * i + 5), 0, b);
    signs[i] = side_of_point(numbers[8 * i], numbers[8 * i + 1], a, b);
}
