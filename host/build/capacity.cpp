// SPDX-License-Identifier: MIT
#include "build/capacity.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>

#include "boxwood/error.hpp"
#include "build/builder.hpp"
#include "build/topdown.hpp"
#include "shared/aabb.h"
#include "shared/instance.h"
#include "shared/obb.h"
#include "volumes/obb_kinds.hpp"

namespace boxwood {

namespace {

/// Node indices (two per primitive) and a mark share 32 bits.
constexpr std::uint64_t most_primitives = (1u << 30) - 1;

/// Elements of one buffer.
constexpr std::uint64_t most_elements = std::numeric_limits<std::int32_t>::max();

/// The vertices of all triangles in sorted order, while oriented boxes are fitted.
std::uint64_t sorted_bytes(Bounds bounds, std::uint64_t triangles) { return reads_points(bounds) ? 36 * triangles : 0; }

/// The moments of all nodes.
std::uint64_t moment_bytes(Bounds bounds, std::uint64_t triangles) {
    return bounds == Bounds::obb_moments ? 2 * sizeof(float) * BOXWOOD_MOMENT_FLOATS * triangles : 0;
}

/// While a level over `primitives` is built from the top down.
TopDownBytes split_bytes(const Device& device, Builder builder, std::uint64_t primitives) {
    if (builder == Builder::lbvh || primitives == 0) return {};
    return topdown_bytes(device, primitives, topdown_options(builder, 1).bins);
}

struct Need {
    const char* what;
    std::uint64_t bytes;
};

void check_each(const Device& device, std::initializer_list<Need> needs) {
    for (const Need& need : needs)
        if (need.bytes > device.info().largest_buffer_bytes)
            throw CapacityError("bytes in one buffer of " + device.info().name + " for " + need.what, need.bytes,
                                device.info().largest_buffer_bytes);
}

} // namespace

void check_capacity(Device& device, const BuildOptions& options, std::uint64_t triangles, std::uint64_t vertices,
                    std::uint64_t instances) {
    const Bounds bounds = options.bounds.kind;
    for (const std::uint64_t primitives : {triangles, instances})
        if (primitives > most_primitives)
            throw CapacityError("primitives in one level of a tree", primitives, most_primitives);

    for (const std::uint64_t bytes : {sorted_bytes(bounds, triangles), moment_bytes(bounds, triangles)})
        if (bytes / sizeof(float) > most_elements)
            throw CapacityError("floats in one array of a build with " + std::string(name(bounds)),
                                bytes / sizeof(float), most_elements);

    const bool oriented = bounds != Bounds::aabb;
    constexpr std::uint64_t topology_bytes = 24; // by primitive
    const std::uint64_t positions = 12 * vertices, indices = 12 * triangles;
    const std::uint64_t volumes = 2 * sizeof(Aabb) * triangles, topology = topology_bytes * triangles;
    const std::uint64_t boxes = oriented ? 2 * sizeof(Obb) * triangles : 0, sorted = sorted_bytes(bounds, triangles);
    const std::uint64_t moments = moment_bytes(bounds, triangles);
    const std::uint64_t binary_nodes = (oriented ? sizeof(OrientedNode) : sizeof(BinaryNode)) * triangles;
    const std::uint64_t records = sizeof(Triangle) * triangles;
    const std::uint64_t costs = 32 * triangles, blocks = sizeof(Triangle4) * (triangles / 4);
    const std::uint64_t placed = sizeof(InstanceRecord) * instances;
    const std::uint64_t top = 2 * (oriented ? sizeof(Obb) : sizeof(Aabb)) * instances;
    const TopDownBytes splits = split_bytes(device, options.builder, triangles);
    const TopDownBytes top_splits = split_bytes(device, options.builder, instances);
    check_each(device, {{"vertex positions", positions},
                        {"triangle indices", indices},
                        {"boxes of nodes", volumes},
                        {"records of primitives", std::max(splits.largest, top_splits.largest)},
                        {"oriented boxes of nodes", boxes},
                        {"sorted points", sorted},
                        {"moments of nodes", moments},
                        {"instances", placed},
                        {"boxes of the top level", top}});
    if (options.layout == Layout::binary)
        check_each(device, {{"binary nodes", binary_nodes}, {"triangle records", records}});
    else
        check_each(device, {{"collapse costs", costs}, {"triangle blocks", blocks}});

    // What is held at once at the least: while nodes are split, while the oriented boxes are fitted to the sorted
    // vertices, while the layout is written from topology and volumes, or beside it all while the top level is built.
    // What lbvh holds before there are nodes, at most 82 bytes by primitive when all have their codes in a later round,
    // is less than the last.
    const std::uint64_t result = options.layout == Layout::binary ? binary_nodes + records : blocks;
    const std::uint64_t top_level =
        (topology_bytes + sizeof(Aabb)) * instances + std::max(top_splits.all, 2 * sizeof(Aabb) * instances);
    const std::uint64_t least = positions + indices + topology + placed +
                                std::max({sizeof(Aabb) * triangles + splits.all, volumes + boxes + sorted + moments,
                                          volumes + boxes + result + top_level});
    const auto available = [&] {
        return device.info().global_bytes - std::min(device.held_bytes(), device.info().global_bytes);
    };
    if (least > available()) device.trim();
    if (least > available())
        throw CapacityError("bytes of memory of " + device.info().name + " for the build", least, available());
}

} // namespace boxwood
