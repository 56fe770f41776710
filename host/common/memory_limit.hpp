// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace boxwood {

/// What limits of this process's address space and data (RLIMIT_AS, RLIMIT_DATA) leave beside what it has mapped, in
/// bytes. The largest number without any. `root` is the folder to read proc/ from.
std::uint64_t process_limit(const std::filesystem::path& root = "/");

/// The most memory that this process can have beside what it has mapped already, in bytes: process_limit(),
/// or the limits of its control group and the groups around it, version 1 or 2. `root` is the folder to read proc/ and
/// sys/ from.
std::uint64_t memory_limit(const std::filesystem::path& root = "/");

/// What a device that lives in the memory of the process can use of a limit: a quarter, or 256 MiB where that is more,
/// is left to the compiler and to the host's own arrays.
std::uint64_t usable_by_device(std::uint64_t limit);

} // namespace boxwood
