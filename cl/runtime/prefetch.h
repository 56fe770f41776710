// SPDX-License-Identifier: MIT
// Asks for memory ahead of its use. OpenCL's own prefetch() does nothing on PoCL, so the compiler's builtin is taken
// where code is made for a processor that has it; front ends that make SPIR-V accept it too, and then end in its
// translation. Neither changes any result.
#ifndef BOXWOOD_RUNTIME_PREFETCH_H
#define BOXWOOD_RUNTIME_PREFETCH_H
#include "runtime/inline.h"

// Oclgrind, which has 1.2, does not know it.
#if __OPENCL_C_VERSION__ >= 300 && (defined(__x86_64__) || defined(__aarch64__)) && __has_builtin(__builtin_prefetch)
#define PREFETCH_LINE(place) __builtin_prefetch((const void*)(size_t)(place))
#else
#define PREFETCH_LINE(place) prefetch(place, 64)
#endif

/// The cache line of 64 bytes that holds `place`.
INLINE void prefetch_line(global const char* place) { PREFETCH_LINE(place); }

/// The four cache lines of 64 bytes from `place` on.
INLINE void prefetch_256(global const char* place) {
    PREFETCH_LINE(place);
    PREFETCH_LINE(place + 64);
    PREFETCH_LINE(place + 128);
    PREFETCH_LINE(place + 192);
}

#endif
