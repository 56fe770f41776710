// SPDX-License-Identifier: MIT
// The one audited hand-off of memory between work-groups, used where two children meet in their parent: the first to
// arrive leaves its results in memory and stops, the second takes over with both. Nobody waits, so nothing is assumed
// about which groups run.
#ifndef BOXWOOD_RUNTIME_HANDOFF_H
#define BOXWOOD_RUNTIME_HANDOFF_H

// OpenCL C 3.0 has the ordering that is meant, where the device offers it (host/runtime/language.hpp). Under 1.2, which
// other devices take, an atomic is relaxed, and the fences around it order this work-item's global accesses: what it
// wrote before one is committed to memory before what comes after it (OpenCL C 1.2, 6.12.9).
#if __OPENCL_C_VERSION__ >= 300

typedef atomic_uint handoff_t;

/// Publishes everything this work-item wrote to global memory and counts it in at `place` (0 before the first).
/// Returns true to the second to arrive, which then sees what the first wrote; false to the first.
inline bool handoff_is_second(global handoff_t* place) {
    return atomic_fetch_add_explicit(place, 1u, memory_order_acq_rel, memory_scope_device) != 0u;
}

#else

typedef uint handoff_t;

inline bool handoff_is_second(global handoff_t* place) {
    mem_fence(CLK_GLOBAL_MEM_FENCE);
    const bool second = atomic_add(place, 1u) != 0u;
    mem_fence(CLK_GLOBAL_MEM_FENCE);
    return second;
}

#endif
#endif
