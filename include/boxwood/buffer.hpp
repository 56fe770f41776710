// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

#include <CL/cl.h>

#include "boxwood/device.hpp"

namespace boxwood {

namespace detail {

/// One device allocation; returns to the pool or the device when destroyed.
class Memory {
public:
    Memory(std::shared_ptr<DeviceState> state, cl_mem handle, std::size_t bytes, bool pooled)
        : state_(std::move(state)), handle_(handle), bytes_(bytes), pooled_(pooled) {}
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    cl_mem handle() const { return handle_; }

private:
    std::shared_ptr<DeviceState> state_;
    cl_mem handle_;
    std::size_t bytes_;
    bool pooled_;
};

std::unique_ptr<Memory> allocate(Device& device, std::size_t count, std::size_t element_bytes, const char* label,
                                 bool pooled);
void write(Device& device, cl_mem target, const void* source, std::size_t bytes, std::size_t offset = 0);
void read(Device& device, cl_mem source, std::size_t offset, void* target, std::size_t bytes);
void copy(Device& device, cl_mem source, cl_mem target, std::size_t bytes);
void fill(Device& device, cl_mem target, const void* pattern, std::size_t pattern_bytes, std::size_t bytes);

} // namespace detail

/// Non-owning view of the first size() elements of a device buffer, of the caller's own too. T may be const: what takes such a view
/// only reads.
template <class T>
class BufferView {
public:
    BufferView() = default;
    BufferView(cl_mem handle, std::size_t size) : handle_(handle), size_(size) {}
    /// A view of mutable elements is a view of const elements.
    template <class U>
    requires(std::is_same_v<T, const U>) BufferView(const BufferView<U>& other)
        : handle_(other.handle()), size_(other.size()) {}

    std::size_t size() const { return size_; }
    const cl_mem& handle() const { return handle_; }
    /// The first `count` elements, count <= size().
    BufferView prefix(std::size_t count) const { return BufferView(handle_, count); }

private:
    cl_mem handle_ = nullptr;
    std::size_t size_ = 0;
};

/// Owning array of size() elements in device memory. Move-only. Freed when destroyed, after the work enqueued on it. A const one
/// is only read.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_const_v<T>);

public:
    Buffer() = default;
    Buffer(std::unique_ptr<detail::Memory> memory, std::size_t size) : memory_(std::move(memory)), size_(size) {}

    std::size_t size() const { return size_; }
    BufferView<T> view() { return {handle(), size_}; }
    BufferView<const T> view() const { return {handle(), size_}; }
    operator BufferView<T>() { return view(); }
    operator BufferView<const T>() const { return view(); }
    /// The first `count` elements, count <= size().
    BufferView<T> prefix(std::size_t count) { return view().prefix(count); }
    BufferView<const T> prefix(std::size_t count) const { return view().prefix(count); }

private:
    cl_mem handle() const { return memory_ ? memory_->handle() : nullptr; }

    std::unique_ptr<detail::Memory> memory_;
    std::size_t size_ = 0;
};

namespace detail {

template <class Array>
struct ElementOf;
template <class T>
struct ElementOf<Buffer<T>> {
    using type = T;
};
template <class T>
struct ElementOf<BufferView<T>> {
    using type = std::remove_const_t<T>;
};

} // namespace detail

/// The type of the elements of a Buffer or BufferView.
template <class Array>
using element_t = typename detail::ElementOf<std::remove_cvref_t<Array>>::type;

/// A Buffer or a BufferView. Functions that take one deduce the type of its elements.
template <class Array>
concept DeviceArray = requires {
    typename element_t<Array>;
};

/// A buffer of `count` elements with undefined contents. `label` names it in errors. Throws CapacityError when it
/// passes the device's largest buffer or what is left of its memory.
template <class T>
Buffer<T> make_buffer(Device& device, std::size_t count, const char* label) {
    return Buffer<T>(detail::allocate(device, count, sizeof(T), label, false), count);
}

/// Like make_buffer, but taken from and returned to the device's scratch pool.
template <class T>
Buffer<T> make_scratch(Device& device, std::size_t count, const char* label) {
    return Buffer<T>(detail::allocate(device, count, sizeof(T), label, true), count);
}

/// Elements side by side in host memory: std::vector, std::array, std::span.
template <class Range>
concept HostArray = std::ranges::contiguous_range<Range> && std::ranges::sized_range<Range>;

/// A new buffer holding a copy of `source`, whose elements are trivially copyable. The source may be changed when this returns.
template <HostArray Range>
Buffer<std::ranges::range_value_t<Range>> upload(Device& device, const Range& source, const char* label) {
    using T = std::ranges::range_value_t<Range>;
    Buffer<T> buffer = make_buffer<T>(device, std::ranges::size(source), label);
    detail::write(device, buffer.view().handle(), std::ranges::data(source), buffer.size() * sizeof(T));
    return buffer;
}

/// Copies `source` over the elements of `target` from `first` on, which are at least as many.
template <HostArray Range>
void write(Device& device, const Range& source, BufferView<std::ranges::range_value_t<Range>> target,
           std::size_t first = 0) {
    constexpr std::size_t bytes = sizeof(std::ranges::range_value_t<Range>);
    detail::write(device, target.handle(), std::ranges::data(source), std::ranges::size(source) * bytes, first * bytes);
}

/// Waits for the work enqueued and returns the elements.
template <DeviceArray Array>
std::vector<element_t<Array>> download(Device& device, const Array& source) {
    const BufferView<const element_t<Array>> view = source;
    std::vector<element_t<Array>> target(view.size());
    detail::read(device, view.handle(), 0, target.data(), target.size() * sizeof(element_t<Array>));
    return target;
}

/// Waits for the work enqueued and returns one element, index < source.size().
template <DeviceArray Array>
element_t<Array> download_element(Device& device, const Array& source, std::size_t index) {
    const BufferView<const element_t<Array>> view = source;
    element_t<Array> element;
    detail::read(device, view.handle(), index * sizeof element, &element, sizeof element);
    return element;
}

/// Enqueues a copy of all of `source` to the start of `target`, which has at least as many elements.
template <DeviceArray Array>
void copy(Device& device, const Array& source, BufferView<element_t<Array>> target) {
    const BufferView<const element_t<Array>> view = source;
    detail::copy(device, view.handle(), target.handle(), view.size() * sizeof(element_t<Array>));
}

/// Enqueues setting every element to `value`. Elements have 1, 2, 4, 8 or 16 bytes.
template <DeviceArray Array>
void fill(Device& device, Array&& target, const element_t<Array>& value) {
    const BufferView<element_t<Array>> view = target;
    detail::fill(device, view.handle(), &value, sizeof value, view.size() * sizeof value);
}

} // namespace boxwood
