// SPDX-License-Identifier: MIT
// The common subset of C++ and OpenCL C in which shared structs are declared.
#ifndef BOXWOOD_SHARED_TYPES_H
#define BOXWOOD_SHARED_TYPES_H

#ifdef __OPENCL_VERSION__
#define BOXWOOD_SHARED_BEGIN
#define BOXWOOD_SHARED_END
#define BOXWOOD_SHARED_SIZE(type, bytes)
#else
#include <cstdint>
#define BOXWOOD_SHARED_BEGIN    \
    namespace boxwood {         \
    using uint = std::uint32_t; \
    using ulong = std::uint64_t;
#define BOXWOOD_SHARED_END }
#define BOXWOOD_SHARED_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type " must not be padded");
#endif

// Index that stands for "none" in every shared struct.
#define BOXWOOD_NONE 0xffffffffu

// Set in a node's child reference when the child is a leaf; the other bits are then a leaf index.
#define BOXWOOD_LEAF 0x80000000u

// Set in a child reference of an OrientedNode when the child's volume is axis-aligned.
#define BOXWOOD_ALIGNED 0x40000000u

#endif
