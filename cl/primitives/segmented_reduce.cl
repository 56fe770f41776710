// SPDX-License-Identifier: MIT
// Segmented reduction, balanced over elements. Work-items own tiles of TILE elements, whatever the segments are:
//
//   segmented_reduce   per tile: segments inside it are done. Of a segment that crosses its borders it leaves the part
//                      that came in over the front (`head`) and the part that leaves over the back (`tail`).
//   the heads          a segment that leaves tile b covers the heads of some tiles b + 1 .. c: again a segmented
//                      reduction, over as many elements as there were tiles, with one segment per tile (`spans`).
//   segmented_finish   joins each tail with its reduced heads.
//
// How a segment is folded depends on its offsets only, not on how tiles are dealt to work-items.
//
// GROUP_SIZE                                 work-items per group, 1 or more
// SCALAR, COMPONENTS, OP_SUM/OP_MIN/OP_MAX   as in primitives/operator.h
// compile: SCALAR=uint COMPONENTS=1 OP_MIN
// compile: SCALAR=float COMPONENTS=4 OP_SUM
// compile: SCALAR=float COMPONENTS=6 OP_SUM
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#include "primitives/operator.h"
#include "primitives/segments.h"
#include "shared/types.h"

/// @pre  `offsets` has segments + 1 entries. Slices as in reduce.cl, over segments.
/// @post out[s] is the neutral element for every segment s without elements; other segments are not touched.
/// Every segment has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void segmented_empty(global const uint* offsets, global SCALAR* out, uint segments, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length;
    const uint last = first + min(length, segments - first);
    for (uint s = first; s < last; ++s)
        if (offsets[s] == offsets[s + 1]) STORE_ELEMENT(neutral(), out, s);
}

/// @pre  `in` holds `count` > 0 elements, `offsets` segments + 1 ascending entries of at most `count`, segments > 0.
///       Slices as in reduce.cl, over elements. The per-tile arrays hold one entry per tile, `spans` one more.
/// @post out[s] is done for every non-empty segment s inside one tile. For each tile b: head[b] is the fold of its
///       elements that belong to a segment which began before it (the neutral element if there are none), spans[b] is
///       the tile after the one where that segment ends (b + 1 if there is none), tail_segment[b] is the segment
///       that begins in b and ends in a later tile (BOXWOOD_NONE if there is none) and tail[b] the fold of its
///       elements in b. The last entry of `spans` is the number of tiles.
/// A segment has one tile in which it begins, so every entry of every output has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void segmented_reduce(global const SCALAR* in, global const uint* offsets, global SCALAR* out, global SCALAR* head,
                      global SCALAR* tail, global uint* tail_segment, global uint* spans, uint count, uint segments,
                      uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint begin = slice * length;
    const uint last = begin + min(length, count - begin);
    if (slice == 0) spans[(count - 1) / TILE + 1] = (count - 1) / TILE + 1;

    uint segment = segment_ending_after(offsets, segments, begin);
    while (begin < last) {
        const uint end = begin + min(TILE, last - begin);
        const uint tile = begin / TILE;
        Element front = neutral();
        uint span = tile + 1, back_segment = BOXWOOD_NONE;
        for (; segment < segments; ++segment) {
            const uint from = offsets[segment], to = offsets[segment + 1];
            if (from >= end) break;
            if (from == to) continue; // segmented_empty has seen to it
            const Element part = fold(in, max(from, begin), min(to, end));
            if (from < begin) {
                front = part;
                span = (to - 1) / TILE + 1;
            } else if (to > end) {
                back_segment = segment;
                STORE_ELEMENT(part, tail, tile);
            } else {
                STORE_ELEMENT(part, out, segment);
            }
            if (to > end) break; // it goes on in the next tile
        }
        STORE_ELEMENT(front, head, tile);
        spans[tile] = span;
        tail_segment[tile] = back_segment;
        begin = end;
    }
}

/// @pre  reduced[b] is the fold of head[spans[b]] .. head[spans[b + 1] - 1]. Slices cover `tiles` tiles.
/// @post out[s] is done for every segment s that reaches over more than one tile.
/// A segment begins in one tile, so it has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void segmented_finish(global const SCALAR* tail, global const SCALAR* reduced, global const uint* tail_segment,
                      global SCALAR* out, uint tiles, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length;
    const uint last = first + min(length, tiles - first);
    for (uint b = first; b < last; ++b)
        if (tail_segment[b] != BOXWOOD_NONE)
            STORE_ELEMENT(combine(LOAD_ELEMENT(tail, b), LOAD_ELEMENT(reduced, b)), out, tail_segment[b]);
}
