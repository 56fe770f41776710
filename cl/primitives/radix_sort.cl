// SPDX-License-Identifier: MIT
// One pass of a stable radix sort, least significant digit first: count the digits of each slice, scan the counts
// (scan.cl) in the order (digit, slice), move the pairs. A slice moves its pairs in order, and slices with the same
// digit follow each other, so equal digits keep their order.
//
// GROUP_SIZE   work-items per group, 1 or more
// KEY          uint or ulong
// DIGIT_BITS   most bits in a digit
// compile: KEY=uint DIGIT_BITS=10
// compile: KEY=ulong DIGIT_BITS=4
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#ifndef KEY
#error "define KEY (uint or ulong)"
#endif
#ifndef DIGIT_BITS
#error "define DIGIT_BITS"
#endif

#define DIGITS (1u << DIGIT_BITS)

/// @pre  `keys` holds `count` > 0 keys; slices as in reduce.cl. The digit of a key is (key >> shift) & mask, with
///       mask < DIGITS. `counts` holds (mask + 1) * slices entries.
/// @post counts[digit * slices + slice] is the number of keys in the slice with that digit.
/// Each entry has one writer: no barrier. The counters are private, so no atomics either.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void radix_count(global const KEY* keys, global uint* counts, uint count, uint shift, uint mask, uint length,
                 uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint counters[DIGITS];
    for (uint digit = 0; digit <= mask; ++digit) counters[digit] = 0;
    const uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint i = first; i < last; ++i) ++counters[(uint)(keys[i] >> shift) & mask];
    for (uint digit = 0; digit <= mask; ++digit) counts[digit * slices + slice] = counters[digit];
}

/// @pre  `starts` is the exclusive scan of what radix_count wrote with the same arguments. No two buffers overlap.
/// @post `out_keys` and `out_values` hold the pairs, stably sorted by the digit.
/// Slices write to disjoint places, by the scan: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void radix_move(global const KEY* restrict keys, global const uint* restrict values, global const uint* restrict starts,
                global KEY* restrict out_keys, global uint* restrict out_values, uint count, uint shift, uint mask,
                uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint places[DIGITS];
    for (uint digit = 0; digit <= mask; ++digit) places[digit] = starts[digit * slices + slice];
    const uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint i = first; i < last; ++i) {
        const KEY key = keys[i];
        const uint place = places[(uint)(key >> shift) & mask]++;
        out_keys[place] = key;
        out_values[place] = values[i];
    }
}
