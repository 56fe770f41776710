// SPDX-License-Identifier: MIT
// For the device functions of an inner loop. PoCL leaves larger functions as calls, and everything that they are handed
// by pointer then lives in memory: hits and rays then cross memory at every node.
#ifndef BOXWOOD_RUNTIME_INLINE_H
#define BOXWOOD_RUNTIME_INLINE_H

#define INLINE static inline __attribute__((always_inline))

#endif
