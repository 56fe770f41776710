// SPDX-License-Identifier: MIT
#include "traverse/specialise.hpp"

#include <algorithm>
#include <limits>

#include "boxwood/error.hpp"
#include "common/words.hpp"

namespace boxwood {

namespace {

constexpr Words<Intersector, 2> intersectors = {
    {{"watertight", Intersector::watertight}, {"moeller-trumbore", Intersector::moeller_trumbore}}};

} // namespace

std::string_view name(Intersector intersector) { return word_of(intersectors, intersector); }
Intersector to_intersector(std::string_view word) { return value_of(intersectors, "intersector", word); }

std::uint32_t stack_entries(std::uint64_t needed) {
    // 2^18 entries are 2 MiB per work-item; a tree as deep as that is no tree to trace.
    constexpr std::uint64_t most = 1u << 18;
    if (needed > most) throw CapacityError("traversal stack entries", needed, most);
    std::uint32_t entries = 64;
    while (entries < needed) entries *= 8;
    return entries;
}

std::uint32_t stack_size(const Tree& tree) {
    const std::uint64_t siblings = tree.layout() == Layout::wide8 ? 7 : 1;
    return stack_entries(siblings * (std::uint64_t{tree.max_depth()}));
}

KernelRef traversal_kernel(const Tree& tree, Query query, const TraceOptions& options) {
    const bool any = query == Query::any;
    const bool flattened = !any && tree.arrays().first_triangles.size() != 0;
    return {any ? "traverse/any_hit.cl" : "traverse/closest_hit.cl",
            any ? "any_hit" : "closest_hit",
            {{"LAYOUT", tree.layout() == Layout::wide8 ? "8" : "2"},
             {"ORIENTED", tree.bounds() != Bounds::aabb ? "1" : "0"},
             {"LEVELS", tree.levels() == Levels::two ? "2" : "1"},
             {"FLATTENED", flattened ? "1" : "0"},
             {"AREAS", tree.arrays().areas.size() != 0 ? "1" : "0"},
             {"INTERSECTOR", options.intersector == Intersector::watertight ? "0" : "1"},
             {"STATISTICS", query == Query::closest_with_statistics ? "1" : "0"},
             {"STACK_SIZE", std::to_string(stack_size(tree))},
             {"PORTABLE_LANES", options.portable_lanes ? "1" : "0"}}};
}

Slices cut_rays(const Device& device, std::size_t count) {
    constexpr std::uint32_t longest = 128;
    constexpr std::size_t most_rays = std::numeric_limits<std::uint32_t>::max() / 2;
    if (count == 0) return {};
    if (count > most_rays) throw CapacityError("rays in one batch", count, most_rays);
    const std::uint32_t length = std::min(cut(device, count).length, longest);
    return {static_cast<std::uint32_t>((count - 1) / length + 1), length};
}

} // namespace boxwood
