// SPDX-License-Identifier: MIT
// Rotations on arrays of quaternions and matrices, structures of arrays: component k of element i is at k * count + i.
// `count` is a multiple of LANES. Macros: LANES.
// compile: LANES=1
// compile: LANES=8
#include "bounds/rotation.h"

static void load_vector(global const float* in, uint count, uint at, Vector* v) {
    v->x = LOAD_LANES(in + at);
    v->y = LOAD_LANES(in + count + at);
    v->z = LOAD_LANES(in + 2 * count + at);
}

static void load_rows(global const float* in, uint count, uint at, Frame* frame) {
    load_vector(in, count, at, &frame->a);
    load_vector(in + 3 * count, count, at, &frame->b);
    load_vector(in + 6 * count, count, at, &frame->c);
}

static void load_quaternion(global const float* in, uint count, uint at, Quaternion* q) {
    q->x = LOAD_LANES(in + at);
    q->y = LOAD_LANES(in + count + at);
    q->z = LOAD_LANES(in + 2 * count + at);
    q->w = LOAD_LANES(in + 3 * count + at);
}

static void store_quaternion(const Quaternion* q, global float* out, uint count, uint at) {
    STORE_LANES(q->x, out + at);
    STORE_LANES(q->y, out + count + at);
    STORE_LANES(q->z, out + 2 * count + at);
    STORE_LANES(q->w, out + 3 * count + at);
}

/// Frames to quaternions.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void quaternion_test(global const float* frames,
                                                                                    global float* quaternions,
                                                                                    uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Frame frame;
    Quaternion q;
    load_rows(frames, count, at, &frame);
    quaternion_of(&frame, &q);
    store_quaternion(&q, quaternions, count, at);
}

/// Unit quaternions to frames.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void frame_test(global const float* quaternions,
                                                                               global float* frames, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Quaternion q;
    Frame frame;
    load_quaternion(quaternions, count, at, &q);
    frame_of(&q, &frame);
    const Vector rows[3] = {frame.a, frame.b, frame.c};
    for (uint k = 0; k < 3; ++k) {
        STORE_LANES(rows[k].x, frames + (3 * k) * count + at);
        STORE_LANES(rows[k].y, frames + (3 * k + 1) * count + at);
        STORE_LANES(rows[k].z, frames + (3 * k + 2) * count + at);
    }
}

/// Half-way rotations between boxes.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void blend_test(global const float* first,
                                                                               global const float* second,
                                                                               global float* blended, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Quaternion p, q, result;
    load_quaternion(first, count, at, &p);
    load_quaternion(second, count, at, &q);
    blend_rotations(&p, &q, &result);
    store_quaternion(&result, blended, count, at);
}

/// Rotations of matrices given by columns; `rotations` holds where to start.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void extract_test(global const float* matrices,
                                                                                 global float* rotations, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Frame matrix;
    Quaternion q;
    load_rows(matrices, count, at, &matrix);
    load_quaternion(rotations, count, at, &q);
    extract_rotation(&matrix, &q);
    store_quaternion(&q, rotations, count, at);
}
