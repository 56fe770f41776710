// SPDX-License-Identifier: MIT
#include "runtime/launch.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>

#include "boxwood/error.hpp"
#include "runtime/argument_check.hpp"
#include "runtime/device_state.hpp"

namespace boxwood {

namespace {

std::string build_options(const Device& device, const Defines& defines) {
    std::string options = "-cl-std=" + device.info().language;
    if (device.info().correctly_rounded_divide_sqrt) options += " -cl-fp32-correctly-rounded-divide-sqrt";
    options += " -DGROUP_SIZE=" + std::to_string(device.tuning().group_size);
    if (device.state().checks_arguments) options += " -cl-kernel-arg-info";
    for (const auto& [macro, value] : defines) options += " -D" + macro + "=" + value;
    return options;
}

cl::Kernel& find(Device& device, const KernelRef& kernel) {
    return device.state().kernel(kernel.file, kernel.name, build_options(device, kernel.defines), kernel.source);
}

/// Of `count` elements in slices of at least `shortest`, more where that is needed for a multiple.
Slices slices_of(std::size_t count, std::size_t shortest, std::size_t multiple) {
    const std::size_t length = ((std::min(shortest, count) - 1) / multiple + 1) * multiple;
    return {static_cast<std::uint32_t>((count - 1) / length + 1), static_cast<std::uint32_t>(length)};
}

} // namespace

Slices cut(const Device& device, std::size_t count, std::size_t multiple) {
    if (count == 0) return {};
    const Tuning& tuning = device.tuning();
    const std::size_t even = (count - 1) / tuning.work_items + 1;
    return slices_of(count, std::max<std::size_t>(even, tuning.smallest_slice), multiple);
}

std::size_t most_slices(const Device& device, std::size_t count, std::size_t multiple) {
    return count == 0 ? 0 : slices_of(count, device.tuning().smallest_slice, multiple).slices;
}

void compile(Device& device, const KernelRef& kernel) { find(device, kernel); }

void detail::enqueue(Device& device, const KernelRef& ref, const char* label, std::size_t work_items,
                     const Argument* arguments, std::size_t argument_count) {
    if (work_items == 0) return;
    cl::Kernel& kernel = find(device, ref);
    try {
        const std::size_t wanted = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
        if (wanted != argument_count)
            throw DeviceError(0, std::string("launching ") + label, ref.name,
                              "takes " + std::to_string(wanted) + " arguments, got " + std::to_string(argument_count));
        if (device.state().checks_arguments) check_arguments(kernel, arguments, static_cast<cl_uint>(argument_count));
        for (cl_uint i = 0; i < argument_count; ++i) kernel.setArg(i, arguments[i].bytes, arguments[i].value);
        const std::size_t group = device.tuning().group_size;
        const std::size_t items = ((work_items - 1) / group + 1) * group;
        cl::Event event;
        const auto start = std::chrono::steady_clock::now();
        device.state().queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(group),
                                                  nullptr, &event);
        device.state().count_first_launch(kernel, event, start);
        device.state().record(label, std::move(event));
    } catch (const cl::Error& error) {
        throw DeviceError(error.err(), error.what(), ref.name, label);
    }
}

} // namespace boxwood
