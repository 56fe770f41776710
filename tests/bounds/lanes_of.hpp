// SPDX-License-Identifier: MIT
// Runs a wrapper kernel over records of floats with one lane and with eight, which must give the same bits.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <vector>

#include "runtime/launch.hpp"
#include "support.hpp"

namespace boxwood::test {

/// Component k of record i to k * count + i, `count` being the number of records rounded up to a multiple of eight; the
/// last record is repeated.
template <std::size_t size>
std::vector<float> by_components(const std::vector<std::array<float, size>>& records) {
    const std::size_t count = (records.size() + 7) / 8 * 8;
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
    const std::size_t count = (start.size() + 7) / 8 * 8;
    const std::vector<float> initial = by_components(start);
    std::vector<float> results[2];
    const char* const lanes[2] = {"1", "8"};
    for (int k = 0; k < 2; ++k) {
        const Guarded<float> out(device, initial.size());
        write<float>(device, initial, out.view());
        kernel.defines["LANES"] = lanes[k];
        launch(device, kernel, kernel.name.c_str(), count, upload(device, by_components(inputs), "input")...,
               out.view(), static_cast<std::uint32_t>(count));
        results[k] = out.values();
        CHECK(out.intact());
    }
    CHECK(same_bits(results[0], results[1]));
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
