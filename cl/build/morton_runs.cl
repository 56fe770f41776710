// SPDX-License-Identifier: MIT
// Gaps between sorted Morton codes, and the long runs of equal codes that a scene has when something small is beside
// something large. The primitives of such runs get codes once more, in a later round, each run as a tree of its own
// within the bounds of its centres, until no bits part them or no run is long.
//
// KEY        type of a key: uint or ulong
// TREE_IN_KEY     1: keys hold the tree (in later rounds: the run) above CODE_BITS; 0: one tree
// CODE_BITS  bits of a key below the tree
// compile: KEY=uint TREE_IN_KEY=0 CODE_BITS=30
// compile: KEY=ulong TREE_IN_KEY=1 CODE_BITS=30
// compile: KEY=ulong TREE_IN_KEY=0 CODE_BITS=63
#include "runtime/numerics.h"
#include "bounds/box.h"
#include "build/gaps.h"

#if !defined(KEY) || !defined(TREE_IN_KEY) || !defined(CODE_BITS)
#error "define KEY, TREE_IN_KEY and CODE_BITS"
#endif

#if TREE_IN_KEY
#define TREE_OF(key) ((uint)((key) >> CODE_BITS))
#else
#define TREE_OF(key) 0u
#endif

/// The gap between codes that first differ in the highest bit of `difference`, not 0.
inline gap_t gap_of_codes(KEY difference, uint rank) { return (gap_t)(rank + 8 * sizeof(KEY) - (uint)clz(difference)); }

/// @pre  keys are sorted; rank + 64 < NO_GAP, rank >= 32. Slices cover `count` > 0 positions.
/// @post gaps[i] is the gap after position i, for all of them.
/// Every gap has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void key_gaps(global const KEY* keys, global gap_t* gaps, uint rank, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    KEY key = keys[begin];
    for (uint i = begin; i < end; ++i) {
        gap_t gap = NO_GAP;
        if (i + 1 < count) {
            const KEY next = keys[i + 1];
            if (TREE_OF(next) == TREE_OF(key)) gap = next == key ? gap_of_positions(i) : gap_of_codes(next ^ key, rank);
            key = next;
        }
        gaps[i] = gap;
    }
}

/// Parts runs by the sorted keys of a later round.
/// @pre  places[k] is the position of the k-th primitive that was sorted, ascending; gaps[] holds the gaps before this
///       round. `rank` is at least 64 below that of the round before. Slices cover `count` > 0 keys.
/// @post Gaps between unlike codes of one run are set; those around runs and between equal codes are not touched.
/// Places are distinct, so every gap has at most one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void run_gaps(global const KEY* keys, global const uint* places, global gap_t* gaps, uint rank, uint count,
              uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count - 1);
    for (uint k = begin; k < end; ++k) {
        const KEY difference = keys[k] ^ keys[k + 1];
        const bool same_run = TREE_OF(difference) == 0;
        if (difference != 0 && same_run) gaps[places[k]] = gap_of_codes(difference, rank);
    }
}

/// What a work-item knows on its way along sorted keys.
typedef struct Cursor {
    global const KEY* keys;
    global const uint* offsets; ///< Of the trees.
    uint count;
    uint run_length;  ///< Of the shortest long run, at least 1.
    uint whole_trees; ///< 0: codes did not part what is a run from end to end of its tree, and never will.
    uint long_end;    ///< Where the long run ends that was met last, as far as is known.
} Cursor;

/// Takes note of a long run when at least run_length equal keys begin at i.
inline void look_ahead(Cursor* w, uint i) {
    const uint last = i + w->run_length - 1;
    if (last >= w->count || w->keys[i] != w->keys[last]) return;
    const uint tree = TREE_OF(w->keys[i]);
    if (w->whole_trees || w->keys[w->offsets[tree]] != w->keys[w->offsets[tree + 1] - 1]) w->long_end = last + 1;
}

/// A cursor that is about to look at position `begin`.
inline Cursor cursor_at(global const KEY* keys, global const uint* offsets, uint begin, uint count, uint run_length,
                        uint whole_trees) {
    Cursor w = {keys, offsets, count, run_length, whole_trees, 0};
    for (uint i = begin - min(begin, run_length - 1); i < begin; ++i) look_ahead(&w, i);
    return w;
}

inline bool starts_run(const Cursor* w, uint i) { return i == 0 || w->keys[i - 1] != w->keys[i]; }

/// @pre  keys are sorted, offsets[] says where each tree begins and the last one ends; run_length > 0. Slices cover
///       `count` > 0 keys.
/// @post counts[slice]: in the lower half how many primitives of the slice are in long runs, in the upper half how many
///       long runs begin there. A run that is a whole tree counts if whole_trees is not 0.
/// Each count has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void count_runs(global const KEY* keys, global const uint* offsets, global ulong* counts, uint run_length,
                uint whole_trees, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    Cursor w = cursor_at(keys, offsets, begin, count, run_length, whole_trees);
    uint members = 0, runs = 0;
    for (uint i = begin; i < end; ++i) {
        look_ahead(&w, i);
        if (i < w.long_end) {
            ++members;
            runs += starts_run(&w, i);
        }
    }
    counts[get_global_id(0)] = (ulong)runs << 32 | members;
}

/// @pre  counts[] are the sums of those of count_runs up to and with each slice; the rest is as there.
/// @post members[] are the positions within long runs, ascending; starts[] where each run begins in members[], and
///       behind the last their number.
/// A slice writes what its count says, between those of its neighbours: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void list_runs(global const KEY* keys, global const uint* offsets, global const ulong* counts, global uint* members,
               global uint* starts, uint run_length, uint whole_trees, uint count, uint slice) {
    const uint index = (uint)get_global_id(0), begin = index * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    const ulong before = index == 0 ? 0 : counts[index - 1];
    uint member = (uint)before, run = (uint)(before >> 32);
    if (counts[index] != before) {
        Cursor w = cursor_at(keys, offsets, begin, count, run_length, whole_trees);
        for (uint i = begin; i < end; ++i) {
            look_ahead(&w, i);
            if (i >= w.long_end) continue;
            if (starts_run(&w, i)) starts[run++] = member;
            members[member++] = i;
        }
    }
    if (end == count) starts[run] = member;
}

/// centres[k] is the centre of the box of primitives[k], as a box without extent.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void run_centres(global const Aabb* boxes, global const uint* primitives, global Aabb* centres, uint count,
                 uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    for (uint k = begin; k < end; ++k) {
        const float4 centre = box_centre(load_box(boxes + primitives[k]));
        const Box point = {(float4)(centre.xyz, centre.x), centre.yz};
        store_box(point, centres + k);
    }
}
