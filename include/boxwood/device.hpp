// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <CL/cl.h>

#include "boxwood/profile.hpp"

namespace boxwood {

namespace detail {
class DeviceState;
}

/// One OpenCL device as listed by list_devices().
struct DeviceInfo {
    std::size_t index = 0; ///< Position in list_devices(), over all platforms.
    std::string platform;
    std::string name;
    std::string driver;
    std::string version; ///< OpenCL version of the device.
    std::string
        language; ///< OpenCL C dialect that Boxwood compiles for: "CL3.0", "CL1.2", or "" where it cannot be used.
    bool cpu = false;
    std::uint32_t compute_units = 0;
    std::uint64_t global_bytes = 0;         ///< Memory of the device; of a CPU, what limits of the process leave it.
    std::uint64_t largest_buffer_bytes = 0; ///< Largest single allocation.
    bool denormals = false;                 ///< Computes with denormal numbers; else they may count as 0.
    /// Says that it rounds divisions and square roots of floats correctly; it is then asked to. With this and denormals
    /// the device gives the same bytes as every other such device.
    bool correctly_rounded_divide_sqrt = false;
};

/// How work is cut for a device class. Results never depend on it.
struct Tuning {
    std::uint32_t group_size = 1;       ///< Work-items per work-group, 1 or more.
    std::uint32_t work_items = 16;      ///< Work-items that a launch over a long array is cut into.
    std::uint32_t smallest_slice = 256; ///< Elements per work-item below which fewer work-items are used.
    std::uint32_t lanes = 1; ///< Boxes or rays that a work-item treats at once: 1, 8, 16 (cl/runtime/real.h).
};

/// Every OpenCL device with a compiler, in platform order. Empty when there is none (also when there is no platform).
/// Throws DeviceError when limits of the process leave too little memory to load a driver.
std::vector<DeviceInfo> list_devices();

/// An OpenCL device with its in-order queue, compiled programs, memory accounting and profile. First argument of
/// everything that runs on one. Movable; used by one thread at a time.
class Device {
public:
    /// `selector` is an index of list_devices() or a part of a device or platform name (any case). Empty: the
    /// environment variable BOXWOOD_DEVICE, else the first device. Throws DeviceError: listing the devices where none
    /// matches, or where the device lacks a language for the kernels.
    explicit Device(const std::string& selector = "");
    /// Works in the caller's context and on the caller's queue, both retained, so that buffers of that context can be had as a
    /// BufferView and no wait is needed between Boxwood's work and the caller's. The queue executes in order; passes are timed only
    /// if it has profiling enabled. Throws DeviceError for a queue that is out of order or of another context, and as above.
    Device(cl_context context, cl_command_queue queue);
    ~Device();
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;

    const DeviceInfo& info() const;

    const Tuning& tuning() const;
    /// Replaces the tuning of the device class, for experiments and tests. Throws DeviceError when the group size is
    /// 0 or above the device's limit.
    void set_tuning(const Tuning& tuning);

    /// Waits until everything enqueued is done.
    void finish();

    /// Bytes of device memory held now, and the most held since the start or reset_peak(). Pooled scratch counts.
    std::uint64_t held_bytes() const;
    std::uint64_t peak_bytes() const;
    void reset_peak();
    /// Gives pooled scratch memory back to the device.
    void trim();

    /// Milliseconds spent compiling programs so far.
    double compile_ms() const;

    /// Waits, then returns and clears the times of all passes since the last call.
    Profile take_profile();

    /// For the runtime and for tests.
    detail::DeviceState& state() const { return *state_; }
    const std::shared_ptr<detail::DeviceState>& shared_state() const { return state_; }

private:
    std::shared_ptr<detail::DeviceState> state_;
};

} // namespace boxwood
