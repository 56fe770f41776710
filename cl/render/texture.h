// SPDX-License-Identifier: MIT
// Textures, filtered over the footprint of a beam (dissertation 3.7.6).
//
// WIDE_TEXELS  1 where some texture has 16 bits
// FILTER  0 nearest texel, without levels of detail; 1 trilinear: the level whose texels are as wide as the footprint's
//         longer axis, as for the cone of Akenine-Moller et al. 2019; 2 anisotropic: up to 16 trilinear taps along that
//         axis, of the level for the shorter one (after McCormack et al. 1999); as 1 where it need not be sharp
#ifndef BOXWOOD_RENDER_TEXTURE_H
#define BOXWOOD_RENDER_TEXTURE_H
#include "render/elementary.h"
#include "render/srgb.h"
#include "runtime/products.h"
#include "shared/material.h"

#if !defined(FILTER) || FILTER < 0 || FILTER > 2
#error "define FILTER (0 nearest, 1 trilinear, 2 anisotropic)"
#endif
#if !defined(WIDE_TEXELS)
#error "define WIDE_TEXELS (1 where some texture has 16 bits)"
#endif

#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define MOST_TAPS 16

/// Linear colour and alpha of a texel of bytes.
inline float4 decode_bytes(uint texel, uint format) {
    const uchar4 bytes = as_uchar4(texel);
    if (format & BOXWOOD_SRGB)
        return (float4)(srgb_to_linear[bytes.x], srgb_to_linear[bytes.y], srgb_to_linear[bytes.z],
                        (float)bytes.w / 255.0f);
    return convert_float4(bytes) / 255.0f;
}

#if WIDE_TEXELS
/// Likewise of 16 bits.
inline float4 decode_wide(uint2 texel, uint format) {
    const uint4 codes = (uint4)(texel.x & 0xffffu, texel.x >> 16, texel.y & 0xffffu, texel.y >> 16);
    if (format & BOXWOOD_SRGB)
        return (float4)(wide_srgb_to_linear(codes.x), wide_srgb_to_linear(codes.y), wide_srgb_to_linear(codes.z),
                        (float)codes.w / 65535.0f);
    return convert_float4(codes) / 65535.0f;
}
#endif

/// A texture coordinate brought to [0, 1]. The remainders are exact but for tiny negative coordinates, which give 1;
/// what is not finite gives 0.
inline float wrap_coordinate(float x, uint wrap) {
    if (wrap == WRAP_REPEAT) {
        x -= floor(x);
    } else if (wrap == WRAP_MIRROR) {
        x -= 2.0f * floor(0.5f * x);
        x = x > 1.0f ? 2.0f - x : x;
    } else {
        x = clamp(x, 0.0f, 1.0f);
    }
    return x >= 0.0f && x <= 1.0f ? x : 0.0f;
}

inline float2 wrap_coordinates(global const TextureRecord* texture, float2 uv) {
    return (float2)(wrap_coordinate(uv.x, texture->wrap_u), wrap_coordinate(uv.y, texture->wrap_v));
}

/// One level of detail.
typedef struct Level {
    global const uint* texels;
    int width, height;
    uint format;
} Level;

/// A texel of a level, linear, by its number in rows.
inline float4 read_texel(const Level* level, size_t number) {
#if WIDE_TEXELS
    if (level->format & BOXWOOD_WIDE) return decode_wide(vload2(number, level->texels), level->format);
#endif
    return decode_bytes(level->texels[number], level->format);
}

inline void find_level(global const TextureRecord* texture, global const uint* texels, uint number, Level* level) {
    uint width = texture->width, height = texture->height;
    size_t first = texture->first_texel;
#if WIDE_TEXELS
    const uint words = texture->format & BOXWOOD_WIDE ? 2u : 1u;
#else
    const uint words = 1;
#endif
    for (; number != 0; --number) {
        first += (size_t)width * height * words;
        width = max(width >> 1, 1u);
        height = max(height >> 1, 1u);
    }
    level->texels = texels + first;
    level->width = (int)width;
    level->height = (int)height;
    level->format = texture->format;
}

/// The texel at `uv`, in [0, 1].
inline float4 nearest_texel(const Level* level, float2 uv) {
    const int x = min((int)(uv.x * (float)level->width), level->width - 1);
    const int y = min((int)(uv.y * (float)level->height), level->height - 1);
    return read_texel(level, (size_t)y * level->width + x);
}

#if FILTER
/// The place of column or row i, of n, in -1 .. n. Beyond the edge of a mirrored picture is the same texel again.
inline int wrap_index(int i, int n, uint wrap) {
    if (i < 0) return wrap == WRAP_REPEAT ? n - 1 : 0;
    if (i >= n) return wrap == WRAP_REPEAT ? 0 : n - 1;
    return i;
}

/// The four texels around `uv`, in [0, 1], weighted.
inline float4 bilinear(global const TextureRecord* texture, const Level* level, float2 uv) {
    const float x = uv.x * (float)level->width - 0.5f, y = uv.y * (float)level->height - 0.5f;
    const float left = floor(x), top = floor(y);
    const int x0 = wrap_index((int)left, level->width, texture->wrap_u);
    const int x1 = wrap_index((int)left + 1, level->width, texture->wrap_u);
    const size_t row0 = (size_t)wrap_index((int)top, level->height, texture->wrap_v) * level->width;
    const size_t row1 = (size_t)wrap_index((int)top + 1, level->height, texture->wrap_v) * level->width;
    const float4 above = mix_float4(read_texel(level, row0 + x0), read_texel(level, row0 + x1), x - left);
    const float4 below = mix_float4(read_texel(level, row1 + x0), read_texel(level, row1 + x1), x - left);
    return mix_float4(above, below, y - top);
}

