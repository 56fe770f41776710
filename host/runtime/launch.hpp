// SPDX-License-Identifier: MIT
// The one way to run a kernel: typed arguments, a label for the profile, checks before the work.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>

#include "boxwood/buffer.hpp"
#include "boxwood/device.hpp"
#include "runtime/opencl_type.hpp"

namespace boxwood {

/// Macros that specialise a program, in a fixed order so that equal sets share one compiled program.
using Defines = std::map<std::string, std::string>;

/// A kernel: file below its root, function name, and the macros to compile it with. Every program also gets
/// GROUP_SIZE from the device's tuning.
struct KernelRef {
    std::string file;
    std::string name;
    Defines defines = {};
    std::string source = {}; ///< Text in place of cl/runtime/inserted.h.
};

/// How a launch over `count` elements is cut: `slices` work-items with `length` consecutive elements each (the last
/// may have fewer).
struct Slices {
    std::uint32_t slices = 0;
    std::uint32_t length = 0;
};

/// Cuts `count` elements by the device's tuning, each slice a multiple of `multiple` elements and none longer than all of them,
/// so that the work-items that fill up the last group begin behind the end and not, beyond 2^32, at the front. {0, 0} for none.
Slices cut(const Device& device, std::size_t count, std::size_t multiple = 1);

/// The most slices that cut() can make, however many work-items there are. Scratch for so many does not depend on the number of
/// compute units, which are threads on a CPU: the same work takes the same memory.
std::size_t most_slices(const Device& device, std::size_t count, std::size_t multiple = 1);

namespace detail {

/// A value for a kernel's parameter, and what type that must have (see argument_check.hpp).
struct Argument {
    const void* value;
    std::size_t bytes;
    std::string_view type; ///< As OpenCL C writes it; a pointer's is that of its elements.
    bool pointer;
    bool writes; ///< Not through a pointer to const.
};

void enqueue(Device& device, const KernelRef& kernel, const char* label, std::size_t work_items,
             const Argument* arguments, std::size_t argument_count);

template <class T>
Argument to_argument(const BufferView<T>& view) {
    return {&view.handle(), sizeof(cl_mem), opencl_type<std::remove_const_t<T>>(), true, !std::is_const_v<T>};
}

template <class T>
requires(std::is_arithmetic_v<T> && !std::is_same_v<T, bool> && sizeof(T) <= 8) Argument to_argument(const T& value) {
    return {&value, sizeof(T), opencl_type<T>(), false, false};
}

/// A shared struct, by value.
template <class T>
requires(std::is_class_v<T>&& std::is_trivially_copyable_v<T>) Argument to_argument(const T& value) {
    return {&value, sizeof(T), opencl_type<T>(), false, false};
}

/// Buffers as views of mutable elements, const ones of const elements; other values as they are.
template <class T>
const T& to_value(const T& value) {
    return value;
}
template <class T>
BufferView<T> to_value(Buffer<T>& buffer) {
    return buffer;
}
template <class T>
BufferView<const T> to_value(const Buffer<T>& buffer) {
    return buffer;
}

template <class... T>
void launch_values(Device& device, const KernelRef& kernel, const char* label, std::size_t work_items,
                   const T&... values) {
    const Argument arguments[] = {to_argument(values)..., {}};
    enqueue(device, kernel, label, work_items, arguments, sizeof...(T));
}

} // namespace detail

/// Enqueues `kernel` over `work_items` work-items, rounded up to whole groups (kernels test their index). Arguments
/// are Buffer, BufferView, arithmetic values or shared structs of the kernel's exact parameter types, in its order; a const Buffer or
/// a view of const elements where it only reads. No work-items: no launch. Throws ProgramError when it does not compile, DeviceError
/// when the arguments do not fit or it cannot run.
template <class... Arguments>
void launch(Device& device, const KernelRef& kernel, const char* label, std::size_t work_items,
            Arguments&&... arguments) {
    detail::launch_values(device, kernel, label, work_items, detail::to_value(arguments)...);
}

/// Compiles `kernel` without running it, so that the time is not spent in a measurement.
void compile(Device& device, const KernelRef& kernel);

} // namespace boxwood
