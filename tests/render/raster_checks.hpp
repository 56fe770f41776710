// SPDX-License-Identifier: MIT
// What the tests of the rasteriser ask of every picture.
#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "render/raster_agreement.hpp"

namespace boxwood::test {

/// The same hits in every pixel.
inline void check_agreement(const Agreement& result) {
    CAPTURE(result.pixels);
    CAPTURE(result.different);
    CAPTURE(result.farthest);
    CHECK(result.different == 0);
    CHECK(result.off_edge == 0);
    CHECK(result.wrong == 0);
}

/// One level and two, both layouts.
inline std::vector<BuildOptions> tree_options() {
    std::vector<BuildOptions> all;
    for (const Levels levels : {Levels::one, Levels::two})
        for (const Layout layout : {Layout::wide8, Layout::binary}) {
            BuildOptions options;
            options.levels = levels;
            options.layout = layout;
            all.push_back(options);
        }
    return all;
}

} // namespace boxwood::test
