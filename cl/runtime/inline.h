// SPDX-License-Identifier: MIT
// For the device functions of inner loops. PoCL does not inline larger functions, and whatever is passed to a call by
// pointer lives in memory: rays and hits would be stored and loaded at every node.
#ifndef BOXWOOD_RUNTIME_INLINE_H
#define BOXWOOD_RUNTIME_INLINE_H

#define INLINE static inline __attribute__((always_inline))

#endif
