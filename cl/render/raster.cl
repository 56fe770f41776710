// SPDX-License-Identifier: MIT
// Tiles drawn: the nearest triangle of every pixel.
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
typedef Triangle leaf_t;
#include "traverse/ray_triangle.h"

#if !defined(FLATTENED) || !defined(GROUP_SIZE)
#error "define FLATTENED (0 or 1) and GROUP_SIZE"
#endif

// A pixel that is the triangle's though the ray test, by rounding, finds the ray beside it, takes its point from the edge
// functions. Its distance is made this much longer, so that where the test gives the pixel to the neighbour, the neighbour keeps it.
#define BESIDE 0x1p-16f

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

/// The point of the triangle that the edge functions, `value` of each, are for.
INLINE void interpolate(const LocalRay* ray, global const Triangle* surface, const float* value, Crossing* crossing) {
    const float3 weight = fmax((float3)(fabs(value[0]), fabs(value[1]), fabs(value[2])), FLT_MIN);
    const float sum = weight.x + weight.y + weight.z;
    crossing->u = weight.y / sum;
    crossing->v = fmin(weight.z / sum, 1.0f - crossing->u);
    const float3 within = crossing->u * vload3(0, surface->edge1) + crossing->v * vload3(0, surface->edge2);
    const float3 point = vload3(0, surface->v0) + within;
    const float largest = fmax(fmax(fabs(ray->direction.x), fabs(ray->direction.y)), fabs(ray->direction.z));
    const float3 direction = ray->direction / largest;
    crossing->t = dot(point - ray->origin, direction) / dot(direction, direction) / largest * (1.0f + BESIDE);
}

/// Puts the triangle into the pixel of `ray` at offset (x, y) if it is there and nearest. Triangles come in ascending order, so
/// that of equal distances the first is kept, as in traversal.
INLINE void draw_pixel(global const ScreenTriangle* triangle, global const InstanceRecord* place, global const Ray* ray, float x,
                       float y, const float* value, global Hit* hit) {
    const float4 origin = vload4(0, ray->origin), direction = vload4(0, ray->direction);
    if (!is_valid_ray(origin, direction)) return;
    // As begin_walk and to_object_space do.
    const uint exponent = direction_exponent(direction);
    const float to_scaled = as_float(exponent << 23), scale = as_float((254u - exponent) << 23);
    LocalRay local_ray;
    make_local_ray(origin.xyz, direction.xyz * scale, &local_ray);
#if !FLATTENED
    const LocalRay world_ray = local_ray;
    to_object_space(&world_ray, place, &local_ray);
#endif
    Crossing crossing;
    if (!ray_triangle(&local_ray, &triangle->surface, -INFINITY, FLT_MAX, &crossing)) {
        if (side_shown(triangle, x, y) == 0) return;
        interpolate(&local_ray, &triangle->surface, value, &crossing);
    }
    const float t_max = fmin(fmin(direction.w, FLT_MAX) * to_scaled, FLT_MAX);
    const float t = crossing.t * scale;
    if (!(crossing.t > origin.w * to_scaled && crossing.t <= t_max && t < hit->t)) return;
    hit->t = t;
    hit->u = crossing.u;
    hit->v = crossing.v;
    hit->primitive = triangle->surface.primitive;
    hit->instance = triangle->instance;
}

/// The pixels of a triangle in the rows and columns given.
INLINE void draw_triangle(global const CameraRecord* camera, const Window* window, global const ScreenTriangle* triangle,
                          global const InstanceRecord* place, int left, int right, int top, int bottom,
                          global const Ray* rays, global Hit* hits) {
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
                draw_pixel(triangle, place, rays + pixel, x, y, value, hits + pixel);
        }
    }
}

/// hits[i] = a miss, for the `length` of the `count` of a work-item.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void clear_hits(uint count, uint length, global Hit* hits) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    const Hit miss = {INFINITY, 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
    for (ulong i = begin; i < end; ++i) hits[i] = miss;
}

/// Draws the triangles of a batch over what `hits`, one for each of `rays`, holds already of lower triangles. A work-item draws a
/// tile, so that a pixel has one writer and needs no barrier: the pairs whose key is the tile, ascending in `keys` as the
/// triangles in `values` are for equal keys.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
draw_tiles(global const CameraRecord* camera, global const InstanceRecord* instances,
           global const ScreenTriangle* triangles, global const uint* keys, global const uint* values, uint pairs, uint tiles,
           uint first_pixel, global const Ray* rays, uint pixel_count, global Hit* hits) {
    const uint tile = (uint)get_global_id(0);
    if (tile >= tiles) return;
    Window window;
    make_window(camera, first_pixel, pixel_count, &window);
    const int left = (int)(tile % window.tiles_across) * BOXWOOD_TILE;
    const int top = window.top + (int)(tile / window.tiles_across) * BOXWOOD_TILE;
    for (uint pair = lower_bound(keys, pairs, tile); pair < pairs && keys[pair] == tile; ++pair) {
        global const ScreenTriangle* triangle = triangles + values[pair];
        global const InstanceRecord* place = instances + (FLATTENED ? 0 : triangle->instance);
        draw_triangle(camera, &window, triangle, place, max(left, triangle->left),
                      min(left + BOXWOOD_TILE - 1, triangle->right), max(top, triangle->top),
                      min(top + BOXWOOD_TILE - 1, triangle->bottom), rays, hits);
    }
}
