// SPDX-License-Identifier: MIT
// What the collapse's cost pass decides for an inner node, in one word.
//
// Bits [3 (j - 2), 3 (j - 2) + 3), j = 2..8: how many of j boxes the left child gets when the node is divided into j;
// 0 where j boxes are no better than j - 1. For j = 8, the node as a wide node of its own, it is never 0.
// PLAN_LEAF instead: the node is a leaf.
#ifndef BOXWOOD_LAYOUT_PLAN_H
#define BOXWOOD_LAYOUT_PLAN_H

#define PLAN_LEAF 0x80000000u

inline uint left_boxes(uint plan, uint boxes) { return (plan >> (3 * (boxes - 2))) & 7u; }

#endif
