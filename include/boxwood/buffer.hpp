// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
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

/// Non-owning view of the first size() elements of a device buffer. T may be const.
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

/// Owning array of size() elements in device memory. Move-only. Freed when destroyed, after the work enqueued on it.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_const_v<T>);

public:
    Buffer() = default;
    Buffer(std::unique_ptr<detail::Memory> memory, std::size_t size) : memory_(std::move(memory)), size_(size) {}

    std::size_t size() const { return size_; }
    BufferView<T> view() const { return BufferView<T>(memory_ ? memory_->handle() : nullptr, size_); }
    operator BufferView<T>() const { return view(); }
    operator BufferView<const T>() const { return view(); }
    BufferView<T> prefix(std::size_t count) const { return view().prefix(count); }

private:
    std::unique_ptr<detail::Memory> memory_;
    std::size_t size_ = 0;
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

/// A new buffer holding a copy of `source`. The source may be changed when this returns.
template <class T>
Buffer<T> upload(Device& device, const std::vector<T>& source, const char* label) {
    Buffer<T> buffer = make_buffer<T>(device, source.size(), label);
    detail::write(device, buffer.view().handle(), source.data(), source.size() * sizeof(T));
    return buffer;
}

/// Copies `source` over the elements of `target` from `first` on, which are at least as many.
template <class T>
void write(Device& device, std::span<const T> source, BufferView<T> target, std::size_t first = 0) {
    detail::write(device, target.handle(), source.data(), source.size_bytes(), first * sizeof(T));
}

/// Waits for the work enqueued and returns the elements.
template <class T>
std::vector<std::remove_const_t<T>> download(Device& device, BufferView<T> source) {
    std::vector<std::remove_const_t<T>> target(source.size());
    detail::read(device, source.handle(), 0, target.data(), target.size() * sizeof(T));
    return target;
}

template <class T>
std::vector<T> download(Device& device, const Buffer<T>& source) {
    return download(device, source.view());
}

/// Waits for the work enqueued and returns one element, index < source.size().
template <class T>
T download_element(Device& device, const Buffer<T>& source, std::size_t index) {
    T element;
    detail::read(device, source.view().handle(), index * sizeof(T), &element, sizeof(T));
    return element;
}

/// Enqueues a copy of all of `source` to the start of `target`, which has at least as many elements.
template <class T>
void copy(Device& device, BufferView<const T> source, BufferView<T> target) {
    detail::copy(device, source.handle(), target.handle(), source.size() * sizeof(T));
}

/// Enqueues setting every element to `value`. T has 1, 2, 4, 8 or 16 bytes.
template <class T>
void fill(Device& device, BufferView<T> target, const std::type_identity_t<T>& value) {
    detail::fill(device, target.handle(), &value, sizeof(T), target.size() * sizeof(T));
}

} // namespace boxwood
