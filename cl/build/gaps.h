// SPDX-License-Identifier: MIT
// The gap between neighbours in sorted order, from which a linear BVH is built.
#ifndef BOXWOOD_BUILD_GAPS_H
#define BOXWOOD_BUILD_GAPS_H

/// The gap after position i, between it and i + 1. It grows with the rank of the highest bit in which the two differ,
/// where a primitive has as bits its code, then the codes of later rounds (morton_runs.cl), then its position.
typedef ushort gap_t;

/// The gap where no node spans both neighbours: between trees and behind the last position. Larger than all others.
#define NO_GAP 0xffffu

/// Of primitives whose codes are equal to the last bit: by their positions.
inline gap_t gap_of_positions(uint i) { return (gap_t)(32 - clz(i ^ (i + 1))); }

#endif
