// SPDX-License-Identifier: MIT
// What is behind a Device: context, queue, program cache, memory accounting, pending profile events.
#pragma once

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_TARGET_OPENCL_VERSION 300
// Debian's opencl.hpp does not compile with a minimum of 1.2; what needs 2.0 is not called on 1.2 devices.
#define CL_HPP_MINIMUM_OPENCL_VERSION 200
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <CL/opencl.hpp>

#include "boxwood/device.hpp"

namespace boxwood::detail {

class DeviceState {
public:
    DeviceState(cl::Device device, DeviceInfo info);
    DeviceState(cl::Context context, cl::CommandQueue queue, DeviceInfo info);

    const cl::Device device;
    const DeviceInfo info;
    const cl::Context context;
    const cl::CommandQueue queue; ///< In order.
    const bool profiles;          ///< Whether the queue times its commands.
    Tuning tuning;
    std::string stage; ///< Name of the innermost Stage.
    double compile_ms = 0.0;
    bool checks_arguments =
        false; ///< Every launch compares its arguments' types with the compiled kernel's; for tests.

    /// The kernel `name` of `file` compiled with `options` and `source` inserted; compiled at most once. Throws
    /// ProgramError.
    cl::Kernel& kernel(const std::string& file, const std::string& name, const std::string& options,
                       const std::string& source = {});

    /// Called after the first launch of a kernel, which is when some devices (PoCL) finish compiling it: waits for it
    /// and counts what was not device time since `start` as compilation.
    void count_first_launch(const cl::Kernel& kernel, const cl::Event& event,
                            std::chrono::steady_clock::time_point start);

    /// Remembers a launch for the profile.
    void record(const char* label, cl::Event event);
    Profile take_profile();

    /// Memory accounting. `allocate` throws CapacityError; `release` takes back what it gave.
    struct Allocation {
        cl_mem handle;
        std::size_t bytes;
    };
    Allocation allocate(std::size_t bytes, const char* label, bool pooled);
    void release(const Allocation& allocation, bool pooled) noexcept;
    void trim() noexcept;
    std::uint64_t held_bytes = 0;
    std::uint64_t peak_bytes = 0;

private:
    struct Pending {
        std::size_t pass;
        cl::Event event;
    };

    /// `text` made from `file`, compiled. Throws ProgramError, and DeviceError where PoCL cannot keep what it compiles.
    cl::Program compile(const std::string& file, const std::string& text, const std::string& options) const;
    /// The same program from fewer declarations where the device's compiler can do with those of runtime/builtins.h.
    cl::Program compile_quickly(const std::string& file, const std::string& source, const std::string& options) const;
    const cl::Program& program(const std::string& file, const std::string& options, const std::string& source);
    void resolve_pending();

    std::map<std::string, cl::Program> programs_;
    std::map<std::string, cl::Kernel> kernels_;
    std::set<cl_kernel> launched_;            ///< Kernels launched at least once.
    std::multimap<std::size_t, cl_mem> pool_; ///< Free scratch by size in bytes.
    std::vector<Pending> pending_;
    std::map<std::string, std::size_t> pass_index_;
    Profile profile_;
};

} // namespace boxwood::detail
