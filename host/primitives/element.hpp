// SPDX-License-Identifier: MIT
// How the kernels of this layer see an element type and an operator, and the checks of their arguments.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include <CL/cl.h>

#include "boxwood/error.hpp"
#include "boxwood/operator.hpp"
#include "runtime/launch.hpp"
#include "shared/aabb.h"

namespace boxwood::detail {

/// Elements folded in one go; TILE of cl/primitives/operator.h.
inline constexpr std::size_t tile = 1024;

inline std::size_t tiles_of(std::size_t count) { return count == 0 ? 1 : (count - 1) / tile + 1; }

template <class T>
struct Element;
template <>
struct Element<std::int32_t> {
    using Scalar = std::int32_t;
    static constexpr const char* scalar = "int";
    static constexpr int components = 1;
};
template <>
struct Element<std::uint32_t> {
    using Scalar = std::uint32_t;
    static constexpr const char* scalar = "uint";
    static constexpr int components = 1;
};
template <>
struct Element<std::uint64_t> {
    using Scalar = std::uint64_t;
    static constexpr const char* scalar = "ulong";
    static constexpr int components = 1;
};
template <>
struct Element<float> {
    using Scalar = float;
    static constexpr const char* scalar = "float";
    static constexpr int components = 1;
};
template <>
struct Element<cl_float4> {
    using Scalar = float;
    static constexpr const char* scalar = "float";
    static constexpr int components = 4;
};
template <>
struct Element<cl_ulong4> {
    using Scalar = std::uint64_t;
    static constexpr const char* scalar = "ulong";
    static constexpr int components = 4;
};
template <>
struct Element<Aabb> {
    using Scalar = float;
    static constexpr const char* scalar = "float";
    static constexpr int components = 6;
};

/// The same memory as elements of another type, which a kernel takes it for.
template <class To, class T>
BufferView<To> view_as(const BufferView<T>& view) {
    return {view.handle(), view.size() * sizeof(T) / sizeof(To)};
}

/// As kernels compiled with bits_defines see it.
template <class T>
auto words_of(const BufferView<T>& view) {
    return view_as<std::conditional_t<std::is_const_v<T>, const std::uint32_t, std::uint32_t>>(view);
}

/// As kernels compiled with operator_defines see it.
template <class T>
auto scalars_of(const BufferView<T>& view) {
    using Scalar = typename Element<std::remove_const_t<T>>::Scalar;
    return view_as<std::conditional_t<std::is_const_v<T>, const Scalar, Scalar>>(view);
}

/// Macros for kernels that only move elements: four bytes at a time, so that types of one size share a program.
template <class T>
Defines bits_defines() {
    return {{"SCALAR", "uint"}, {"COMPONENTS", std::to_string(sizeof(T) / sizeof(std::uint32_t))}};
}

/// Throws InputError naming the argument unless `valid`.
inline void require(bool valid, const char* argument, const char* what) {
    if (!valid) throw InputError("arguments", argument, what);
}

/// Macros for kernels that combine elements. Throws InputError for min and max of boxes.
template <class T>
Defines operator_defines(Operator op) {
    require(Element<T>::components != 6 || op == Operator::sum, "op", "boxes have a hull (Operator::sum) only");
    const char* name = op == Operator::sum ? "OP_SUM" : op == Operator::min ? "OP_MIN" : "OP_MAX";
    return {{"SCALAR", Element<T>::scalar}, {"COMPONENTS", std::to_string(Element<T>::components)}, {name, "1"}};
}

/// One level of a reduction: out[b] = the fold of tile b of `in`. `out` has tiles_of(in.size()) elements.
template <class T>
void reduce_tiles(Device& device, BufferView<const T> in, const Defines& defines, BufferView<T> out) {
    const std::size_t count = in.size();
    const Slices slices = count == 0 ? Slices{1, tile} : cut(device, count, tile);
    launch(device, {"primitives/reduce.cl", "reduce", defines}, "reduce", slices.slices, scalars_of(in),
           scalars_of(out), static_cast<cl_uint>(count), slices.length, slices.slices);
}

} // namespace boxwood::detail
