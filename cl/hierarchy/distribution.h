// SPDX-License-Identifier: MIT
// What a builder knows of the rays that will meet a tree, and the chance that one of them meets a box.
#ifndef BOXWOOD_HIERARCHY_DISTRIBUTION_H
#define BOXWOOD_HIERARCHY_DISTRIBUTION_H
#include "bounds/box.h"
#include "shared/influence.h"

/// The rays of one tree: those of the areas by their shares, and the others, which come from everywhere.
typedef struct Distribution {
    global const InfluenceRecord* areas;
    uint area_count;
    float isotropic; ///< Share of the rays that follow no area: 1 less the areas' shares.
    Box root;        ///< The box of the tree, which every isotropic ray meets.
} Distribution;

#endif
