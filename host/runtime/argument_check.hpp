// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/device_state.hpp"
#include "runtime/launch.hpp"

namespace boxwood::detail {

/// Compares arguments with the compiled kernel's parameters: throws DeviceError for one of another type, and for a
/// buffer of const elements that the kernel may write. Parameters whose type is a name made in a kernel file ("node_t")
/// are not compared. `kernel` was compiled with -cl-kernel-arg-info; where the driver has no such information nothing
/// is.
void check_arguments(const cl::Kernel& kernel, const Argument* arguments, cl_uint count);

} // namespace boxwood::detail
