// SPDX-License-Identifier: MIT
// A top-down builder that splits by a measure of one's own, an OpenCL function. What it may use is in the installed
// share/boxwood/cl/build/strategies.h.
#include <cstdint>
#include <iostream>
#include <vector>

#include <boxwood/topdown.hpp>

int main() {
    boxwood::Device device;
    // Eight unit cubes in a row along x.
    std::vector<boxwood::Aabb> cubes;
    for (int i = 0; i < 8; ++i) {
        const float x = 2.0f * static_cast<float>(i);
        cubes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
    }
    boxwood::TopDownOptions options;
    options.source = "inline float width(const Distribution* d, Box box) {\n"
                     "    return extent_of(box).x / extent_of(d->root).x;\n"
                     "}\n";
    options.measure = "width";
    const boxwood::TopDownTree tree =
        boxwood::topdown(device, boxwood::upload(device, cubes, "cubes"), {},
                         boxwood::upload(device, std::vector<std::uint32_t>{0, 8}, "trees"), {}, {}, options);
    std::cout << tree.splits << " splits\n";
    return tree.splits == 7 ? 0 : 1;
}
