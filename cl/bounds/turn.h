// SPDX-License-Identifier: MIT
// Finds a box of small surface area around a few points by rotating a frame about one of its axes at a time.
#ifndef BOXWOOD_BOUNDS_TURN_H
#define BOXWOOD_BOUNDS_TURN_H
#include "bounds/eigen.h"
#include "bounds/segment.h"

// Most points: both ways along 14 directions.
#define EXTREMES 28

constant char directions[3 * EXTREMES / 2] = {1, 0, 0, 0, 1, 0,  0, 0, 1, 1, 1, 0,  1, -1, 0, 1,  0, 1, 1,  0, -1,
                                              0, 1, 1, 0, 1, -1, 1, 1, 1, 1, 1, -1, 1, -1, 1, -1, 1, 1, -1, 1, 1};

/// Direction `index` < 14: the axes of the world, the diagonals of its squares and of its cube (that of index 13
/// twice). Any octant of a frame, however turned, holds one of them or its opposite, so the corners of a cube are all
/// found: they are at most 27.5 degrees apart from every direction, and an octant holds a cone of 35.3.
INLINE void direction(uint index, Vector* d) {
    d->x = (float)directions[3 * index];
    d->y = (float)directions[3 * index + 1];
    d->z = (float)directions[3 * index + 2];
}

INLINE void ends_of(const Vector* points, int count, const Frame* axes, Slabs* ends) {
    empty_slabs(ends);
    for (int i = 0; i < count; ++i) add_point(axes, &points[i], ends);
}

/// The point after `here` on the hull of points in the plane, clockwise seen from inside: the others lie to one side of
/// the line through both. Points closer than SAME count as the same. -1 where there is no other.
#define SAME 0x1p-18f
static int next_on_hull(const float* x, const float* y, int count, int here) {
    int next = -1;
    float u = 0.0f, v = 0.0f;
    for (int i = 0; i < count; ++i) {
        const float to_x = x[i] - x[here], to_y = y[i] - y[here];
        if (!(fmax(fabs(to_x), fabs(to_y)) > SAME)) continue;
        if (next >= 0 && !(fma(u, to_y, -(v * to_x)) < 0.0f)) continue;
        next = i;
        u = to_x;
        v = to_y;
    }
    return next;
}

/// Turns the frame about its third axis so that the box around the points has the smallest surface area. An edge of
/// their hull in the plane of the first two axes then lies on the box (Freeman and Shapira 1975), so those are tried,
/// at most as many as there are points. O(count^2).
static void turn_about_third(const Vector* points, int count, Frame* axes, float* area) {
    float x[EXTREMES], y[EXTREMES];
    float low = INFINITY, high = -INFINITY;
    int first = 0;
    for (int i = 0; i < count; ++i) {
        x[i] = dot3(&axes->a, &points[i]);
        y[i] = dot3(&axes->b, &points[i]);
        const float z = dot3(&axes->c, &points[i]);
        widen(z, z, &low, &high);
        if (x[i] < x[first]) first = i;
    }
    const float height = high - low;
    float best_x = 1.0f, best_y = 0.0f;
    int here = first;
    for (int step = 0; step < count; ++step) {
        const int next = next_on_hull(x, y, count, here);
        if (next < 0) break;
        float u = x[next] - x[here], v = y[next] - y[here];
        const float factor = 1.0f / sqrt(fma(u, u, v * v));
        u *= factor;
        v *= factor;
        float from = INFINITY, to = -INFINITY, across_from = INFINITY, across_to = -INFINITY;
        for (int k = 0; k < count; ++k) {
            const float along_edge = fma(u, x[k], v * y[k]), across = fma(u, y[k], -(v * x[k]));
            widen(along_edge, along_edge, &from, &to);
            widen(across, across, &across_from, &across_to);
        }
        const float width = to - from, depth = across_to - across_from;
        const float found = fma(width, depth, height * (width + depth));
        if (found < *area) {
            *area = found;
            best_x = u;
            best_y = v;
        }
        here = next;
        if (here == first) break;
    }
    const Vector old = axes->a;
    scale3(best_x, &axes->a);
    add_scaled3(best_y, &axes->b, &axes->a);
    scale3(best_x, &axes->b);
    add_scaled3(-best_y, &old, &axes->b);
    orthonormalise(axes);
}

