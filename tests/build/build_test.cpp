// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/requirements.hpp"
#include "build/built_trees.hpp"
#include "build/capacity.hpp"
#include "oracles/wide_cost.hpp"
#include "support.hpp"
#include "tree_image/tree_walker.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

InfluenceArea area_along_z() {
    return {.origin = {1.0, 0.0, 9.0}, .half_width = 6.0, .half_height = 4.0, .far = 18.0, .share = 0.5};
}

std::vector<BuildOptions> all_options() {
    std::vector<BuildOptions> all;
    for (const Levels levels : {Levels::one, Levels::two})
        for (const Layout layout : {Layout::binary, Layout::wide8})
            for (const auto& [builder, morton] : {std::pair{Builder::lbvh, MortonBits::bits30},
                                                  {Builder::lbvh, MortonBits::bits63},
                                                  {Builder::sah, MortonBits::bits30},
                                                  {Builder::midpoint, MortonBits::bits30}})
                all.push_back({levels, layout, builder, morton});
    return all;
}

/// Every kind of oriented boxes, in one level and in two.
std::vector<BuildOptions> oriented_options() {
    std::vector<BuildOptions> all;
    for (const Levels levels : {Levels::one, Levels::two})
        for (const Bounds kind : all_bounds())
            if (kind != Bounds::aabb) all.push_back({.levels = levels, .bounds = {.kind = kind}});
    return all;
}

TreeImage build_image(const Scene& scene, const BuildOptions& options, BuildReport* report = nullptr) {
    return download(test_device(), build(test_device(), scene, options, report));
}

/// Three meshes placed eight times: mirrored, uneven, sheared, flattened, far from the origin.
Scene placed_scene() {
    Scene scene =
        scene_of({random_mesh(60, 1.0f, 0.2f, 1), random_mesh(1, 1.0f, 1.0f, 2), random_mesh(7, 3.0f, 0.5f, 3)});
    const auto place = [&](std::uint32_t mesh, glm::vec3 x, glm::vec3 y, glm::vec3 z, glm::vec3 t) {
        scene.instances.push_back(
            {"", mesh, glm::mat4(glm::vec4(x, 0), glm::vec4(y, 0), glm::vec4(z, 0), glm::vec4(t, 1))});
    };
    place(0, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {5, 0, 0});
    place(0, {0.36f, 0.48f, -0.8f}, {-0.8f, 0.6f, 0}, {0.48f, 0.64f, 0.6f}, {1e6f, -1e6f, 3e6f});
    place(1, {1e-3f, 0, 0}, {0, 7, 0}, {0, 0, 300}, {0.1f, 0.2f, 0.3f});
    place(2, {1, 2, 3}, {0, 1, 4}, {5, 6, 0}, {-7, 0.3f, 1e-9f});
    place(0, {1e-6f, 0, 0}, {0, 1e-6f, 0}, {0, 0, -1e-6f}, {1000, 1000, 1000});
    return scene;
}

/// Vertices of the primitives below each slot that are outside its box, in double.
template <class Node, class Leaf, class Outside>
std::size_t outside_below(const std::vector<Node>& nodes, std::uint32_t root, const Leaf& leaf_points,
                          const Outside& outside, std::vector<glm::dvec3>& points) {
    std::size_t wrong = 0;
    const Node& node = nodes[root];
    for (std::uint32_t slot = 0; slot < detail::tree_check::used_slots(node); ++slot) {
        std::vector<glm::dvec3> below;
        const std::uint32_t child = detail::tree_check::reference_of(node, slot);
        if (child & BOXWOOD_LEAF)
            leaf_points(child & ~BOXWOOD_LEAF, below);
        else
            wrong += outside_below(nodes, child, leaf_points, outside, below);
        for (const glm::dvec3& p : below) wrong += outside(node, slot, p) ? 1 : 0;
        points.insert(points.end(), below.begin(), below.end());
    }
    return wrong;
}

