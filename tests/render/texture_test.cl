// SPDX-License-Identifier: MIT
// render/texture.h on arrays. Macros: FILTER.
// compile: FILTER=0 WIDE_TEXELS=1
// compile: FILTER=1 WIDE_TEXELS=0
// compile: FILTER=2 WIDE_TEXELS=1
#include "render/texture.h"

/// A texture coordinate and a footprint for each query: 6 floats. Sharp.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void sample_test(global const TextureRecord* texture, global const uint* texels, global const float* queries,
                 uint count, global float4* colors) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const float* q = queries + 6 * (size_t)i;
    colors[i] = sample_texture(texture, texels, (float2)(q[0], q[1]), (float2)(q[2], q[3]), (float2)(q[4], q[5]), true);
}
