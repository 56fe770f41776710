// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "boxwood/collapse.hpp"
#include "build/built_trees.hpp"
#include "oracles/reference_obb.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("layout");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Boxes that tell their nodes apart; every third is aligned, which the layout must then take from the AABBs.
std::vector<Obb> boxes_of(std::size_t nodes) {
    Random random(50);
    std::vector<Obb> boxes(nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
        boxes[i] = box_around(random_rows(random, true), {glm::dvec3(static_cast<double>(i))}, 1.0);
        boxes[i].aligned = i % 3 == 0 ? 1 : 0;
    }
    return boxes;
}

struct Slot {
    float volume[15];
    std::uint32_t reference;
};

/// The slot for node `child` of the topology, or for nothing.
Slot expected_slot(std::uint32_t child, const BuiltTrees& built, const std::vector<Obb>& boxes, bool triangles) {
    Slot slot{{infinity, infinity, infinity, -infinity, -infinity, -infinity}, BOXWOOD_NONE};
    if (child == BOXWOOD_NONE) return slot;
    const std::uint32_t count = built.topology.size();
    slot.reference = child;
    if (child >= count)
        slot.reference = BOXWOOD_LEAF | (triangles ? child - count : built.topology.order[child - count]);
    if (boxes[child].aligned) {
        slot.reference |= BOXWOOD_ALIGNED;
        std::copy_n(built.volumes[child].min, 3, slot.volume);
        std::copy_n(built.volumes[child].max, 3, slot.volume + 3);
    } else {
        store_volume(boxes[child], slot.volume);
    }
    return slot;
}

std::size_t wrong_slots(const OrientedLayout& layout, const BuiltTrees& built, const std::vector<Obb>& boxes,
                        bool triangles) {
    const std::vector<OrientedNode> nodes = download(test_device(), layout.nodes);
    const std::vector<cl_uint2> children = layout_children(built.topology);
    REQUIRE(nodes.size() == children.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (int slot = 0; slot < 2; ++slot) {
            const Slot expected = expected_slot(children[i].s[slot], built, boxes, triangles);
            wrong += nodes[i].child[slot] != expected.reference ||
                     std::memcmp(nodes[i].volume[slot], expected.volume, sizeof expected.volume) != 0;
        }
    }
    return wrong;
}

void check(const Scene& scene) {
    Device& device = test_device();
    const BuiltTrees built = build_trees_of(device, scene);
    const Topology& topology = built.trees.topology;
    const BufferView<const Aabb> volumes = built.trees.volumes;
    const std::vector<Obb> boxes = boxes_of(built.volumes.size());
    const Buffer<Obb> uploaded = upload(device, boxes, "oriented boxes");
    const OrientedLayout layout = collapse_oriented(device, topology, volumes, uploaded, &built.geometry);
    CHECK(wrong_slots(layout, built, boxes, true) == 0);
    // What does not depend on volumes is that of the other binary layout, which has tests of its own.
    const BinaryLayout binary = collapse_binary(device, topology, volumes, &built.geometry);
    CHECK(same_bits(download(device, layout.leaves), download(device, binary.leaves)));
    CHECK(layout.depth == binary.depth);

    // The boxes of triangles stand in for those of instances.
    const OrientedLayout top = collapse_oriented(device, topology, volumes, uploaded);
    CHECK(wrong_slots(top, built, boxes, false) == 0);
    CHECK(top.leaves.size() == 0);
    CHECK(top.depth == layout.depth);
}

} // namespace

TEST_CASE("collapse_oriented: both children in each node, aligned ones by their exact AABB") {
    for (const std::size_t count : {1u, 2u, 3u, 257u, small_sizes() ? 300u : 3001u}) {
        CAPTURE(count);
        check(scene_of({random_mesh(count, 1.0f, 0.1f, count)}));
    }
    std::vector<Mesh> meshes;
    for (const std::size_t size : {1u, 2u, 1u, small_sizes() ? 270u : 700u, 3u, 1u, 40u})
        meshes.push_back(random_mesh(size, 1, 0.1f, size));
    check(scene_of(meshes));
}

TEST_CASE("collapse_oriented: right at every tuning") {
    for (const Tuning& tuning : tunings()) {
        CAPTURE(tuning.group_size);
        const TuningScope scope(tuning);
        check(scene_of({random_mesh(1, 1, 1, 1), random_mesh(small_sizes() ? 270 : 900, 1, 0.1f, 4)}));
    }
}
