// SPDX-License-Identifier: MIT
// The built-in functions that kernels call, declared as Clang's opencl-c.h does. PoCL reads that header, 18,000 lines,
// for every program, which takes longer than all else on the way to its first launch; programs of embedded kernels are
// given these lines instead (host/runtime/device_state.cpp). A kernel that calls another function is compiled with the
// whole header. scripts/check_kernels.sh compares the code that comes of both.
#ifndef BOXWOOD_RUNTIME_BUILTINS_H
#define BOXWOOD_RUNTIME_BUILTINS_H

#define PURE __attribute__((overloadable, const))
#define READS __attribute__((overloadable, pure))
#define ACTS __attribute__((overloadable))

#define WIDTHS(DECLARE, T) DECLARE(T) DECLARE(T##2) DECLARE(T##3) DECLARE(T##4) DECLARE(T##8) DECLARE(T##16)
// Pairs of a type and the one of its masks and bits.
#define PAIRED_WIDTHS(DECLARE, T, I) \
    DECLARE(T, I) DECLARE(T##2, I##2) DECLARE(T##3, I##3) DECLARE(T##4, I##4) DECLARE(T##8, I##8) DECLARE(T##16, I##16)

size_t PURE get_global_id(uint);

#define FLOAT_FUNCTIONS(T) \
    T PURE ceil(T);        \
    T PURE floor(T);       \
    T PURE fabs(T);        \
    T PURE sqrt(T);        \
    T PURE fmin(T, T);     \
    T PURE fmax(T, T);     \
    T PURE copysign(T, T); \
    T PURE fma(T, T, T);
WIDTHS(FLOAT_FUNCTIONS, float)

#define COMMON_FUNCTIONS(T) \
    T PURE min(T, T);       \
    T PURE max(T, T);       \
    T PURE clamp(T, T, T);
WIDTHS(COMMON_FUNCTIONS, float)
WIDTHS(COMMON_FUNCTIONS, int)
WIDTHS(COMMON_FUNCTIONS, uint)
WIDTHS(COMMON_FUNCTIONS, long)
WIDTHS(COMMON_FUNCTIONS, ulong)

// With a scalar beside a vector.
#define SCALAR_BOUNDS(T, S) \
    T PURE min(T, S);       \
    T PURE max(T, S);       \
    T PURE clamp(T, S, S);
#define SCALAR_BOUNDS_OF(S) \
    SCALAR_BOUNDS(S##2, S) SCALAR_BOUNDS(S##3, S) SCALAR_BOUNDS(S##4, S) SCALAR_BOUNDS(S##8, S) SCALAR_BOUNDS(S##16, S)
SCALAR_BOUNDS_OF(float)
SCALAR_BOUNDS_OF(int)
SCALAR_BOUNDS_OF(uint)

#define BIT_FUNCTIONS(T) \
    T PURE clz(T);       \
    T PURE ctz(T);       \
    T PURE rotate(T, T);
WIDTHS(BIT_FUNCTIONS, int)
WIDTHS(BIT_FUNCTIONS, uint)
WIDTHS(BIT_FUNCTIONS, long)
WIDTHS(BIT_FUNCTIONS, ulong)

#define TESTS(T) int PURE any(T);
WIDTHS(TESTS, char)
WIDTHS(TESTS, int)
WIDTHS(TESTS, long)

#define SELECT(T, I) T PURE select(T, T, I);
PAIRED_WIDTHS(SELECT, float, int)
PAIRED_WIDTHS(SELECT, float, uint)
PAIRED_WIDTHS(SELECT, int, int)
PAIRED_WIDTHS(SELECT, int, uint)
PAIRED_WIDTHS(SELECT, uint, int)
PAIRED_WIDTHS(SELECT, uint, uint)
PAIRED_WIDTHS(SELECT, long, long)
PAIRED_WIDTHS(SELECT, ulong, long)
PAIRED_WIDTHS(SELECT, long, ulong)
PAIRED_WIDTHS(SELECT, ulong, ulong)

#define CONVERT(T, N)                    \
    T##N PURE convert_##T##N(char##N);   \
    T##N PURE convert_##T##N(uchar##N);  \
    T##N PURE convert_##T##N(ushort##N); \
    T##N PURE convert_##T##N(int##N);    \
    T##N PURE convert_##T##N(uint##N);   \
    T##N PURE convert_##T##N(long##N);   \
    T##N PURE convert_##T##N(ulong##N);  \
    T##N PURE convert_##T##N(float##N);
#define CONVERT_TO(T) CONVERT(T, 2) CONVERT(T, 3) CONVERT(T, 4) CONVERT(T, 8) CONVERT(T, 16)
CONVERT_TO(char)
CONVERT_TO(int)
CONVERT_TO(uint)
CONVERT_TO(ulong)
CONVERT_TO(float)

#define MEMORY(T, N, SPACE)                      \
    T##N READS vload##N(size_t, const SPACE T*); \
    void ACTS vstore##N(T##N, size_t, SPACE T*);
#define MEMORY_OF(T, SPACE) \
    MEMORY(T, 2, SPACE) MEMORY(T, 3, SPACE) MEMORY(T, 4, SPACE) MEMORY(T, 8, SPACE) MEMORY(T, 16, SPACE)
#define MEMORY_IN(SPACE) \
    MEMORY_OF(float, SPACE) MEMORY_OF(int, SPACE) MEMORY_OF(uint, SPACE) MEMORY_OF(long, SPACE) MEMORY_OF(ulong, SPACE)
#ifdef __opencl_c_generic_address_space
MEMORY_IN()
#endif
#ifdef __opencl_c_named_address_space_builtins
MEMORY_IN(global)
MEMORY_IN(local)
MEMORY_IN(private)
#endif

#ifdef __opencl_c_generic_address_space
uint ACTS atomic_fetch_add_explicit(volatile atomic_uint*, uint, memory_order, memory_scope);
#endif
#ifdef __opencl_c_named_address_space_builtins
uint ACTS atomic_fetch_add_explicit(volatile global atomic_uint*, uint, memory_order, memory_scope);
#endif
uint ACTS atomic_add(volatile global uint*, uint);
uint ACTS atomic_inc(volatile global uint*);
void ACTS mem_fence(cl_mem_fence_flags);
void ACTS prefetch(const global char*, size_t);

#undef PURE
#undef READS
#undef ACTS
#undef WIDTHS
#undef PAIRED_WIDTHS
#undef FLOAT_FUNCTIONS
#undef COMMON_FUNCTIONS
#undef SCALAR_BOUNDS
#undef SCALAR_BOUNDS_OF
#undef BIT_FUNCTIONS
#undef TESTS
#undef SELECT
#undef CONVERT
#undef CONVERT_TO
#undef MEMORY
#undef MEMORY_OF
#undef MEMORY_IN

#endif
