// SPDX-License-Identifier: MIT
// Whatever the bytes, a list of influence areas is read to records without a NaN, or refused. The first byte of an
// input chooses: 255 is the rest as a file; below that, bytes of a small file are overwritten, three bytes of input
// each.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "boxwood/error.hpp"
#include "io/influence.hpp"

using namespace boxwood;

namespace {

constexpr std::uint8_t raw_file = 255;

const std::string sample =
    R"([{"kind": "plane", "point": [1, 2.5, -3], "direction": [0, -1e2, 0.5], "half_width": 2, "half_height": 1e-1,)"
    R"( "length": 7},)"
    R"( {"kind": "point", "eye": [0, 0, 0], "direction": [1, 0, 0], "fov_x_degrees": 60, "fov_y_degrees": 45.5,)"
    R"( "near": 0.1, "far": 100, "tolerance_degrees": 0.25, "share": 0.5}])";

std::string edited(std::span<const std::uint8_t> input) {
    std::string text = sample;
    for (; input.size() >= 3; input = input.subspan(3))
        text[(input[0] | static_cast<std::size_t>(input[1]) << 8) % text.size()] = static_cast<char>(input[2]);
    return text;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::span<const std::uint8_t> input(data, size);
    if (input.empty()) return 0;
    const bool raw = input.front() == raw_file;
    input = input.subspan(1);
    const std::string text = raw ? std::string(input.begin(), input.end()) : edited(input);
    try {
        double sum = 0;
        for (const InfluenceRecord& record : influence_records(read_areas(text, "fuzz"))) {
            for (int k = 0; k < 3; ++k) sum += record.origin[k] + record.right[k] + record.up[k] + record.forward[k];
            sum += record.half_width + record.half_height + record.far + record.sin_tolerance + record.share;
            if (!std::isfinite(sum) || !(record.near < record.far)) std::abort();
        }
    } catch (const Error&) {
    }
    return 0;
}
