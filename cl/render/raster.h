// SPDX-License-Identifier: MIT
// Triangles on the screen as three edge functions in homogeneous coordinates (Olano and Greer 1997): those that cross
// the plane of the eye need no clipping.
#ifndef BOXWOOD_RENDER_RASTER_H
#define BOXWOOD_RENDER_RASTER_H
#include "render/pixel_offset.h"
#include "runtime/products.h"
#include "shared/raster.h"

// Pixels are looked at when they are this close outside of an edge, relative to the magnitudes that meet in its
// function, so that no pixel is left out that the ray test, which rounds in its own way, gives to the triangle: eight
// times the rounding of the function (3u for its coefficients, 2u for its value, u = 2^-24) and of the corners (3u).
#define EDGE_SLACK 0x1p-18f
// The corners' own roundings and those of the ray test, 8u of what meets in the products of a function's coefficients:
// they cancel where a triangle is seen nearly edge-on, such as a floor close under the eye.
#define CORNER_SLACK 0x1p-21f

/// a b - c d, off by at most 1.5 units in the last place, so that its sign is exact (Kahan; Jeannerod et al. 2013).
inline float difference_of_products(float a, float b, float c, float d) {
    const float product = c * d;
    return fma(a, b, -product) - fma(c, d, -product);
}

/// The pixels that are drawn: rows top to bottom of a picture `width` across, from number `first` on.
typedef struct Window {
    uint first, count;
    int width, top, bottom; ///< Rows, both ends included.
    int tiles_across;
} Window;

INLINE void make_window(global const CameraRecord* camera, uint first, uint count, Window* window) {
    window->first = first;
    window->count = count;
    window->width = (int)camera->width;
    window->top = (int)(first / camera->width);
    window->bottom = (int)((first + (count - 1)) / camera->width);
    window->tiles_across = (window->width + BOXWOOD_TILE - 1) / BOXWOOD_TILE;
}

/// The camera's axes as what points are measured by: dot products give half pixels, and depth.
typedef struct Eye {
    float3 origin, right, up, forward;
    bool perspective;
} Eye;

INLINE float3 measuring_axis(float3 axis) {
    const float largest = fmax(fmax(fabs(axis.x), fabs(axis.y)), fabs(axis.z));
    const float3 scaled = axis / largest;
    return scaled / dot_float3(scaled, scaled) / largest;
}

INLINE void make_eye(global const CameraRecord* camera, Eye* eye) {
    eye->origin = vload3(0, camera->origin);
    eye->right = measuring_axis(vload3(0, camera->right));
    eye->up = measuring_axis(vload3(0, camera->up));
    eye->forward = vload3(0, camera->forward);
    eye->perspective = camera->perspective != 0;
}

INLINE float along(float3 v, float3 axis) { return fma(v.x, axis.x, fma(v.y, axis.y, v.z * axis.z)); }

/// A vertex placed by `rows` as the eye sees it. The origins are subtracted first, which far from the world's origin
/// keeps what is left. A vertex gives the same in every triangle.
INLINE float3 seen_from(const Eye* eye, global const float* rows, float3 p) {
    const float3 from_eye =
        (float3)(fma(rows[0], p.x, fma(rows[1], p.y, fma(rows[2], p.z, rows[3] - eye->origin.x))),
                 fma(rows[4], p.x, fma(rows[5], p.y, fma(rows[6], p.z, rows[7] - eye->origin.y))),
                 fma(rows[8], p.x, fma(rows[9], p.y, fma(rows[10], p.z, rows[11] - eye->origin.z))));
    return (float3)(along(from_eye, eye->right), along(from_eye, eye->up), along(from_eye, eye->forward));
}

/// The least and the greatest of a / w, that is the offsets at which corners in front of the eye are seen.
INLINE void bound_ratio(float a, float b, float c, float wa, float wb, float wc, float* low, float* high) {
    const float ra = a / wa, rb = b / wb, rc = c / wc;
    *low = LESSER(LESSER(ra, rb), rc);
    *high = GREATER(GREATER(ra, rb), rc);
}

/// All of the triangle beyond the line that goes through the eye and `limit`.
INLINE bool all_beyond(float limit, float a, float b, float c, float wa, float wb, float wc) {
    const float margin = EDGE_SLACK * fabs(limit);
    return a > limit * wa + margin * fabs(wa) && b > limit * wb + margin * fabs(wb) &&
           c > limit * wc + margin * fabs(wc);
}

/// The pixels from *first to *last of `count` whose offsets 2 i + 1 - count + jitter are from `low` to `high`, or a
/// little outside.
INLINE void pixels_between(float low, float high, int count, float jitter, int* first, int* last) {
    const float middle = (float)(count - 1) - jitter, margin = 2.0f * EDGE_SLACK * (float)count;
    const float most = (float)count;
    *first = (int)ceil(LESSER(GREATER(0.5f * (low + middle - margin), 0.0f), most));
    *last = (int)floor(LESSER(GREATER(0.5f * (high + middle + margin), -1.0f), most - 1.0f));
}