struct IsOutside {
    template <class Node>
    bool operator()(const Node& node, std::uint32_t slot, const glm::dvec3& p) const {
        const Aabb box = detail::tree_check::slot_box(node, slot);
        for (int k = 0; k < 3; ++k)
            if (!(double(box.min[k]) <= p[k] && p[k] <= double(box.max[k]))) return true;
        return false;
    }
    bool operator()(const OrientedNode& node, std::uint32_t slot, const glm::dvec3& p) const {
        if (node.child[slot] & BOXWOOD_ALIGNED) return operator()<OrientedNode>(node, slot, p);
        const float* box = node.volume[slot];
        const glm::dvec3 from_center = p - glm::dvec3(box[0], box[1], box[2]);
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(glm::dot(glm::dvec3(box[6 + k], box[9 + k], box[12 + k]), from_center)) <= box[3 + k]))
                return true;
        return false;
    }
};
constexpr IsOutside is_outside;

void add_points(const Mesh& mesh, std::uint32_t primitive, std::vector<glm::dvec3>& points) {
    for (int k = 0; k < 3; ++k) points.emplace_back(mesh.positions[mesh.triangles[primitive][k]]);
}

std::size_t outside_bottom(const TreeImage& image, const Mesh& mesh, std::uint32_t root) {
    std::vector<glm::dvec3> all;
    const auto add_leaf = [&](std::uint32_t leaf, auto& points) {
        add_points(mesh, image.triangles[leaf].primitive, points);
    };
    if (image.bounds != Bounds::aabb) return outside_below(image.oriented_nodes, root, add_leaf, is_outside, all);
    if (image.layout == Layout::binary) return outside_below(image.binary_nodes, root, add_leaf, is_outside, all);
    return outside_below(
        image.wide_nodes, root,
        [&](std::uint32_t leaf, auto& points) {
            for (const std::uint32_t primitive : image.blocks[leaf].primitive)
                if (primitive != BOXWOOD_NONE) add_points(mesh, primitive, points);
        },
        is_outside, all);
}

std::size_t outside_top(const TreeImage& image, const Scene& scene) {
    std::vector<glm::dvec3> all;
    const auto leaf_points = [&](std::uint32_t instance, std::vector<glm::dvec3>& points) {
        const glm::dmat4 to_world(scene.instances[instance].transform);
        const Mesh& mesh = scene.meshes[scene.instances[instance].mesh];
        // Of 35,947 vertices of the bunny's scan 1,113 are in no triangle, and in no box.
        std::vector<bool> used(mesh.positions.size(), false);
        for (const glm::uvec3& triangle : mesh.triangles) used[triangle.x] = used[triangle.y] = used[triangle.z] = true;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i]) points.emplace_back(to_world * glm::dvec4(mesh.positions[i], 1.0));
    };
    if (image.bounds != Bounds::aabb) return outside_below(image.oriented_top, 0, leaf_points, is_outside, all);
    return image.layout == Layout::binary ? outside_below(image.binary_top, 0, leaf_points, is_outside, all)
                                          : outside_below(image.wide_top, 0, leaf_points, is_outside, all);
}

void check_valid(const Scene& scene, const BuildOptions& options) {
    const TreeImage image = build_image(scene, options);
    CHECK(image.bounds == options.bounds.kind);
    if (options.layout != Layout::automatic) CHECK(image.layout == options.layout);
    CHECK(image.levels == options.levels);
    CHECK_NOTHROW(validate(image, scene, "built"));
    if (options.levels == Levels::one) {
        CHECK(outside_bottom(image, flatten(scene).meshes[0], 0) == 0);
        return;
    }
    for (const InstanceRecord& record : image.instances)
        CHECK(outside_bottom(image, scene.meshes[record.mesh], record.root) == 0);
    CHECK(outside_top(image, scene) == 0);
}

} // namespace

