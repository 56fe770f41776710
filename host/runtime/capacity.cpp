// SPDX-License-Identifier: MIT
#include "runtime/capacity.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "boxwood/error.hpp"

namespace boxwood {

void check_fits(Device& device, std::span<const BufferNeed> needs, const char* what) {
    constexpr std::uint64_t most_elements = std::numeric_limits<std::int32_t>::max();
    const DeviceInfo& info = device.info();
    std::uint64_t total = 0;
    for (const BufferNeed& need : needs) {
        if (need.count > most_elements)
            throw CapacityError(std::string("elements of ") + need.label, need.count, most_elements);
        const std::uint64_t bytes = std::max<std::uint64_t>(need.count, 1) * need.element_bytes;
        if (bytes > info.largest_buffer_bytes)
            throw CapacityError("largest buffer of " + info.name + ", in bytes, for " + need.label, bytes,
                                info.largest_buffer_bytes);
        total += bytes;
    }
    if (device.held_bytes() + total > info.global_bytes) device.trim();
    if (device.held_bytes() + total > info.global_bytes)
        throw CapacityError("memory of " + info.name + ", in bytes, for " + what, device.held_bytes() + total,
                            info.global_bytes);
}

} // namespace boxwood
