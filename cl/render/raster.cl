// SPDX-License-Identifier: MIT
// Draws tiles: finds the nearest triangle of every pixel.
//
// FLATTENED       1: placed triangles are those of one mesh in world space; 0: of instances
// PORTABLE_LANES  see runtime/lanes.h
// GROUP_SIZE      work-items per work-group
//
// compile: FLATTENED=0 PORTABLE_LANES=0
// compile: FLATTENED=1 PORTABLE_LANES=1
#include "render/raster.h"
#include "shared/instance.h"
#include "shared/ray.h"
#define LAYOUT 2
#include "traverse/begin_ray.h"
#include "traverse/ray_triangle.h"

#if !defined(FLATTENED) || !defined(GROUP_SIZE)
#error "define FLATTENED (0 or 1) and GROUP_SIZE"
#endif

/// The first of the ascending `keys` that is not below `key`.
INLINE uint lower_bound(global const uint* keys, uint count, uint key) {
    uint low = 0, high = count;
    while (low < high) {
        const uint middle = low + (high - low) / 2;
        if (keys[middle] < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// Puts the triangle into the pixel of `ray` if it is there and nearest. Triangles come in ascending order, so that of
/// equal distances the first is kept, as in traversal.
INLINE void draw_pixel(global const ScreenTriangle* triangle, global const InstanceRecord* place,
                       const SceneSphere* sphere, global const Ray* ray, global Hit* hit) {
    LocalRay local_ray;
    Units units;
    float t_min, t_max;
    if (!begin_ray(ray, sphere, &local_ray, &units, &t_min, &t_max)) return;
#if !FLATTENED
    const LocalRay world_ray = local_ray;
    to_object_space(&world_ray, place, &local_ray);
#endif
    Shear shear;
    TriangleHit found;
    make_shear(&local_ray, &shear);
    if (!ray_triangle(&local_ray, &shear, &triangle->surface, t_min, t_max, &found)) return;
    const float t = caller_distance(ray, &units, found.t);
    if (!(t < hit->t)) return;
    hit->t = t;
    hit->u = found.u;
    hit->v = found.v;
    hit->primitive = triangle->surface.primitive;
    hit->instance = triangle->instance;
}

/// The pixels of a triangle in the rows and columns given.
INLINE void draw_triangle(global const CameraRecord* camera, const Window* window,
                          global const ScreenTriangle* triangle, global const InstanceRecord* place,
                          const SceneSphere* sphere, int left, int right, int top, int bottom, global const Ray* rays,
                          global Hit* hits) {
    Edges edges;
    make_edges(triangle, (float)window->width, (float)camera->height, &edges);
    const float3 e0 = edges.edge[0], e1 = edges.edge[1], e2 = edges.edge[2];
    const float s0 = edges.slack[0], s1 = edges.slack[1], s2 = edges.slack[2];
    for (int row = top; row <= bottom; ++row) {
        const float y = offset_upward(camera, row);
        const float row0 = fma(e0.y, y, e0.z), row1 = fma(e1.y, y, e1.z), row2 = fma(e2.y, y, e2.z);
        const long first = (long)row * window->width - window->first;
        for (int column = left; column <= right; ++column) {
            const float x = offset_across(camera, column);
            const float value[3] = {fma(e0.x, x, row0), fma(e1.x, x, row1), fma(e2.x, x, row2)};
            const bool positive = value[0] >= -s0 && value[1] >= -s1 && value[2] >= -s2;
            const bool negative = value[0] <= s0 && value[1] <= s1 && value[2] <= s2;
            if (!positive && !negative) continue;
            const long pixel = first + column;
            if (pixel >= 0 && pixel < (long)window->count && triangle->nearest < hits[pixel].t)
                draw_pixel(triangle, place, sphere, rays + pixel, hits + pixel);
        }
    }
}

/// hits[i] = a miss, for the `length` of the `count` of a work-item.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void clear_hits(uint count, uint length, global Hit* hits) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    const Hit miss = {INFINITY, 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
    for (ulong i = begin; i < end; ++i) hits[i] = miss;
}

/// Draws the triangles of a batch over what `hits`, one for each of `rays`, holds already of lower triangles. A
/// work-item draws a tile, so that a pixel has one writer and needs no barrier: the pairs whose key is the tile,
/// ascending in `keys` as the triangles in `values` are for equal keys.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void draw_tiles(global const CameraRecord* camera, global const InstanceRecord* instances,
                global const ScreenTriangle* triangles, global const uint* keys, global const uint* values, uint pairs,
                uint tiles, uint first_pixel, global const Ray* rays, uint pixel_count, SceneSphere sphere,
                global Hit* hits) {
    const uint tile = (uint)get_global_id(0);
    if (tile >= tiles) return;
    Window window;
    make_window(camera, first_pixel, pixel_count, &window);
    const int left = (int)(tile % window.tiles_across) * BOXWOOD_TILE;
    const int top = window.top + (int)(tile / window.tiles_across) * BOXWOOD_TILE;
    for (uint pair = lower_bound(keys, pairs, tile); pair < pairs && keys[pair] == tile; ++pair) {
        global const ScreenTriangle* triangle = triangles + values[pair];
        global const InstanceRecord* place = instances + (FLATTENED ? 0 : triangle->instance);
        draw_triangle(camera, &window, triangle, place, &sphere, max(left, triangle->left),
                      min(left + BOXWOOD_TILE - 1, triangle->right), max(top, triangle->top),
                      min(top + BOXWOOD_TILE - 1, triangle->bottom), rays, hits);
    }
}
