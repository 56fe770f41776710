// SPDX-License-Identifier: MIT
// What a traversal program is specialised for. Everything that is not asked for is compiled out.
//
// ANY_HIT         0: closest hit; 1: any hit.
// LAYOUT          2: `binary` nodes and single triangles; 8: `wide8` nodes and blocks of four triangles.
// ORIENTED        1: `binary` nodes with oriented boxes; 0: axis-aligned boxes.
// LEVELS          1: one tree in world space; 2: a tree over instances above a tree per mesh.
// FLATTENED       1: one level that holds the triangles of several instances; 0: anything else.
// AREAS           1: influence areas with trees of their own, searched first; one level only.
// INTERSECTOR     0: the watertight triangle test; 1: that of Moller and Trumbore.
// STATISTICS      1: count the volumes and primitives tested.
// STACK_SIZE      Entries of the stack, see stack_entries() in host/traverse/specialise.hpp.
// PORTABLE_LANES  See runtime/lanes.h.
#ifndef BOXWOOD_TRAVERSE_CONFIG_H
#define BOXWOOD_TRAVERSE_CONFIG_H

#if !defined(ANY_HIT) || !defined(LAYOUT) || !defined(ORIENTED) || !defined(LEVELS) || !defined(FLATTENED) || \
    !defined(AREAS) || !defined(INTERSECTOR) || !defined(STATISTICS) || !defined(STACK_SIZE) || !defined(GROUP_SIZE)
#error "define ANY_HIT, LAYOUT, ORIENTED, LEVELS, FLATTENED, AREAS, INTERSECTOR, STATISTICS, STACK_SIZE and GROUP_SIZE"
#endif
#if (LAYOUT != 2 && LAYOUT != 8) || (ORIENTED && LAYOUT != 2) || (LEVELS != 1 && LEVELS != 2) || \
    (FLATTENED && LEVELS != 1) || STACK_SIZE < 1
#error "LAYOUT is 2 or 8, only 2 has oriented boxes, LEVELS is 1 or 2, only 1 can be flattened, the stack is not empty"
#endif
#if AREAS && (LEVELS != 1 || ORIENTED)
#error "only one level of axis-aligned boxes has areas"
#endif

#include "runtime/lanes.h"
#include "runtime/numerics.h"
#include "shared/area.h"
#include "shared/instance.h"
#include "shared/node.h"
#include "shared/ray.h"

#if LAYOUT == 8
typedef Wide8Node node_t;
#elif ORIENTED
typedef OrientedNode node_t;
#else
typedef BinaryNode node_t;
#endif

#endif
