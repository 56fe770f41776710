// SPDX-License-Identifier: MIT
// The one way to run a kernel: typed arguments, a label for the profile, checks before the work.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <type_traits>

#include "boxwood/buffer.hpp"
#include "boxwood/device.hpp"

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

/// Cuts `count` elements by the device's tuning, each slice a multiple of `multiple` elements and none longer than all
/// of them, so that the work-items that fill up the last group begin behind the end and not, beyond 2^32, at the front.
/// {0, 0} for none.
Slices cut(const Device& device, std::size_t count, std::size_t multiple = 1);

/// The most slices that cut() can make, however many work-items there are. Scratch for so many does not depend on the
/// number of compute units, which are threads on a CPU: the same work takes the same memory.
std::size_t most_slices(const Device& device, std::size_t count, std::size_t multiple = 1);

namespace detail {

struct Argument {
    const void* value;
    std::size_t bytes;
};

void enqueue(Device& device, const KernelRef& kernel, const char* label, std::size_t work_items,
             const Argument* arguments, std::size_t argument_count);

template <class T>
Argument to_argument(const BufferView<T>& view) {
    return {&view.handle(), sizeof(cl_mem)};
}

template <class T>
requires(std::is_arithmetic_v<T> && !std::is_same_v<T, bool> && sizeof(T) <= 8) Argument to_argument(const T& value) {
    return {&value, sizeof(T)};
}

/// A shared struct, by value.
template <class T>
requires(std::is_class_v<T>&& std::is_trivially_copyable_v<T>) Argument to_argument(const T& value) {
    return {&value, sizeof(T)};
}

template <class T>
struct LaunchArgument {
    using type = T;
};
template <class T>
struct LaunchArgument<Buffer<T>> {
    using type = BufferView<T>;
};

template <class... T>
void launch_converted(Device& device, const KernelRef& kernel, const char* label, std::size_t work_items,
                      const T&... values) {
    const Argument arguments[] = {to_argument(values)..., {nullptr, 0}};
    enqueue(device, kernel, label, work_items, arguments, sizeof...(T));
}

} // namespace detail

/// Enqueues `kernel` over `work_items` work-items, rounded up to whole groups (kernels test their index). Arguments
/// are Buffer, BufferView, arithmetic values or shared structs of the kernel's exact parameter types, in its order. No
/// work-items: no launch. Throws ProgramError when it does not compile, DeviceError when the arguments do not fit or it
/// cannot run.
template <class... Arguments>
void launch(Device& device, const KernelRef& kernel, const char* label, std::size_t work_items,
            const Arguments&... arguments) {
    detail::launch_converted<typename detail::LaunchArgument<Arguments>::type...>(device, kernel, label, work_items,
                                                                                  arguments...);
}

/// Compiles `kernel` without running it, so that the time is not spent in a measurement.
void compile(Device& device, const KernelRef& kernel);

} // namespace boxwood
