// SPDX-License-Identifier: MIT
// Signs of determinants of floats without rounding, by sums of non-overlapping parts (Shewchuk 1997).
#ifndef BOXWOOD_RENDER_EXACT_SIGN_H
#define BOXWOOD_RENDER_EXACT_SIGN_H
#include "runtime/numerics.h"

/// Numbers whose exact sum is meant, ascending and non-overlapping but for zeros.
typedef struct Expansion {
    float parts[20];
    int count;
} Expansion;

inline void add_number(Expansion* sum, float number) {
    for (int i = 0; i < sum->count; ++i) {
        const float part = sum->parts[i];
        const float total = number + part;
        const float taken = total - number;
        sum->parts[i] = (number - (total - taken)) + (part - taken);
        number = total;
    }
    sum->parts[sum->count++] = number;
}

inline void add_product(Expansion* sum, float a, float b) {
    const float product = a * b;
    add_number(sum, fma(a, b, -product));
    add_number(sum, product);
}

/// a b c, c exact to 24 bits as the others.
inline void add_triple_product(Expansion* sum, float a, float b, float c) {
    const float product = a * b;
    add_product(sum, fma(a, b, -product), c);
    add_product(sum, product, c);
}

inline int sign_of(const Expansion* sum) {
    for (int i = sum->count - 1; i >= 0; --i)
        if (sum->parts[i] != 0.0f) return sum->parts[i] > 0.0f ? 1 : -1;
    return 0;
}

/// a b - c d, off by at most 1.5 units in the last place, so that its sign is exact (Kahan; Jeannerod et al. 2013).
inline float difference_of_products(float a, float b, float c, float d) {
    const float product = c * d;
    return fma(a, b, -product) - fma(c, d, -product);
}

/// Sign of the determinant of ((x, y, 1), a, b). Where it is zero, that for a point moved on by less than any number across, or
/// upward should that leave it zero: of the two sides of a line through the point one has it (the top-left rule), and of the
/// triangles around it one. 0 when a and b are parallel. Exact as long as nothing underflows.
inline int side_of_point(float x, float y, const float* a, const float* b) {
    Expansion sum;
    sum.count = 0;
    add_triple_product(&sum, a[1], b[2], x);
    add_triple_product(&sum, -a[2], b[1], x);
    add_triple_product(&sum, a[2], b[0], y);
    add_triple_product(&sum, -a[0], b[2], y);
    add_product(&sum, a[0], b[1]);
    add_product(&sum, -a[1], b[0]);
    const int sign = sign_of(&sum);
    if (sign != 0) return sign;
    const float across = difference_of_products(a[1], b[2], a[2], b[1]);
    const float upward = across != 0.0f ? across : difference_of_products(a[2], b[0], a[0], b[2]);
    return (upward > 0.0f) - (upward < 0.0f);
}

#endif
