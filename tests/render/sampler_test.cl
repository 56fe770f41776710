// SPDX-License-Identifier: MIT
// compile: SAMPLER=0
// compile: SAMPLER=1
// compile: SAMPLER=2
#include "render/sampler.h"

/// out[s] = the point of sample s of `count`, two floats.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void sampler_test(ulong seed, uint pixel, uint dimension,
                                                                                 uint count, global float* out) {
    const uint sample = (uint)get_global_id(0);
    if (sample >= count) return;
    const Sampler sampler = {random_key(seed, pixel), sample, count};
    vstore2(sample_square(&sampler, dimension), sample, out);
}