/// Fills corners and bounds from what seen_from says of the vertices. False for a triangle that no pixel shows.
INLINE bool place_on_screen(global const CameraRecord* camera, const Window* window, const float3* seen,
                            ScreenTriangle* triangle) {
    const float nearest = LESSER(LESSER(seen[0].z, seen[1].z), seen[2].z);
    const float farthest = GREATER(GREATER(seen[0].z, seen[1].z), seen[2].z);
    if (!(farthest > 0.0f)) return false;
    // Distances are at least depths; less far more than all roundings.
    triangle->nearest = nearest - 0x1p-10f * farthest;
    float x[3], y[3], w[3];
    for (int i = 0; i < 3; ++i) {
        x[i] = seen[i].x;
        y[i] = seen[i].y;
        w[i] = camera->perspective ? seen[i].z : 1.0f;
    }
    float low = -INFINITY, high = INFINITY, down = -INFINITY, upward = INFINITY;
    if (!camera->perspective || nearest > 0.0f) {
        bound_ratio(x[0], x[1], x[2], w[0], w[1], w[2], &low, &high);
        bound_ratio(y[0], y[1], y[2], w[0], w[1], w[2], &down, &upward);
    } else {
        const float right_end = (float)window->width + 2.0f, top_end = (float)camera->height + 2.0f;
        if (all_beyond(right_end, x[0], x[1], x[2], w[0], w[1], w[2]) ||
            all_beyond(right_end, -x[0], -x[1], -x[2], w[0], w[1], w[2]) ||
            all_beyond(top_end, y[0], y[1], y[2], w[0], w[1], w[2]) ||
            all_beyond(top_end, -y[0], -y[1], -y[2], w[0], w[1], w[2]))
            return false;
    }
    pixels_between(low, high, window->width, camera->jitter[0], &triangle->left, &triangle->right);
    // Rows count downwards, so that their offsets are those of the mirrored picture.
    pixels_between(-upward, -down, (int)camera->height, -camera->jitter[1], &triangle->top, &triangle->bottom);
    triangle->top = max(triangle->top, window->top);
    triangle->bottom = min(triangle->bottom, window->bottom);
    if (triangle->left > triangle->right || triangle->top > triangle->bottom) return false;
    float largest = 0.0f;
    for (int i = 0; i < 3; ++i) {
        largest = fmax(largest, fmax(fmax(fabs(x[i]), fabs(y[i])), fabs(w[i])));
        if (!(fabs(x[i]) <= 0x1p120f && fabs(y[i]) <= 0x1p120f && fabs(w[i]) <= 0x1p120f)) return false;
    }
    // A power of two, the largest coordinate's, so that products of two neither overflow nor, of all but nothing,
    // underflow.
    const float scale = as_float((254u - clamp(as_uint(largest) >> 23, 1u, 253u)) << 23);
    for (int i = 0; i < 3; ++i) {
        triangle->corners[i][0] = x[i] * scale;
        triangle->corners[i][1] = y[i] * scale;
        triangle->corners[i][2] = w[i] * scale;
    }
    return true;
}

/// The three edge functions e.x X + e.y Y + e.z, edge i opposite to corner i, and how far below zero each is looked at.
typedef struct Edges {
    float3 edge[3];
    float slack[3];
} Edges;

INLINE void make_edges(global const ScreenTriangle* triangle, float width, float height, Edges* edges) {
    for (int i = 0; i < 3; ++i) {
        global const float* a = triangle->corners[(i + 1) % 3];
        global const float* b = triangle->corners[(i + 2) % 3];
        const float3 edge =
            (float3)(difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
                     difference_of_products(a[0], b[1], a[1], b[0]));
        edges->edge[i] = edge;
        const float across = fabs(a[1] * b[2]) + fabs(a[2] * b[1]), upward = fabs(a[2] * b[0]) + fabs(a[0] * b[2]);
        edges->slack[i] = EDGE_SLACK * (fabs(edge.x) * width + fabs(edge.y) * height + fabs(edge.z)) +
                          CORNER_SLACK * (across * width + upward * height + fabs(a[0] * b[1]) + fabs(a[1] * b[0]));
    }
}

/// Whether the rectangle of offsets around (x, y), `reach_x` and `reach_y` to each side, may have a pixel of the
/// triangle.
INLINE bool may_touch(const Edges* edges, float x, float y, float reach_x, float reach_y) {
    bool positive = true, negative = true;
    for (int i = 0; i < 3; ++i) {
        const float3 edge = edges->edge[i];
        const float value = fma(edge.x, x, fma(edge.y, y, edge.z));
        const float reach = fabs(edge.x) * reach_x + fabs(edge.y) * reach_y + edges->slack[i];
        positive = positive && value + reach >= 0.0f;
        negative = negative && value - reach <= 0.0f;
    }
    return positive || negative;
}

#endif
