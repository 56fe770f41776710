// SPDX-License-Identifier: MIT
// Scans of what has an element for every slice of a launch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "boxwood/buffer.hpp"

namespace boxwood::detail {

/// exclusive_scan of sums, with the scratch that `most` elements would take, in.size() or more. O(in.size()).
void exclusive_sums(Device& device, BufferView<const std::uint32_t> in, BufferView<std::uint32_t> out,
                    std::size_t most);

} // namespace boxwood::detail