TEST_CASE("build: an empty scene gives an empty tree") {
    for (const BuildOptions& options : all_options()) {
        Scene scene;
        BuildReport report;
        report.nodes = 7;
        const TreeImage image = build_image(scene, options, &report);
        CHECK(image.layout == options.layout);
        CHECK_NOTHROW(validate(image, scene, "built"));
        CHECK(report.nodes == 0);
        CHECK(report.max_depth == 0);
    }
}

TEST_CASE("build: valid trees whose boxes enclose everything, at every layout, level and code length") {
    for (const BuildOptions& options : all_options()) {
        CAPTURE(name(options.layout));
        CAPTURE(name(options.levels));
        for (const std::size_t count : {1u, 2u, 3u, 300u}) {
            CAPTURE(count);
            check_valid(scene_of({random_mesh(count, 1.0f, 0.3f, count)}), options);
        }
        check_valid(placed_scene(), options);
    }
}

TEST_CASE("build: valid trees of every kind of oriented boxes, which enclose everything") {
    for (const BuildOptions& options : oriented_options()) {
        CAPTURE(name(options.bounds.kind));
        CAPTURE(name(options.levels));
        // 1: a root over one leaf; 300: several levels. Meshes of one triangle among others, and mirrored, sheared,
        // flattened and distant instances, are in the placed scene.
        for (const std::size_t count : {1u, 2u, small_sizes() ? 20u : 300u}) {
            CAPTURE(count);
            check_valid(scene_of({random_mesh(count, 1.0f, 0.3f, count)}), options);
        }
        check_valid(placed_scene(), options);
        CHECK(build_image(Scene{}, options).bounds == options.bounds.kind);
    }
}

TEST_CASE("build: real scenes, every kind of oriented boxes, which enclose everything") {
    if (scenes_folder().empty() || small_sizes()) {
        MESSAGE("skipped: real scenes (BOXWOOD_SCENES is not set, or sizes are kept small)");
        return;
    }
    std::size_t checked = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes_folder())) {
        if (entry.path().extension() != ".glb") continue;
        CAPTURE(entry.path());
        const Scene scene = load_gltf(entry.path());
        if (scene.instanced_triangle_count() > 100'000) continue; // every ancestor of every vertex takes a while
        ++checked;
        for (const BuildOptions& options : oriented_options()) {
            CAPTURE(name(options.bounds.kind));
            CAPTURE(name(options.levels));
            check_valid(scene, options);
        }
    }
    CHECK(checked > 0);
}

TEST_CASE("build: the layout follows the volumes, and wide8 refuses oriented boxes") {
    const Scene scene = scene_of({random_mesh(9, 1, 1, 1)});
    CHECK(build_image(scene, {}).layout == Layout::wide8);
    CHECK(build_image(scene, {.bounds = {.kind = Bounds::obb_points}}).layout == Layout::binary);
    const BuildOptions wide{.layout = Layout::wide8, .bounds = {.kind = Bounds::obb_points}};
    for (const Scene& each : {scene, Scene{}}) {
        try {
            build(test_device(), each, wide);
            FAIL("did not throw");
        } catch (const InputError& error) {
            CHECK(error.where == "wide8");
            CHECK(std::string(error.what()).find("obb-points") != std::string::npos);
            CHECK(std::string(error.what()).find("binary") != std::string::npos);
        }
    }
    CHECK(words(requirements(scene, wide)) == std::vector<std::string>{"oriented-boxes"});
}

TEST_CASE("build: meshes without an instance, and an instance that is not the identity") {
    Scene scene =
        scene_of({random_mesh(5, 1, 1, 1), random_mesh(small_sizes() ? 270 : 900, 1, 1, 2), random_mesh(3, 1, 1, 3)});
    scene.instances.erase(scene.instances.begin() + 1);
    scene.instances[0].transform[3] = glm::vec4(100, 0, 0, 1);
    for (const BuildOptions& options : all_options()) check_valid(scene, options);
    scene.instances.resize(1);
    for (const BuildOptions& options : all_options()) check_valid(scene, options);
}

