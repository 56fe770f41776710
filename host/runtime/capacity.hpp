// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "boxwood/device.hpp"

namespace boxwood {

/// A buffer that is going to be asked for.
struct BufferNeed {
    const char* label;
    std::uint64_t count;
    std::uint64_t element_bytes;
};

/// Throws CapacityError unless all of these fit the device together: the limits of make_buffer, asked for at once,
/// after giving back what is pooled if that is needed. `what` they are for is named in the message.
void check_fits(Device& device, std::span<const BufferNeed> needs, const char* what);

} // namespace boxwood
