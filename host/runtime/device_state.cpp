// SPDX-License-Identifier: MIT
#include "runtime/device_state.hpp"

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

#include "boxwood/error.hpp"
#include "runtime/kernel_text.hpp"
#include "runtime/pocl.hpp"

namespace boxwood::detail {

namespace {

/// By the call that OpenCL 1.2 has too.
cl::CommandQueue make_queue(const cl::Context& context, const cl::Device& device) {
    cl_int status = CL_SUCCESS;
    const cl_command_queue queue = clCreateCommandQueue(context(), device(), CL_QUEUE_PROFILING_ENABLE, &status);
    if (status != CL_SUCCESS) throw cl::Error(status, "clCreateCommandQueue");
    return cl::CommandQueue(queue);
}

/// Device time of a complete command.
double device_ms(const cl::Event& event) {
    const auto start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
    const auto end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
    return static_cast<double>(end - start) * 1e-6;
}

} // namespace

DeviceState::DeviceState(cl::Device device_, DeviceInfo info_)
    : device(std::move(device_)), info(std::move(info_)), context(device), queue(make_queue(context, device)),
      profiles(true) {}

DeviceState::DeviceState(cl::Context context_, cl::CommandQueue queue_, DeviceInfo info_)
    : device(queue_.getInfo<CL_QUEUE_DEVICE>()), info(std::move(info_)), context(std::move(context_)),
      queue(std::move(queue_)), profiles((queue.getInfo<CL_QUEUE_PROPERTIES>() & CL_QUEUE_PROFILING_ENABLE) != 0) {}

cl::Program DeviceState::compile(const std::string& file, const std::string& text, const std::string& options) const {
    cl::Program built(context, text);
    try {
        built.build(device, options.c_str());
    } catch (const cl::Error& error) {
        if (const std::string fault = is_pocl(info.platform) ? pocl_cache_fault() : ""; !fault.empty())
            throw DeviceError(error.err(), "compiling " + file, "", fault);
        throw ProgramError(file, info.name, options, built.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device), text);
    } catch (const std::bad_alloc&) {
        // From the compiler through PoCL, which still has the program locked: releasing it would wait for ever.
        built() = nullptr;
        throw;
    }
    return built;
}

cl::Program DeviceState::compile_quickly(const std::string& file, const std::string& source,
                                         const std::string& options) const {
    const std::string text = resolve_kernel_text(file, source);
    // A source that came with a launch may call any built-in function, for any type.
    if (is_pocl(info.platform) && source.empty()) {
        try {
            return compile(file, resolve_kernel_text("runtime/builtins.h") + text, options + pocl_without_builtins);
        } catch (const ProgramError&) { // calls a function that is not declared there, or has a fault of its own
        }
    }
    return compile(file, text, options);
}

const cl::Program& DeviceState::program(const std::string& file, const std::string& options,
                                        const std::string& source) {
    const std::string key = file + '\n' + options + '\n' + source;
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;

    const auto start = std::chrono::steady_clock::now();
    cl::Program built = compile_quickly(file, source, options);
    compile_ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return programs_.emplace(key, std::move(built)).first->second;
}

cl::Kernel& DeviceState::kernel(const std::string& file, const std::string& name, const std::string& options,
                                const std::string& source) {
    const std::string key = file + '\n' + options + '\n' + name + '\n' + source;
    if (const auto found = kernels_.find(key); found != kernels_.end()) return found->second;
    try {
        return kernels_.emplace(key, cl::Kernel(program(file, options, source), name.c_str())).first->second;
    } catch (const cl::Error& error) {
        throw DeviceError(error.err(), error.what(), name, "no such kernel in " + file);
    }
}

void DeviceState::count_first_launch(const cl::Kernel& kernel, const cl::Event& event,
                                     std::chrono::steady_clock::time_point start) {
    if (!launched_.insert(kernel()).second) return;
    event.wait();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    compile_ms += std::max(0.0, elapsed.count() - (profiles ? device_ms(event) : 0.0));
}

void DeviceState::record(const char* label, cl::Event event) {
    const auto [found, added] = pass_index_.try_emplace(stage + '\n' + label, profile_.passes.size());
    if (added) profile_.passes.push_back({stage, label, 0, 0.0});
    pending_.push_back({found->second, std::move(event)});
    // Bounds the number of live events; by now nearly all of them are complete.
    constexpr std::size_t most_pending = 4096;
    if (pending_.size() >= most_pending) resolve_pending();
}

void DeviceState::resolve_pending() {
    for (const Pending& launch : pending_) {
        launch.event.wait();
        PassTime& pass = profile_.passes[launch.pass];
        pass.ms += profiles ? device_ms(launch.event) : 0.0;
        ++pass.launches;
    }
    pending_.clear();
}

Profile DeviceState::take_profile() {
    resolve_pending();
    pass_index_.clear();
    return std::exchange(profile_, {});
}

DeviceState::Allocation DeviceState::allocate(std::size_t bytes, const char* label, bool pooled) {
    const std::string what = std::string("device memory for ") + label;
    if (bytes > info.largest_buffer_bytes)
        throw CapacityError("largest buffer of " + info.name + ", in bytes, for " + label, bytes,
                            info.largest_buffer_bytes);
    if (pooled) {
        // An allocation up to half as large again is better reused than a new one made.
        const auto found = pool_.lower_bound(bytes);
        if (found != pool_.end() && found->first <= bytes + bytes / 2 + 4096) {
            const Allocation allocation{found->second, found->first};
            pool_.erase(found);
            return allocation;
        }
    }
    if (held_bytes + bytes > info.global_bytes) trim();
    if (held_bytes + bytes > info.global_bytes)
        throw CapacityError(what + ", in bytes", held_bytes + bytes, info.global_bytes);
    // In the host's memory PoCL would ask for it at the first use, and end the process where there is none left.
    const cl_mem_flags now = info.cpu ? CL_MEM_ALLOC_HOST_PTR : 0;
    cl_int status = CL_SUCCESS;
    cl_mem handle = clCreateBuffer(context(), CL_MEM_READ_WRITE | now, bytes, nullptr, &status);
    if (status != CL_SUCCESS) {
        // What was released is free once the work that uses it is done.
        trim();
        queue.finish();
        handle = clCreateBuffer(context(), CL_MEM_READ_WRITE | now, bytes, nullptr, &status);
    }
    if (status != CL_SUCCESS) throw CapacityError(what + ", in bytes", bytes, info.global_bytes - held_bytes);
    held_bytes += bytes;
    peak_bytes = std::max(peak_bytes, held_bytes);
    return {handle, bytes};
}

void DeviceState::release(const Allocation& allocation, bool pooled) noexcept {
    if (pooled) {
        try {
            pool_.emplace(allocation.bytes, allocation.handle);
            return;
        } catch (...) { // no memory for the pool entry: free the allocation instead
        }
    }
    clReleaseMemObject(allocation.handle);
    held_bytes -= allocation.bytes;
}

void DeviceState::trim() noexcept {
    // Allocations may still be in use by enqueued work; OpenCL frees them after it.
    for (const auto& [bytes, handle] : pool_) {
        clReleaseMemObject(handle);
        held_bytes -= bytes;
    }
    pool_.clear();
}

} // namespace boxwood::detail