TEST_CASE("build: automatic levels are two when a mesh is placed twice, else one") {
    const Scene once = scene_of({random_mesh(5, 1, 1, 1), random_mesh(6, 1, 1, 2)});
    Scene twice = once;
    twice.instances.push_back(twice.instances[0]);
    CHECK(build_image(once, {}).levels == Levels::one);
    CHECK(build_image(twice, {}).levels == Levels::two);
    CHECK(words(requirements(once, {})) == std::vector<std::string>{"instance-lookup"});
    CHECK(words(requirements(twice, {})) == std::vector<std::string>{"two-levels"});
    CHECK(words(requirements(scene_of({random_mesh(5, 1, 1, 1)}), {})).empty());
    CHECK(build_image(once, {}).first_triangles == std::vector<std::uint32_t>{0, 5, 11});
    // Areas need one level; blend makes no trees of them.
    const BuildOptions areas{.areas = {area_along_z()}}, blend{.builder = Builder::blend, .areas = {area_along_z()}};
    CHECK(build_image(twice, areas).levels == Levels::one);
    CHECK(words(requirements(twice, areas)) == std::vector<std::string>{"instance-lookup", "influence-areas"});
    CHECK(words(requirements(twice, blend)) == std::vector<std::string>{"instance-lookup"});
}

TEST_CASE("build: areas of an empty scene are checked and reported like those of any") {
    BuildOptions options{.areas = {area_along_z(), area_along_z()}};
    BuildReport report;
    CHECK(build(test_device(), Scene{}, options, &report).empty());
    REQUIRE(report.areas.size() == 2);
    CHECK(report.areas[1].triangles == 0);
    options.areas[1].far = std::numeric_limits<double>::quiet_NaN();
    for (const Scene& scene : {Scene{}, scene_of({random_mesh(5, 1, 1, 1)})}) {
        std::string where;
        try {
            build(test_device(), scene, options);
        } catch (const InputError& error) {
            where = error.where;
        }
        CHECK(where == "area 1");
    }
}

TEST_CASE("build: the same bytes every time and at every tuning") {
    for (const Levels levels : {Levels::one, Levels::two}) {
        std::vector<BuildOptions> kinds{{.layout = Layout::binary},
                                        {.layout = Layout::wide8},
                                        {.builder = Builder::sah},
                                        {.builder = Builder::midpoint},
                                        {.bounds = {.kind = Bounds::obb_refined}}};
        // The volumes of every kind of oriented boxes alone are in obb_volumes_test.cpp.
        if (small_sizes()) kinds.pop_back();
        if (levels == Levels::one)
            for (const Builder builder : {Builder::pah, Builder::blend})
                kinds.push_back({.builder = builder, .areas = {area_along_z()}});
        for (const BuildOptions& volumes : kinds) {
            BuildOptions options = volumes;
            options.levels = levels;
            const TreeImage expected = build_image(placed_scene(), options);
            CHECK(same_trees(build_image(placed_scene(), options), expected));
            for (const Tuning& tuning : tunings()) {
                CAPTURE(tuning.group_size);
                const TuningScope scope(tuning);
                CHECK(same_trees(build_image(placed_scene(), options), expected));
            }
        }
    }
}

TEST_CASE("build: scratch of former work is not missing") {
    if (small_sizes()) {
        MESSAGE("skipped: fills the device's memory");
        return;
    }
    Device& device = test_device();
    const DeviceInfo& info = device.info();
    const std::uint64_t largest = std::min<std::uint64_t>(info.largest_buffer_bytes, 1u << 30);
    for (const Levels levels : {Levels::one, Levels::two}) {
        std::vector<Buffer<unsigned char>> scratch;
        while (device.held_bytes() < info.global_bytes) {
            const std::uint64_t left = info.global_bytes - device.held_bytes();
            scratch.push_back(make_scratch<unsigned char>(device, std::min(left, largest), "scratch"));
        }
        scratch.clear();
        CHECK(device.held_bytes() == info.global_bytes);
        CHECK_NOTHROW(build(device, placed_scene(), {.levels = levels}));
    }
}

