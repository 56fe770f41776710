// SPDX-License-Identifier: MIT
// Which dialect of OpenCL C kernels are compiled as.
#pragma once

#include <string>
#include <vector>

#include <CL/cl.h>

namespace boxwood::detail {

/// What a device says of itself.
struct LanguageOffer {
    std::string version;                       ///< CL_DEVICE_VERSION.
    std::vector<cl_version> dialects = {};     ///< CL_DEVICE_OPENCL_C_ALL_VERSIONS; none before OpenCL 3.0.
    cl_device_atomic_capabilities atomics = 0; ///< CL_DEVICE_ATOMIC_MEMORY_CAPABILITIES; 0 before OpenCL 3.0.
};

/// "CL3.0" where the device has it with the atomics that the hand-off between work-groups is written with, of acquire
/// and release at device scope, which OpenCL 3.0 leaves to choice (cl/runtime/handoff.h). Else "CL1.2", whose hand-off
/// rests on fences, which commit what was written to memory; "" where the device does not have that either.
std::string choose_language(const LanguageOffer& offer);

} // namespace boxwood::detail
