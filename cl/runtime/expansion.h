// SPDX-License-Identifier: MIT
// Sums of floats without rounding, as non-overlapping parts (Shewchuk 1997). Exact as long as nothing underflows.
#ifndef BOXWOOD_RUNTIME_EXPANSION_H
#define BOXWOOD_RUNTIME_EXPANSION_H
#include "runtime/numerics.h"

/// Numbers whose exact sum is meant, ascending and non-overlapping but for zeros.
typedef struct Expansion {
    float parts[12];
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

inline bool is_zero(const Expansion* sum) {
    for (int i = 0; i < sum->count; ++i)
        if (sum->parts[i] != 0.0f) return false;
    return true;
}

#endif
