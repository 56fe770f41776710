// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxwood {

/// A kernel file or shared header, embedded at build time by scripts/embed_kernels.cmake.
struct KernelText {
    const char* file; ///< Path below its root, for example "primitives/scan.cl".
    const char* text;
};

/// The files under cl/.
extern const std::vector<KernelText> library_kernels;

/// Makes another table (of tests, say) available to programs. Not for use while a Device compiles.
void add_kernels(const std::vector<KernelText>& table);

/// Names of all files available.
std::vector<std::string> kernel_files();

/// The text of `file` with every `#include "..."` of an embedded file replaced by that file, once, with #line marks.
/// Read from the folder BOXWOOD_KERNEL_DIR instead when that is set and has the file. `inserted`, if any, stands
/// in for runtime/inserted.h and may include embedded files too. Throws ProgramError when a file is missing.
std::string resolve_kernel_text(const std::string& file, const std::string& inserted = {});

} // namespace boxwood
