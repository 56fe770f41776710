// SPDX-License-Identifier: MIT
// The builders by name, and how those from the top down split nodes.
#include "build/builder.hpp"
#include "common/words.hpp"

namespace boxwood {

namespace {

constexpr Words<Builder, 5> builders{{{"lbvh", Builder::lbvh},
                                      {"sah", Builder::sah},
                                      {"midpoint", Builder::midpoint},
                                      {"pah", Builder::pah},
                                      {"blend", Builder::blend}}};

} // namespace

std::string_view name(Builder builder) { return word_of(builders, builder); }
Builder to_builder(std::string_view word) { return value_of(builders, "builder", word); }
bool needs_areas(Builder builder) { return builder == Builder::pah || builder == Builder::blend; }

TopDownOptions topdown_options(Builder builder, std::uint32_t block_size) {
    TopDownOptions options;
    options.block_size = block_size;
    options.stop = "never";
    switch (builder) {
    case Builder::sah:
        options.axes = "all_axes";
        break;
    case Builder::midpoint:
        options.bins = 2;
        options.split_plane_quality = 1.0f; // the longest axis only
        break;
    case Builder::pah: // of trees whose rays follow no area the surface area heuristic
        options.measure = "projected_measure";
        options.axes = "all_axes";
        break;
    case Builder::blend:
        options.measure = "expected_measure";
        options.cost = "overlap_cost";
        options.primitives_per_bin = 1; // more planes to choose from: better trees for a slower build
        options.axes = "all_axes";
        break;
    case Builder::lbvh:
        break;
    }
    return options;
}

} // namespace boxwood