/// The two levels around a level of detail, and the fraction of the second.
typedef struct Levels {
    Level fine, coarse;
    float fraction;
} Levels;

/// For texels of `width` times those of level 0.
inline void find_levels(global const TextureRecord* texture, global const uint* texels, float width, Levels* levels) {
    const uint last = texture->levels - 1;
    const float detail = clamp(log2_of(width), 0.0f, (float)last);
    const uint number = (uint)detail;
    levels->fraction = detail - (float)number;
    find_level(texture, texels, number, &levels->fine);
    levels->coarse = levels->fine;
    if (number < last) find_level(texture, texels, number + 1, &levels->coarse);
}

inline float4 trilinear(global const TextureRecord* texture, const Levels* levels, float2 uv) {
    const float2 wrapped = wrap_coordinates(texture, uv);
    const float4 fine = bilinear(texture, &levels->fine, wrapped);
    return levels->fraction > 0.0f ? mix_float4(fine, bilinear(texture, &levels->coarse, wrapped), levels->fraction)
                                   : fine;
}

/// The ellipse into which the two vectors take a circle as wide as they: its axes in texels of level 0, and the longer
/// one as a difference of texture coordinates.
typedef struct Footprint {
    float longer, shorter;
    float2 along;
} Footprint;

inline void find_footprint(global const TextureRecord* texture, float2 along_x, float2 along_y, Footprint* footprint) {
    const float2 size = (float2)((float)texture->width, (float)texture->height);
    float2 a = along_x * size, b = along_y * size;
    // NaN counts as nothing, unless all are.
    const float largest = fmax(fmax(fmax(fabs(a.x), fabs(a.y)), fmax(fabs(b.x), fabs(b.y))), 0.0f);
    // A beam without width, of which nothing is known, and one that covers everything.
    footprint->along = (float2)(0.0f);
    footprint->shorter = footprint->longer = clamp(largest, FLT_MIN, 0x1p100f);
    if (!(largest > FLT_MIN && largest < 0x1p100f)) return;
    // Singular values of the matrix of a and b; squares are taken of numbers up to 1.
    a /= largest;
    b /= largest;
    const float half_difference = 0.5f * ((a.x * a.x + b.x * b.x) - (a.y * a.y + b.y * b.y));
    const float product = a.x * a.y + b.x * b.y;
    const float root = sqrt(half_difference * half_difference + product * product);
    const float square = 0.5f * (dot_float2(a, a) + dot_float2(b, b)) + root;
    if (!(square > 0.0f)) return; // one is NaN
    float2 axis;
    if (half_difference > 0.0f)
        axis = (float2)(half_difference + root, product);
    else
        axis = (float2)(product, root - half_difference);
    const float length = sqrt(square), axis_square = dot_float2(axis, axis);
    footprint->longer = largest * length;
    footprint->shorter = largest * fabs(a.x * b.y - a.y * b.x) / length;
    if (axis_square > 0.0f) footprint->along = axis / sqrt(axis_square) * footprint->longer / size;
}
#endif

/// Linear colour and alpha at `uv`, over the parallelogram that `along_x` and `along_y`, the differences of uv across
/// the beam, span; without `sharp` over a wider one. Any floats: coordinates that float cannot place within the picture
/// read some texel of it.
inline float4 sample_texture(global const TextureRecord* texture, global const uint* texels, float2 uv, float2 along_x,
                             float2 along_y, bool sharp) {
#if FILTER == 0
    (void)along_x;
    (void)along_y;
    (void)sharp;
    Level level;
    find_level(texture, texels, 0, &level);
    return nearest_texel(&level, wrap_coordinates(texture, uv));
#else
    Footprint footprint;
    find_footprint(texture, along_x, along_y, &footprint);
    if (texture->nearest && footprint.longer <= 1.0f) {
        Level level;
        find_level(texture, texels, 0, &level);
        return nearest_texel(&level, wrap_coordinates(texture, uv));
    }
    Levels levels;
#if FILTER == 1
    (void)sharp;
    find_levels(texture, texels, footprint.longer, &levels);
    return trilinear(texture, &levels, uv);
#else
    if (!sharp) {
        find_levels(texture, texels, footprint.longer, &levels);
        return trilinear(texture, &levels, uv);
    }
    // As many taps as the shorter axis, or a texel, goes into the longer one.
    const float width = fmax(fmax(footprint.shorter, 1.0f), footprint.longer / MOST_TAPS);
    const int taps = clamp((int)ceil(footprint.longer / width), 1, MOST_TAPS);
    find_levels(texture, texels, width, &levels);
    float4 sum = (float4)(0.0f);
    for (int i = 0; i < taps; ++i)
        sum += trilinear(texture, &levels, uv + footprint.along * (((float)i + 0.5f) / (float)taps - 0.5f));
    return sum / (float)taps;
#endif
#endif
}

#endif
