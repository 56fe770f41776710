// SPDX-License-Identifier: MIT
// What the tests of this layer share: sizes around boundaries, inputs by type.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/aabb.h"
#include "support.hpp"
#include "tuning.hpp"

namespace boxwood::test {

/// Elements in a tile of the folds (cl/primitives/operator.h).
inline constexpr std::size_t tile = 1024;

/// Around the boundaries of: nothing, one row of 64 scalars, a group of 64, the shortest slice (256 elements), one
/// tile, several tiles, 32 slices of one tile, two levels of tiles.
inline std::vector<std::size_t> boundary_sizes() {
    if (small_sizes()) return {0, 1, 65, tile - 1, tile + 1};
    return std::vector<std::size_t>{0,
                                    1,
                                    15,
                                    16,
                                    63,
                                    64,
                                    65,
                                    255,
                                    256,
                                    257,
                                    tile - 1,
                                    tile,
                                    tile + 1,
                                    2 * tile,
                                    5001, //
                                    32 * tile - 1,
                                    32 * tile,
                                    32 * tile + 1,
                                    tile * tile - 1,
                                    tile * tile,
                                    tile * tile + 1};
}

template <class T>
struct Make {
    static T value(Random& random) { return static_cast<T>(random.bits()); }
};
template <>
struct Make<float> {
    static float value(Random& random) { return random.uniform(-1.0f, 1.0f); }
};
template <>
struct Make<cl_float4> {
    static cl_float4 value(Random& random) {
        cl_float4 v;
        for (float& s : v.s) s = random.uniform(-1.0f, 1.0f);
        return v;
    }
};
template <>
struct Make<cl_ulong4> {
    static cl_ulong4 value(Random& random) {
        cl_ulong4 v;
        for (cl_ulong& s : v.s) s = random.bits();
        return v;
    }
};
template <>
struct Make<Aabb> {
    static Aabb value(Random& random) {
        Aabb box;
        for (int k = 0; k < 3; ++k) {
            box.min[k] = random.uniform(-1.0f, 1.0f);
            box.max[k] = box.min[k] + random.uniform(0.0f, 0.5f);
        }
        return box;
    }
};

template <class T>
std::vector<T> random_values(std::size_t count, std::uint64_t salt) {
    Random random(salt);
    std::vector<T> values(count);
    for (T& value : values) value = Make<T>::value(random);
    return values;
}

} // namespace boxwood::test
