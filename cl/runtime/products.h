// SPDX-License-Identifier: MIT
// Products, lengths and mixtures of OpenCL's vectors, with every operation rounded as written: for dot(), cross(),
// length(), normalize() and mix() the standard leaves the order of operations and their contraction to the device.
#ifndef BOXWOOD_RUNTIME_PRODUCTS_H
#define BOXWOOD_RUNTIME_PRODUCTS_H
#include "runtime/inline.h"
#include "runtime/numerics.h"

INLINE float dot_float2(float2 p, float2 q) { return p.x * q.x + p.y * q.y; }

INLINE float dot_float3(float3 p, float3 q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

INLINE float3 cross_float3(float3 p, float3 q) { return p.yzx * q.zxy - p.zxy * q.yzx; }

/// No overflow or underflow of squares.
INLINE float length_float3(float3 v) {
    const float largest = fmax(fmax(fabs(v.x), fabs(v.y)), fabs(v.z));
    if (!(largest > 0.0f)) return largest;
    v /= largest;
    return largest * sqrt(dot_float3(v, v));
}

/// (1 - part) from + part to.
INLINE float4 mix_float4(float4 from, float4 to, float part) { return from + (to - from) * part; }

#endif