TEST_CASE("build: each of 50 meshes has the tree that it has alone") {
    std::vector<Mesh> meshes;
    for (std::uint32_t i = 0; i < 50; ++i) meshes.push_back(random_mesh(1 + 7 * i % 40, 1.0f, 0.1f, i));
    for (const Builder builder : {Builder::lbvh, Builder::sah}) {
        const TreeImage all = build_image(scene_of(meshes), {Levels::two, Layout::binary, builder});
        std::uint32_t first = 0;
        for (const Mesh& mesh : meshes) {
            TreeImage alone = build_image(scene_of({mesh}), {Levels::one, Layout::binary, builder});
            const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
            for (BinaryNode& node : alone.binary_nodes)
                for (std::uint32_t& child : node.child)
                    if (child != BOXWOOD_NONE) child += first;
            const auto part = [&](const auto& from) {
                return std::remove_cvref_t<decltype(from)>(from.begin() + first, from.begin() + first + count);
            };
            CHECK(same_bits(part(all.binary_nodes), alone.binary_nodes));
            CHECK(same_bits(part(all.triangles), alone.triangles));
            first += count;
        }
    }
}

TEST_CASE("build: a scene scaled by a power of two has the same tree, scaled") {
    const Mesh mesh = random_mesh(500, 1.0f, 0.1f, 4);
    for (const Builder builder : {Builder::lbvh, Builder::sah}) {
        const BuildOptions options{Levels::one, Layout::wide8, builder, MortonBits::bits63};
        const TreeImage plain = build_image(scene_of({mesh}), options);
        for (const int k : {-60, -40, 40, 59}) {
            CAPTURE(k);
            Mesh scaled = mesh;
            for (glm::vec3& p : scaled.positions) p = {std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k)};
            TreeImage expected = plain;
            for (Wide8Node& node : expected.wide_nodes)
                for (auto* bounds : {&node.min_x, &node.max_x, &node.min_y, &node.max_y, &node.min_z, &node.max_z})
                    for (float& x : *bounds) x = std::ldexp(x, k);
            for (Triangle4& b : expected.blocks)
                for (auto* lanes : {&b.v0_x, &b.v0_y, &b.v0_z, &b.v1_x, &b.v1_y, &b.v1_z, &b.v2_x, &b.v2_y, &b.v2_z})
                    for (float& x : *lanes) x = std::ldexp(x, k);
            CHECK(same_trees(build_image(scene_of({scaled}), options), expected));
        }
    }
}

TEST_CASE("build: of positions and indices, the tree of a scene of that one mesh") {
    const Mesh mesh = random_mesh(300, 1.0f, 0.2f, 11);
    Device& device = test_device();
    const TreeImage expected = build_image(scene_of({mesh}), {.builder = Builder::sah});
    BuildReport report;
    const Tree tree = build(device, mesh.positions, mesh.triangles, {.builder = Builder::sah}, &report);
    CHECK(same_trees(download(device, tree), expected));
    CHECK(report.nodes == tree.node_count());
    CHECK(build(device, mesh.positions, std::span<const glm::uvec3>()).empty());
    const std::vector<glm::uvec3> beyond{{0, 1, 900}};
    CHECK_THROWS_AS(build(device, mesh.positions, beyond), InputError);
    const std::vector<glm::vec3> broken{{0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<float>::quiet_NaN(), 0}};
    CHECK_THROWS_AS(build(device, broken, std::vector<glm::uvec3>{{0, 1, 2}}), InputError);
}
