// SPDX-License-Identifier: MIT
// Rotations on arrays of quaternions and matrices (bounds/lanes_of.h). Macros: LANES.
// compile: LANES=1
// compile: LANES=8
#include "bounds/lanes_of.h"
#include "bounds/rotation.h"

static void load_quaternion(global const float* in, uint count, uint at, Quaternion* q) {
    real v[4];
    load_components(in, count, at, v, 4);
    const Quaternion loaded = {v[0], v[1], v[2], v[3]};
    *q = loaded;
}

static void store_quaternion(const Quaternion* q, global float* out, uint count, uint at) {
    const real v[4] = {q->x, q->y, q->z, q->w};
    store_components(v, out, count, at, 4);
}

/// Frames to quaternions.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void quaternion_test(global const float* frames, global float* quaternions, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Frame frame;
    Quaternion q;
    load_rows(frames, count, at, &frame);
    quaternion_of(&frame, &q);
    store_quaternion(&q, quaternions, count, at);
}

/// Unit quaternions to frames.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void frame_test(global const float* quaternions, global float* frames, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Quaternion q;
    Frame frame;
    load_quaternion(quaternions, count, at, &q);
    frame_of(&q, &frame);
    store_rows(&frame, frames, count, at);
}

/// Half-way rotations between boxes.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void blend_test(global const float* first, global const float* second, global float* blended, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Quaternion p, q, result;
    load_quaternion(first, count, at, &p);
    load_quaternion(second, count, at, &q);
    blend_rotations(&p, &q, &result);
    store_quaternion(&result, blended, count, at);
}

/// Rotations of matrices given by columns; `rotations` holds where to start.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void extract_test(global const float* matrices, global float* rotations, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Frame matrix;
    Quaternion q;
    load_rows(matrices, count, at, &matrix);
    load_quaternion(rotations, count, at, &q);
    extract_rotation(&matrix, &q);
    store_quaternion(&q, rotations, count, at);
}
