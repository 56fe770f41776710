// SPDX-License-Identifier: MIT
#include "boxwood/bounds.hpp"

#include "common/words.hpp"

namespace boxwood {

namespace {

constexpr Words<Bounds, 7> kinds = {{{"aabb", Bounds::aabb},
                                     {"obb-points", Bounds::obb_points},
                                     {"obb-boxes", Bounds::obb_boxes},
                                     {"obb-quaternion", Bounds::obb_quaternion},
                                     {"obb-cascade", Bounds::obb_cascade},
                                     {"obb-moments", Bounds::obb_moments},
                                     {"obb-refined", Bounds::obb_refined}}};
constexpr Words<Extents, 2> extent_choices = {{{"exact", Extents::exact}, {"corners", Extents::corners}}};
constexpr Words<Measure, 2> measures = {{{"volume", Measure::volume}, {"area", Measure::area}}};

} // namespace

std::string_view name(Bounds kind) { return word_of(kinds, kind); }
std::string_view name(Extents extents) { return word_of(extent_choices, extents); }
std::string_view name(Measure measure) { return word_of(measures, measure); }
Bounds to_bounds(std::string_view word) { return value_of(kinds, "bounds", word); }
Extents to_extents(std::string_view word) { return value_of(extent_choices, "extents", word); }
Measure to_measure(std::string_view word) { return value_of(measures, "measure", word); }

std::vector<Bounds> all_bounds() {
    std::vector<Bounds> all;
    for (const auto& entry : kinds) all.push_back(entry.second);
    return all;
}

} // namespace boxwood
