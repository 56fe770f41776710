// SPDX-License-Identifier: MIT
// Scenes with something small beside something large, whose small part may share one Morton code: what near rays cost
// in the trees of the default builder, those of the surface area heuristic being the measure.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "boxwood/build.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/tree_image.hpp"
#include "build/built_trees.hpp"
#include "oracles/brute_force.hpp"
#include "traverse/scenes.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

std::uint32_t scaled_down(std::uint32_t size) { return small_sizes() ? size / 20 : size; }

void shuffle(Mesh& mesh, Random& random) {
    for (std::size_t i = mesh.triangles.size(); i > 1; --i)
        std::swap(mesh.triangles[i - 1], mesh.triangles[random.below(static_cast<std::uint32_t>(i))]);
}

/// A ball of radius 1; neighbours on it are no neighbours in the file.
Mesh ball(std::uint32_t triangles) {
    Random random(triangles);
    Mesh whole = make_procedural("sphere", {.triangles = triangles}).meshes.at(0);
    Mesh mesh{.name = "", .positions = std::move(whole.positions), .triangles = std::move(whole.triangles)};
    shuffle(mesh, random);
    return mesh;
}

void add_triangle(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// A ball, and one triangle at `distance`.
Mesh with_stray(std::uint32_t triangles, float distance) {
    Mesh mesh = ball(triangles);
    add_triangle(mesh, {distance, 0, 0}, {distance, 1, 0}, {distance, 0, 1});
    return mesh;
}

/// A ball on a plane a thousand times its size, in as many triangles.
Mesh on_ground(std::uint32_t triangles) {
    Random random(3);
    Mesh mesh = ball(triangles);
    const auto side = static_cast<std::uint32_t>(std::sqrt(0.5f * static_cast<float>(triangles)));
    const auto at = [&](std::uint32_t i) {
        return 2000.0f * static_cast<float>(i) / static_cast<float>(side) - 1000.0f;
    };
    for (std::uint32_t i = 0; i < side; ++i) {
        for (std::uint32_t k = 0; k < side; ++k) {
            add_triangle(mesh, {at(i), -1, at(k)}, {at(i), -1, at(k + 1)}, {at(i + 1), -1, at(k)});
            add_triangle(mesh, {at(i + 1), -1, at(k + 1)}, {at(i + 1), -1, at(k)}, {at(i), -1, at(k + 1)});
        }
    }
    shuffle(mesh, random);
    return mesh;
}

/// Triangles through the origin, whose boxes have it as their centre.
Mesh coincident(std::uint32_t triangles) {
    Random random(4);
    Mesh mesh;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const glm::vec3 a(random.uniform(0.1f, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        add_triangle(mesh, a, -a, 0.5f * a + glm::vec3(0, 0.01f * a.y, 0));
    }
    return mesh;
}

/// Small balls in a small cube, but the first, which is at `distance`.
Scene crowd(std::uint32_t instances, float distance) {
    Random random(5);
    Scene scene = single(ball(200));
    scene.instances.clear();
    for (std::uint32_t i = 0; i < instances; ++i) {
        glm::mat4 transform(0.02f);
        const float x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        transform[3] = i == 0 ? glm::vec4(distance, 0, 0, 1) : glm::vec4(x, y, random.uniform(-1, 1), 1);
        scene.instances.push_back({"", 0, transform});
    }
    return scene;
}

/// Rays from the middles of random triangles in random directions: near ones, which a view from outside has none of.
std::vector<Ray> near_rays(const Scene& scene, std::uint32_t count) {
    Random random(6);
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Instance& instance = scene.instances[random.below(static_cast<std::uint32_t>(scene.instances.size()))];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const glm::uvec3 t = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
        const glm::vec3 middle = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
        const glm::vec3 o(instance.transform * glm::vec4(middle, 1));
        const float x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        rays.push_back({{o.x, o.y, o.z}, 0, {x, y, random.uniform(-1, 1)}, std::numeric_limits<float>::infinity()});
    }
    return rays;
}

/// Volumes and triangles tested by ray. Answers are those of `expected`, which is filled when it is empty.
double tests_per_ray(const Scene& scene, const BuildOptions& options, const std::vector<Ray>& rays,
                     std::vector<Hit>& expected) {
    const TreeImage tree = download(test_device(), build(test_device(), scene, options));
    std::vector<RayStatistics> statistics;
    const std::vector<Hit> hits = trace(tree, rays, statistics);
    if (expected.empty()) expected = hits;
    CHECK(count_different(hits, expected) == 0);
    double tests = 0.0;
    for (const RayStatistics& ray : statistics) tests += ray.volumes + ray.primitives;
    return tests / static_cast<double>(rays.size());
}

/// The default builder needs at most twice the tests of `sah`, in either layout and with codes of either length.
void check_tests(const std::string& what, const Scene& scene) {
    CAPTURE(what);
    const std::vector<Ray> rays = near_rays(scene, small_sizes() ? 50 : 500);
    std::vector<Hit> hits;
    for (const Layout layout : {Layout::wide8, Layout::binary}) {
        const double sah = tests_per_ray(scene, {.layout = layout, .builder = Builder::sah}, rays, hits);
        for (const MortonBits bits : {MortonBits::bits30, MortonBits::bits63}) {
            const double lbvh = tests_per_ray(scene, {.layout = layout, .morton = bits}, rays, hits);
            CAPTURE(name(layout));
            CAPTURE(static_cast<int>(bits));
            CAPTURE(lbvh);
            CAPTURE(sah);
            CHECK(lbvh <= 2.0 * sah);
        }
    }
}

/// All, or under a checker the last of them.
std::vector<float> some_of(std::vector<float> distances) {
    if (small_sizes()) distances.erase(distances.begin(), distances.end() - 1);
    return distances;
}

/// The small part in one cell, in two levels also of two meshes beside a third that is not affected.
std::vector<Scene> uneven_scenes() {
    const std::uint32_t size = scaled_down(4000);
    return {single(with_stray(size, 1e6f)), scene_of({with_stray(size, 1e3f), ball(size / 2), with_stray(size, 1e9f)}),
            crowd(size / 4, 1e4f)};
}

} // namespace

