// SPDX-License-Identifier: MIT
#include "boxwood/buffer.hpp"

#include <algorithm>
#include <limits>

#include "boxwood/error.hpp"
#include "runtime/device_state.hpp"

namespace boxwood::detail {

namespace {

void check(cl_int status, const char* call) {
    if (status != CL_SUCCESS) throw DeviceError(status, call, "", "");
}

} // namespace

Memory::~Memory() { state_->release({handle_, bytes_}, pooled_); }

std::unique_ptr<Memory> allocate(Device& device, std::size_t count, std::size_t element_bytes, const char* label,
                                 bool pooled) {
    // Kernels index with 32-bit integers and use the top bit as a mark.
    constexpr std::size_t most_elements = std::numeric_limits<std::int32_t>::max();
    if (count > most_elements) throw CapacityError(std::string("elements of ") + label, count, most_elements);
    const std::size_t bytes = std::max<std::size_t>(count, 1) * element_bytes;
    const DeviceState::Allocation allocation = device.state().allocate(bytes, label, pooled);
    return std::make_unique<Memory>(device.shared_state(), allocation.handle, allocation.bytes, pooled);
}

void write(Device& device, cl_mem target, const void* source, std::size_t bytes, std::size_t offset) {
    if (bytes == 0) return;
    check(clEnqueueWriteBuffer(device.state().queue(), target, CL_TRUE, offset, bytes, source, 0, nullptr, nullptr),
          "clEnqueueWriteBuffer");
}

void read(Device& device, cl_mem source, std::size_t offset, void* target, std::size_t bytes) {
    if (bytes == 0) return;
    check(clEnqueueReadBuffer(device.state().queue(), source, CL_TRUE, offset, bytes, target, 0, nullptr, nullptr),
          "clEnqueueReadBuffer");
}

void copy(Device& device, cl_mem source, cl_mem target, std::size_t bytes) {
    if (bytes == 0) return;
    check(clEnqueueCopyBuffer(device.state().queue(), source, target, 0, 0, bytes, 0, nullptr, nullptr),
          "clEnqueueCopyBuffer");
}

void fill(Device& device, cl_mem target, const void* pattern, std::size_t pattern_bytes, std::size_t bytes) {
    if (bytes == 0) return;
    check(clEnqueueFillBuffer(device.state().queue(), target, pattern, pattern_bytes, 0, bytes, 0, nullptr, nullptr),
          "clEnqueueFillBuffer");
}

} // namespace boxwood::detail
