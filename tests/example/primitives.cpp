// SPDX-License-Identifier: MIT
#include <cstdint>
#include <iostream>
#include <vector>

#include <boxwood/device.hpp>
#include <boxwood/primitives.hpp>

int main() {
    using Words = std::vector<std::uint32_t>;
    boxwood::Device device;

    // Sort values by key, then bring the prices into the same order.
    auto keys = boxwood::upload(device, Words{30, 10, 20, 10}, "keys");
    auto order = boxwood::upload(device, Words{0, 1, 2, 3}, "order");
    boxwood::radix_sort(device, keys, order);

    const auto prices = boxwood::upload(device, std::vector<float>{3.0f, 1.5f, 2.0f, 1.0f}, "prices");
    auto sorted = boxwood::make_buffer<float>(device, 4, "sorted prices");
    boxwood::gather(device, prices, order, sorted);

    // One sum for each run of equal keys: elements 0 and 1, element 2, element 3.
    const auto runs = boxwood::upload(device, Words{0, 2, 3, 4}, "runs");
    auto sums = boxwood::make_buffer<float>(device, 3, "sums");
    boxwood::segmented_reduce(device, sorted, runs, boxwood::Operator::sum, sums);

    // Nothing has been waited for so far; this waits.
    for (const float sum : boxwood::download(device, sums)) std::cout << sum << ' ';
    std::cout << '\n'; // 2.5 2 3
    return boxwood::download(device, sums) == std::vector<float>{2.5f, 2.0f, 3.0f} ? 0 : 1;
}
