// SPDX-License-Identifier: MIT
// What PoCL takes from the environment of the process, and where it stumbles over it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace boxwood {

/// By the name of an OpenCL platform.
inline bool is_pocl(std::string_view platform) { return platform == "Portable Computing Language"; }

/// Build option with which PoCL leaves out Clang's declarations of all built-in functions (the guard of opencl-c.h),
/// most of its time for a small program; those that the text calls must stand in it (cl/runtime/builtins.h).
constexpr const char* pocl_without_builtins = " -D_OPENCL_H_";

/// To be called before PoCL starts its threads, one for each CPU from 0 on: has them pinned (POCL_AFFINITY=1) unless
/// the user set that otherwise or the process may not run on each of those CPUs, where PoCL would abort, or leave the
/// CPUs that the process was confined to.
void pin_pocl_threads();

/// True when this process may run on each CPU from 0 to `count` - 1.
bool may_run_on_first_cpus(std::size_t count);

/// Why PoCL cannot keep compiled kernels, without which it finds no device and compiles nothing: names the folder and
/// the system's reason. Empty when it can.
std::string pocl_cache_fault();

} // namespace boxwood