/// The smallest frame that turning reaches from `start`, if it is smaller than `best`.
static void turn_from(const Vector* points, int count, Frame start, Frame* best, float* best_area) {
    Slabs ends;
    ends_of(points, count, &start, &ends);
    float area = half_area(&ends);
    for (int turn = 0, idle = 0; turn < 9 && idle < 3; ++turn) { // up to three about each axis
        const float before = area;
        turn_about_third(points, count, &start, &area);
        idle = area < before ? 0 : idle + 1;
        const Frame next = {start.b, start.c, start.a};
        start = next;
    }
    ends_of(points, count, &start, &ends);
    area = half_area(&ends);
    if (area < *best_area) {
        *best_area = area;
        *best = start;
    }
}

/// A frame with `axis` for its third, if that has a length; else it is left as it is.
static bool frame_about(Vector axis, Frame* frame) {
    const float size = largest3(&axis);
    if (!(size > 0.0f)) return false;
    scale3(1.0f / size, &axis);
    normalise3(&axis);
    // Perpendicular to it, by way of the coordinate in which it is smallest.
    const float x = fabs(axis.x), y = fabs(axis.y), z = fabs(axis.z);
    const Vector other = {x <= y && x <= z ? 1.0f : 0.0f, y < x && y <= z ? 1.0f : 0.0f, z < x && z < y ? 1.0f : 0.0f};
    frame->c = axis;
    cross3(&axis, &other, &frame->a);
    normalise3(&frame->a);
    cross3(&frame->c, &frame->a, &frame->b);
    const Vector third = frame->c;
    orthonormalise(frame);
    frame->c = third;
    return true;
}

static void between(const Vector* p, const Vector* q, Vector* d) {
    d->x = q->x - p->x;
    d->y = q->y - p->y;
    d->z = q->z - p->z;
}

/// The four corners of a large tetrahedron, as DiTO takes them: the two points farthest apart, the one farthest from
/// the line through them, and the one farthest from the plane of the three. Equal ones where the points are flat.
static void large_tetrahedron(const Vector* points, int count, Vector* corners) {
    int p = 0, q = 0;
    float farthest = 0.0f;
    Vector edge, side, normal;
    for (int i = 0; i < count; ++i)
        for (int j = i + 1; j < count; ++j) {
            between(&points[i], &points[j], &edge);
            const float distance = dot3(&edge, &edge);
            if (distance > farthest) {
                farthest = distance;
                p = i;
                q = j;
            }
        }
    corners[0] = points[p];
    corners[1] = corners[2] = corners[3] = points[q];
    between(&corners[0], &corners[1], &edge);
    farthest = 0.0f;
    for (int i = 0; i < count; ++i) {
        between(&corners[0], &points[i], &side);
        cross3(&edge, &side, &normal);
        const float distance = dot3(&normal, &normal);
        if (distance > farthest) {
            farthest = distance;
            corners[2] = points[i];
        }
    }
    between(&corners[0], &corners[2], &side);
    cross3(&edge, &side, &normal);
    farthest = 0.0f;
    for (int i = 0; i < count; ++i) {
        between(&corners[0], &points[i], &side);
        const float distance = fabs(dot3(&normal, &side));
        if (distance > farthest) {
            farthest = distance;
            corners[3] = points[i];
        }
    }
}

/// `axes`, or a frame that makes a smaller box around the points: the best that turning finds from `axes`, from the
/// world's axes, and from those about the edges, the normal and the pairs of opposite edges of a large tetrahedron.
static void smallest_frame(const Vector* points, int count, Frame* axes) {
    Slabs ends;
    ends_of(points, count, axes, &ends);
    float area = half_area(&ends);
    Frame start = *axes;
    turn_from(points, count, start, axes, &area);
    identity_frame(&start);
    turn_from(points, count, start, axes, &area);

    Vector corners[4], candidates[7], other;
    large_tetrahedron(points, count, corners);
    for (int k = 0; k < 3; ++k) {
        // An edge of the base, and the normal of it and the edge opposite.
        between(&corners[k], &corners[(k + 1) % 3], &candidates[k]);
        between(&corners[(k + 2) % 3], &corners[3], &other);
        cross3(&candidates[k], &other, &candidates[3 + k]);
    }
    cross3(&candidates[0], &candidates[1], &candidates[6]);
    for (int k = 0; k < 7; ++k)
        if (frame_about(candidates[k], &start)) turn_from(points, count, start, axes, &area);
}

#endif
