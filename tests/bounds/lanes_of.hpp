// SPDX-License-Identifier: MIT
// Runs a wrapper kernel over records of floats with one lane, eight and sixteen, which must give the same bits.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <vector>

#include "runtime/launch.hpp"
#include "support.hpp"

namespace boxwood::test {

/// `count` rounded up to what any number of lanes divides.
inline std::size_t padded(std::size_t count) { return (count + 15) / 16 * 16; }

/// Component k of record i to k * count + i, `count` being the padded number of records; the last record is repeated.
template <std::size_t size>
std::vector<float> by_components(const std::vector<std::array<float, size>>& records) {
    const std::size_t count = padded(records.size());
    std::vector<float> values(size * count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < size; ++k) values[k * count + i] = records[std::min(i, records.size() - 1)][k];
    return values;
}

/// Runs `kernel` (inputs, an output, count), which treats LANES records per work-item, over the records of `inputs`.
/// `start`: what the output holds before.
template <std::size_t out_size, class... Inputs>
std::vector<std::array<float, out_size>>
in_lanes(KernelRef kernel, const std::vector<std::array<float, out_size>>& start, const Inputs&... inputs) {
    Device& device = test_device();
    const std::size_t count = padded(start.size());
    const std::vector<float> initial = by_components(start);
    std::vector<float> results[3];
    const char* const lanes[3] = {"1", "8", "16"};
    for (int k = 0; k < 3; ++k) {
        const Guarded<float> out(device, initial.size());
        write(device, initial, out.view());
        kernel.defines["LANES"] = lanes[k];
        launch(device, kernel, kernel.name.c_str(), count, upload(device, by_components(inputs), "input")...,
               out.view(), static_cast<std::uint32_t>(count));
        results[k] = out.values();
        CHECK(out.intact());
    }
    CHECK(same_bits(results[0], results[1]));
    CHECK(same_bits(results[0], results[2]));
    std::vector<std::array<float, out_size>> records(start.size());
    for (std::size_t i = 0; i < records.size(); ++i)
        for (std::size_t k = 0; k < out_size; ++k) records[i][k] = results[1][k * count + i];
    return records;
}

template <std::size_t out_size, class... Inputs>
std::vector<std::array<float, out_size>> in_lanes(const std::string& file, const std::string& kernel,
                                                  const std::vector<std::array<float, out_size>>& start,
                                                  const Inputs&... inputs) {
    return in_lanes({file, kernel, {}}, start, inputs...);
}

} // namespace boxwood::test