TEST_CASE("scales: a stray triangle far from a ball") {
    for (const float distance : some_of({1e2f, 1e3f, 1e4f, 1e6f, 1e9f}))
        check_tests(std::to_string(distance), single(with_stray(scaled_down(20000), distance)));
}

TEST_CASE("scales: an object on a ground plane") { check_tests("ground", single(on_ground(scaled_down(20000)))); }

TEST_CASE("scales: centres that no bits part") { check_tests("coincident", single(coincident(scaled_down(2000)))); }

TEST_CASE("scales: instances close together, and one far away") {
    for (const float distance : some_of({1e3f, 1e6f}))
        check_tests(std::to_string(distance), crowd(scaled_down(5000), distance));
}

TEST_CASE("scales: instances in one place are built in balance; rays must test them all") {
    // 5000 = 8^4.1 instances of one tree.
    Scene scene = crowd(scaled_down(5000), 0.0f);
    for (Instance& instance : scene.instances) instance.transform = glm::mat4(1.0f);
    BuildReport report;
    build(test_device(), scene, {.layout = Layout::binary}, &report);
    const std::uint32_t one_ball =
        build(test_device(), single(scene.meshes[0]), {.layout = Layout::binary}).max_depth();
    CHECK(report.max_depth <= one_ball + 14); // 2^13 > 5000
    scene.instances.resize(100);
    check_tests("one place", scene);
}

TEST_CASE("scales: hits are those of brute force") {
    for (const Scene& scene : uneven_scenes()) {
        const std::vector<Ray> rays = near_rays(scene, 100);
        for (const Levels levels : {Levels::one, Levels::two}) {
            if (levels == Levels::one && scene.instances.size() > 10) continue; // flattened: its own arithmetic
            const TreeImage tree = download(test_device(), build(test_device(), scene, {.levels = levels}));
            CHECK(count_different(trace(tree, rays), BruteForce(scene, levels).closest_hits(rays)) == 0);
        }
    }
}

TEST_CASE("scales: the same bytes at every tuning") {
    for (const Scene& scene : uneven_scenes()) {
        for (const MortonBits bits : {MortonBits::bits30, MortonBits::bits63}) {
            const BuildOptions options{.levels = Levels::two, .layout = Layout::binary, .morton = bits};
            const TreeImage expected = download(test_device(), build(test_device(), scene, options));
            for (const Tuning& tuning : tunings()) {
                CAPTURE(tuning.group_size);
                const TuningScope scope(tuning);
                CHECK(same_trees(download(test_device(), build(test_device(), scene, options)), expected));
            }
        }
    }
}

TEST_CASE("scales: a scene scaled by a power of two has the same tree") {
    Scene scene = single(with_stray(scaled_down(4000), 1e6f));
    const TreeImage plain = download(test_device(), build(test_device(), scene, {.layout = Layout::binary}));
    const std::vector<glm::vec3> positions = scene.meshes[0].positions;
    for (const int power : {-60, -40, 20, 39}) {
        CAPTURE(power);
        for (std::size_t i = 0; i < positions.size(); ++i)
            for (int k = 0; k < 3; ++k) scene.meshes[0].positions[i][k] = std::ldexp(positions[i][k], power);
        const TreeImage scaled = download(test_device(), build(test_device(), scene, {.layout = Layout::binary}));
        TreeImage expected = plain;
        for (BinaryNode& node : expected.binary_nodes)
            for (Aabb& box : node.bounds)
                for (int k = 0; k < 3; ++k) {
                    box.min[k] = std::ldexp(box.min[k], power);
                    box.max[k] = std::ldexp(box.max[k], power);
                }
        for (std::size_t i = 0; i < expected.triangles.size(); ++i) expected.triangles[i] = scaled.triangles[i];
        REQUIRE(plain.triangles.size() == scaled.triangles.size());
        for (std::size_t i = 0; i < plain.triangles.size(); ++i)
            REQUIRE(scaled.triangles[i].primitive == plain.triangles[i].primitive);
        CHECK(same_trees(scaled, expected));
    }
}
