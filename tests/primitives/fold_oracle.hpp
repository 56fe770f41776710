// SPDX-License-Identifier: MIT
// Folds on the host for the tests of reduce, scan and segmented reduce: one after the other, floats in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include <doctest/doctest.h>

#include "boxwood/operator.hpp"
#include "primitives/primitives_support.hpp"

namespace boxwood::test {

template <class T>
std::vector<Operator> operators() {
    if constexpr (std::is_same_v<T, Aabb>)
        return {Operator::sum};
    else
        return {Operator::sum, Operator::min, Operator::max};
}

/// One scalar component being folded; for floats with what bounds the rounding of a sum: its magnitude.
template <class S>
struct Folded {
    using Wide = std::conditional_t<std::is_floating_point_v<S>, double, S>;
    Wide value{};
    Wide magnitude{};

    static Folded start(Operator op) {
        using Limits = std::numeric_limits<S>;
        const S low = Limits::has_infinity ? -Limits::infinity() : Limits::lowest();
        const S high = Limits::has_infinity ? Limits::infinity() : Limits::max();
        return {static_cast<Wide>(op == Operator::sum ? S{0} : op == Operator::min ? high : low), Wide{0}};
    }
    void add(S next, Operator op) {
        const Wide wide = static_cast<Wide>(next);
        if (op == Operator::min) {
            value = std::min(value, wide);
        } else if (op == Operator::max) {
            value = std::max(value, wide);
        } else if constexpr (std::is_same_v<S, std::int32_t>) { // wraps, as on the device
            value = static_cast<S>(static_cast<std::uint32_t>(value) + static_cast<std::uint32_t>(next));
        } else {
            value = value + wide;
            if constexpr (std::is_floating_point_v<S>) magnitude += std::abs(wide);
        }
    }
    /// Minimum, maximum and integers: exact. Sums of floats: within 100 roundings of the sum of magnitudes, which a
    /// fold of depth below 100 cannot pass (tiles of 1024 in rows: at most 16 + 63 + 6 additions deep each level).
    bool accepts(S actual, Operator op) const {
        if constexpr (std::is_floating_point_v<S>) {
            if (op == Operator::sum) {
                const double bound = 100.0 * std::numeric_limits<S>::epsilon() * magnitude;
                return std::abs(static_cast<double>(actual) - value) <= bound;
            }
        }
        return static_cast<Wide>(actual) == value;
    }
};

/// The running fold of one element type.
template <class T>
struct Oracle {
    explicit Oracle(Operator op_) : op(op_), folded(Folded<T>::start(op_)) {}
    void add(const T& next) { folded.add(next, op); }
    bool accepts(const T& actual) const { return folded.accepts(actual, op); }
    Operator op;
    Folded<T> folded;
};
/// Four components.
template <class T, class S>
struct Oracle4 {
    explicit Oracle4(Operator op_) : op(op_) { std::fill_n(folded, 4, Folded<S>::start(op_)); }
    void add(const T& next) {
        for (int k = 0; k < 4; ++k) folded[k].add(next.s[k], op);
    }
    bool accepts(const T& actual) const {
        for (int k = 0; k < 4; ++k)
            if (!folded[k].accepts(actual.s[k], op)) return false;
        return true;
    }
    Operator op;
    Folded<S> folded[4];
};
template <>
struct Oracle<cl_float4> : Oracle4<cl_float4, float> {
    using Oracle4::Oracle4;
};
template <>
struct Oracle<cl_ulong4> : Oracle4<cl_ulong4, cl_ulong> {
    using Oracle4::Oracle4;
};
template <>
struct Oracle<Aabb> {
    explicit Oracle(Operator) {
        std::fill_n(low, 3, Folded<float>::start(Operator::min));
        std::fill_n(high, 3, Folded<float>::start(Operator::max));
    }
    void add(const Aabb& next) {
        for (int k = 0; k < 3; ++k) {
            low[k].add(next.min[k], Operator::min);
            high[k].add(next.max[k], Operator::max);
        }
    }
    bool accepts(const Aabb& actual) const {
        for (int k = 0; k < 3; ++k)
            if (!low[k].accepts(actual.min[k], Operator::min) || !high[k].accepts(actual.max[k], Operator::max))
                return false;
        return true;
    }
    Folded<float> low[3], high[3];
};

/// Checks `actual` against the fold of values[first .. last - 1].
template <class T>
void check_fold(const T& actual, const std::vector<T>& values, std::size_t first, std::size_t last, Operator op) {
    Oracle<T> oracle(op);
    for (std::size_t i = first; i < last; ++i) oracle.add(values[i]);
    CHECK(oracle.accepts(actual));
}

} // namespace boxwood::test
