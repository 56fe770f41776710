// SPDX-License-Identifier: MIT
// Every valid scene of BOXWOOD_SCENES, built by the device and traced, against brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "oracles/brute_force.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

/// Rays from in and around the scene's bounds through points of them.
std::vector<Ray> rays_over(const Scene& scene, std::uint32_t count) {
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const Instance& instance : scene.instances) {
        const auto& positions = scene.meshes[instance.mesh].positions;
        glm::vec3 from = positions[0], to = positions[0];
        for (const glm::vec3& p : positions) from = glm::min(from, p), to = glm::max(to, p);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? from.x : to.x, corner & 2 ? from.y : to.y, corner & 4 ? from.z : to.z);
            const glm::vec3 world(instance.transform * glm::vec4(p, 1.0f));
            low = glm::min(low, world), high = glm::max(high, world);
        }
    }
    Random random(30);
    const auto point = [&](float reach) {
        glm::vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(-reach, reach);
        return 0.5f * (low + high) + 0.5f * (high - low) * p;
    };
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 from = point(1.5f), d = point(1.0f) - from;
        rays.push_back({{from.x, from.y, from.z}, 0.0f, {d.x, d.y, d.z}, std::numeric_limits<float>::infinity()});
    }
    return rays;
}

/// Hits that are not the expected ones: one has none, or t differs by more than 1e-5 of it, or, where t is the same to
/// the bit, so that there is an order among ties, another triangle.
std::size_t count_wrong(const std::vector<Hit>& hits, const std::vector<Hit>& expected) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if ((hits[i].primitive == BOXWOOD_NONE) != (expected[i].primitive == BOXWOOD_NONE)) {
            ++wrong;
        } else if (hits[i].primitive != BOXWOOD_NONE) {
            const bool same = hits[i].primitive == expected[i].primitive && hits[i].instance == expected[i].instance;
            wrong +=
                std::fabs(hits[i].t - expected[i].t) > 1e-5f * expected[i].t || (hits[i].t == expected[i].t && !same);
        }
    }
    return wrong;
}

/// All four kinds of tree of AABBs, two levels first; of many triangles in one level only the usual one. Scenes that
/// are quick also get oriented boxes: the kinds in turn, as each scene counts in `turn`, so that all kinds meet many
/// scenes at the cost of two more trees.
std::vector<Kind> kinds_for(std::uint64_t triangles, std::size_t turn) {
    if (triangles > 5'000'000) return {all_kinds[2], all_kinds[3], all_kinds[1]};
    std::vector<Kind> kinds{all_kinds[2], all_kinds[3], all_kinds[0], all_kinds[1]};
    if (triangles > 100'000) return kinds;
    const std::vector<Bounds> all = all_bounds();
    const Bounds bounds = all[1 + turn % (all.size() - 1)];
    kinds.insert(kinds.begin() + 2, {Layout::binary, Levels::two, bounds});
    kinds.push_back({Layout::binary, Levels::one, bounds});
    return kinds;
}

/// Builds and traces each kind of tree.
void check_scene(const Scene& scene, std::size_t turn) {
    Device& device = test_device();
    const std::uint64_t triangles = scene.instanced_triangle_count();
    const std::uint32_t count = triangles > 10'000'000 ? 500 : triangles > 1'000'000 ? 2000 : 20000;
    const std::vector<Ray> rays = rays_over(scene, count);
    const bool placed = std::any_of(scene.instances.begin(), scene.instances.end(),
                                    [](const Instance& each) { return each.transform != glm::mat4(1.0f); });
    std::vector<Hit> expected = BruteForce(scene, Levels::two).closest_hits(rays);
    bool of_one_level = !placed;
    for (const Kind& kind : kinds_for(triangles, turn)) {
        CAPTURE(words(kind));
        Tree tree;
        try {
            tree =
                build(device, scene, {.levels = kind.levels, .layout = kind.layout, .bounds = {.kind = kind.bounds}});
        } catch (const CapacityError& error) {
            // Flattened, the largest scenes do not fit one buffer of some devices.
            MESSAGE(std::string(error.what()) << ": asked " << error.asked << ", available " << error.available);
            REQUIRE(kind.levels == Levels::one);
            REQUIRE(triangles > 10'000'000);
            continue;
        }
        if (kind.levels == Levels::one && !of_one_level) {
            expected = BruteForce(scene, Levels::one).closest_hits(rays);
            of_one_level = true;
        }
        const Buffer<Ray> source = upload(device, rays, "rays");
        const Guarded<Hit> hits(device, rays.size());
        const Guarded<std::uint32_t> any(device, rays.size());
        closest_hit(device, tree, source, hits.view());
        any_hit(device, tree, source, any.view());
        const std::vector<Hit> found = hits.values();
        CHECK(count_wrong(found, expected) == 0);
        const std::vector<std::uint32_t> flags = any.values();
        std::size_t disagreeing = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            disagreeing += flags[i] != (found[i].primitive == BOXWOOD_NONE ? 0u : 1u);
        CHECK(disagreeing == 0);
    }
}

} // namespace

TEST_CASE("real_scenes: closest hits equal brute force, any hits agree") {
    if (scenes_folder().empty() || small_sizes()) {
        MESSAGE("skipped: real scenes (BOXWOOD_SCENES is not set, or sizes are kept small)");
        return;
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes_folder())) {
        const auto& path = entry.path();
        const bool gltf = path.extension() == ".glb" || path.extension() == ".gltf";
        if (gltf && path.string().find("malformed") == std::string::npos) files.push_back(path);
    }
    std::sort(files.begin(), files.end());
    REQUIRE_FALSE(files.empty());
    std::size_t turn = 0;
    for (const auto& file : files) {
        CAPTURE(file);
        Scene scene;
        try {
            scene = load_gltf(file);
        } catch (const InputError& error) {
            MESSAGE("refused: " << std::string(error.what()));
            continue;
        }
        if (!scene.instances.empty()) check_scene(scene, turn++);
    }
}
