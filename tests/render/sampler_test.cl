// SPDX-License-Identifier: MIT
// compile: LANES=1 SAMPLER=0
// compile: LANES=1 SAMPLER=1
// compile: LANES=1 SAMPLER=2
// compile: LANES=16 SAMPLER=0
// compile: LANES=16 SAMPLER=1
// compile: LANES=16 SAMPLER=2
#include "render/sampler.h"

/// out = the point of sample s of `samples` for `count` pixels and dimensions, two floats each.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void sampler_test(ulong seed, global const uint* pixels, global const uint* dimensions, uint count, uint samples,
                  global float* out) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    const wide key = random_key(seed, TO_WIDE(LOAD_LANES(pixels + at)));
    for (uint sample = 0; sample < samples; ++sample) {
        const Sampler sampler = {key, sample, samples};
        real u, v;
        sample_square(&sampler, LOAD_LANES(dimensions + at), &u, &v);
        STORE_LANES(u, out + 2 * sample * count + at);
        STORE_LANES(v, out + (2 * sample + 1) * count + at);
    }
}
