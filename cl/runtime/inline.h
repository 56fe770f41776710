// SPDX-License-Identifier: MIT
// For the device functions of an inner loop. PoCL leaves larger functions as calls, and everything that they are handed
// by pointer then lives in memory: closest hit lost a third of its speed that way.
#ifndef BOXWOOD_RUNTIME_INLINE_H
#define BOXWOOD_RUNTIME_INLINE_H

#define INLINE static inline __attribute__((always_inline))

#endif
