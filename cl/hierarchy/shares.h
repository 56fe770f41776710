// SPDX-License-Identifier: MIT
// What the collapse's cost pass decides for an inner node, in one word.
//
// Bits [3 (j - 2), 3 (j - 2) + 3), j = 2..8: how many of j boxes the left child gets when the node is shared out over j;
// 0 where j boxes are no better than j - 1. For j = 8, the node as a wide node of its own, it is never 0.
// SHARES_LEAF instead: the node is a leaf.
#ifndef BOXWOOD_HIERARCHY_SHARES_H
#define BOXWOOD_HIERARCHY_SHARES_H

#define SHARES_LEAF 0x80000000u

inline uint share_of(uint shares, uint boxes) { return (shares >> (3 * (boxes - 2))) & 7u; }

#endif
