// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <numeric>
#include <string>

#include "boxwood/buffer.hpp"
#include "boxwood/error.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

namespace {

/// True when `make` throws a CapacityError with these numbers, both of them also in its text.
template <class Make>
bool refuses(Make&& make, std::uint64_t asked, std::uint64_t available) {
    try {
        make();
    } catch (const CapacityError& error) {
        const std::string what = error.what();
        return error.asked == asked && error.available == available &&
               what.find(std::to_string(asked)) != std::string::npos &&
               what.find(std::to_string(available)) != std::string::npos && what.find("big") != std::string::npos;
    }
    return false;
}

std::vector<std::uint32_t> counting(std::size_t count) {
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 7u);
    return values;
}

} // namespace

TEST_CASE("buffer: what is written is read, copied and filled") {
    Device& device = test_device();
    const std::vector<std::uint32_t> values = counting(1001);
    const Buffer<std::uint32_t> source = upload(device, values, "source");
    CHECK(download(device, source) == values);
    Guarded<std::uint32_t> target(device, 1001);
    copy(device, source.view(), target.view());
    CHECK(target.values() == values);
    write(device, std::vector<std::uint32_t>{1, 2, 3}, target.view());
    CHECK(target.values()[2] == 3);
    CHECK(target.values()[3] == values[3]);
    write(device, std::vector<std::uint32_t>{4, 5}, target.view(), 999);
    CHECK(target.values()[998] == values[998]);
    CHECK(target.values()[999] == 4);
    CHECK(target.values()[1000] == 5);
    fill(device, target.view().prefix(500), 9);
    CHECK(target.values()[499] == 9);
    CHECK(target.values()[500] == values[500]);
    CHECK(target.intact());
    CHECK(download(device, source.prefix(3)) == std::vector<std::uint32_t>{7, 8, 9});
}

TEST_CASE("buffer: no elements are a valid buffer") {
    Device& device = test_device();
    Buffer<std::uint32_t> none = upload(device, std::vector<std::uint32_t>{}, "none");
    CHECK(none.size() == 0);
    CHECK(download(device, none).empty());
    CHECK_NOTHROW(fill(device, none, 1));
    CHECK_NOTHROW(copy(device, none.view(), none.view()));
    CHECK(download(device, Buffer<float>()).empty());
}

TEST_CASE("buffer: capacity errors carry both numbers, and nothing stays held") {
    Device device(std::to_string(test_device().info().index));
    const std::uint64_t largest = device.info().largest_buffer_bytes, memory = device.info().global_bytes;
    const std::uint64_t most_elements = 0x7fffffff;
    CHECK(refuses([&] { make_buffer<char>(device, most_elements + 1, "big"); }, most_elements + 1, most_elements));
    struct Page {
        char bytes[4096];
    };
    const std::uint64_t pages = largest / sizeof(Page) + 1;
    CHECK(refuses([&] { make_buffer<Page>(device, pages, "big"); }, pages * sizeof(Page), largest));
    CHECK(refuses([&] { make_scratch<Page>(device, pages, "big"); }, pages * sizeof(Page), largest));
    CHECK(device.held_bytes() == 0);

    // Up to the device's memory by buffers that are never touched, of which a CPU device takes no page. (Oclgrind
    // does.)
    if (small_sizes()) return;
    std::vector<Buffer<Page>> held;
    while (device.held_bytes() + largest <= memory && held.size() < 1000)
        held.push_back(make_buffer<Page>(device, largest / sizeof(Page), "filler"));
    const std::uint64_t full = device.held_bytes();
    const std::uint64_t rest = (memory - full) / sizeof(Page) + 1;
    if (rest * sizeof(Page) <= largest)
        CHECK(refuses([&] { make_buffer<Page>(device, rest, "big"); }, full + rest * sizeof(Page), memory));
    CHECK(device.held_bytes() == full);
    held.clear();
    CHECK(device.held_bytes() == 0);
    CHECK(device.peak_bytes() == full);
}

TEST_CASE("buffer: scratch is pooled, counted and given back") {
    Device device(std::to_string(test_device().info().index));
    CHECK(device.held_bytes() == 0);
    cl_mem first = nullptr;
    {
        Buffer<float> scratch = make_scratch<float>(device, 10000, "scratch");
        first = scratch.view().handle();
        CHECK(device.held_bytes() == 40000);
        Buffer<float> other = make_scratch<float>(device, 10000, "scratch");
        CHECK(other.view().handle() != first);
        CHECK(device.held_bytes() == 80000);
    }
    CHECK(device.held_bytes() == 80000); // pooled scratch counts
    {
        Buffer<float> again = make_scratch<float>(device, 9000, "scratch");
        CHECK(device.held_bytes() == 80000); // reused, though smaller
        Buffer<float> tiny = make_scratch<float>(device, 1, "scratch");
        CHECK(device.held_bytes() == 80004); // a block many times too large is not wasted on it
        Buffer<float> plain = make_buffer<float>(device, 10000, "plain");
        CHECK(device.held_bytes() == 120004); // what is not scratch does not come from the pool
    }
    CHECK(device.held_bytes() == 80004);
    CHECK(device.peak_bytes() == 120004);
    device.reset_peak();
    CHECK(device.peak_bytes() == 80004);
    device.trim();
    CHECK(device.held_bytes() == 0);
}
