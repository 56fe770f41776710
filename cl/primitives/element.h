// SPDX-License-Identifier: MIT
// One element of the arrays that the primitives work on. Arrays are packed scalars: component c of element i is scalar
// i * COMPONENTS + c, and needs the alignment of its scalar only.
//
// SCALAR      int, uint, ulong or float
// COMPONENTS  scalars per element: 1, 2, 4, or 6 (a box: min x y z, max x y z)
#ifndef BOXWOOD_PRIMITIVES_ELEMENT_H
#define BOXWOOD_PRIMITIVES_ELEMENT_H

#ifndef SCALAR
#error "define SCALAR (int, uint, ulong or float)"
#endif
#ifndef COMPONENTS
#error "define COMPONENTS (1, 2, 4 or 6)"
#endif

#define JOIN_TOKENS(a, b) a##b
#define JOIN(a, b) JOIN_TOKENS(a, b)

#if COMPONENTS == 1
typedef SCALAR Element;
#define LOAD_ELEMENT(in, i) ((in)[i])
#define STORE_ELEMENT(value, out, i) ((out)[i] = (value))
#elif COMPONENTS == 2
typedef JOIN(SCALAR, 2) Element;
#define LOAD_ELEMENT(in, i) vload2(i, in)
#define STORE_ELEMENT(value, out, i) vstore2(value, i, out)
#elif COMPONENTS == 4
typedef JOIN(SCALAR, 4) Element;
#define LOAD_ELEMENT(in, i) vload4(i, in)
#define STORE_ELEMENT(value, out, i) vstore4(value, i, out)
#elif COMPONENTS == 6
// In a vector of eight whose last two lanes are never stored: a struct would be passed through memory.
typedef JOIN(SCALAR, 8) Element;
static inline Element load_six(global const SCALAR* in, size_t i) {
    return (Element)(vload4(0, in + 6 * i), vload2(0, in + 6 * i + 4), (SCALAR)0, (SCALAR)0);
}
static inline void store_six(Element e, global SCALAR* out, size_t i) {
    vstore4(e.lo, 0, out + 6 * i);
    vstore2(e.s45, 0, out + 6 * i + 4);
}
#define LOAD_ELEMENT(in, i) load_six(in, i)
#define STORE_ELEMENT(value, out, i) store_six(value, out, i)
#else
#error "COMPONENTS must be 1, 2, 4 or 6"
#endif

#endif
