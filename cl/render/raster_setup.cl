// SPDX-License-Identifier: MIT
// Projects triangles to the screen and lists the pairs of a tile and a triangle.
//
// FLATTENED   1: placed triangles are those of one mesh in world space; 0: of instances
// GROUP_SIZE  work-items per work-group
//
// compile: FLATTENED=0
// compile: FLATTENED=1
#include "bounds/collinear.h"
#include "primitives/segments.h"
#include "render/raster.h"
#include "shared/instance.h"

#if !defined(FLATTENED) || !defined(GROUP_SIZE)
#error "define FLATTENED (0 or 1) and GROUP_SIZE"
#endif

/// The tiles that the triangle may have pixels in: their number, and unless `keys` is null the keys themselves.
INLINE uint tiles_of(global const CameraRecord* camera, const Window* window, global const ScreenTriangle* triangle,
                     global uint* keys) {
    const int left = triangle->left / BOXWOOD_TILE, right = triangle->right / BOXWOOD_TILE;
    const int top = (triangle->top - window->top) / BOXWOOD_TILE,
              bottom = (triangle->bottom - window->top) / BOXWOOD_TILE;
    uint count = 0;
    Edges edges;
    const bool one = left == right && top == bottom;
    if (!one) make_edges(triangle, (float)window->width, (float)camera->height, &edges);
    for (int row = top; row <= bottom; ++row)
        for (int column = left; column <= right; ++column) {
            const float reach = (float)(BOXWOOD_TILE - 1);
            const float x = offset_across(camera, column * BOXWOOD_TILE) + reach;
            const float y = offset_upward(camera, window->top + row * BOXWOOD_TILE) - reach;
            if (!one && !may_touch(&edges, x, y, reach, reach)) continue;
            if (keys != 0) keys[count] = (uint)(row * window->tiles_across + column);
            ++count;
        }
    return count;
}

/// out[i] = placed triangle first_placed + i, and tiles[i] the number of its tiles, for the `count` of a batch; out[i]
/// is undefined where that is 0, and tiles[count] is 0. Placed triangles count through the instances, first_triangles
/// of them before each. A work-item takes `length` consecutive ones; no barrier, work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void setup_triangles(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                     global const InstanceRecord* instances, global const uint* first_triangles, uint instance_count,
                     global const CameraRecord* camera, uint first_pixel, uint pixel_count, uint first_placed,
                     uint count, uint length, global ScreenTriangle* out, global ulong* tiles) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    if (begin >= end) return;
    if (end == count) tiles[count] = 0;
    Window window;
    make_window(camera, first_pixel, pixel_count, &window);
    Eye eye;
    make_eye(camera, &eye);
    uint instance = segment_of(first_triangles, instance_count, first_placed + (uint)begin);
    for (ulong i = begin; i < end; ++i) {
        const uint placed = first_placed + (uint)i;
        while (placed >= first_triangles[instance + 1]) ++instance;
        const uint primitive = placed - first_triangles[instance];
        global const InstanceRecord* place = instances + (FLATTENED ? 0 : instance);
        const uint3 corner = vload3(FLATTENED ? placed : meshes[place->mesh].first_triangle + primitive, triangles);
        float3 v0 = vload3(corner.x, positions);
        float3 v1 = vload3(corner.y, positions);
        float3 v2 = vload3(corner.z, positions);
        const float3 seen[3] = {seen_from(&eye, place->to_world, v0), seen_from(&eye, place->to_world, v1),
                                seen_from(&eye, place->to_world, v2)};
        ScreenTriangle triangle;
        tiles[i] = 0;
        if (!place_on_screen(camera, &window, seen, &triangle)) continue;
        mark_collinear(&v0, &v1, &v2);
        vstore3(v0, 0, triangle.surface.v0);
        vstore3(v1, 0, triangle.surface.v1);
        vstore3(v2, 0, triangle.surface.v2);
        triangle.surface.primitive = primitive;
        triangle.surface.reserved1 = triangle.surface.reserved2 = 0;
        triangle.instance = instance;
        out[i] = triangle;
        tiles[i] = tiles_of(camera, &window, out + i, 0);
    }
}

/// The pairs of the `count` triangles, from offsets[i] on for triangle i: keys are tiles, values triangles.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void list_tiles(global const CameraRecord* camera, uint first_pixel, uint pixel_count,
                global const ScreenTriangle* triangles, global const ulong* offsets, uint count, uint length,
                global uint* keys, global uint* values) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    Window window;
    make_window(camera, first_pixel, pixel_count, &window);
    for (ulong i = begin; i < end; ++i) {
        if (offsets[i] == offsets[i + 1]) continue;
        tiles_of(camera, &window, triangles + i, keys + offsets[i]);
        for (ulong pair = offsets[i]; pair < offsets[i + 1]; ++pair) values[pair] = (uint)i;
    }
}
