// SPDX-License-Identifier: MIT
// What updates promise apart from hits; those are in tests/traverse/update_test.cpp.
#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "boxwood/error.hpp"
#include "boxwood/update.hpp"
#include "build/built_trees.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

/// Under a checker the kind that takes the most kernels.
std::vector<BuildOptions> two_level_options() {
    std::vector<BuildOptions> all;
    for (const Layout layout : {Layout::wide8, Layout::binary}) all.push_back({Levels::two, layout});
    all.push_back({.levels = Levels::two, .bounds = {.kind = Bounds::obb_moments}});
    if (!small_sizes()) all.push_back({.levels = Levels::two, .bounds = {.kind = Bounds::obb_refined}});
    return all;
}

std::vector<BuildOptions> all_options() {
    std::vector<BuildOptions> all = two_level_options();
    for (BuildOptions options : two_level_options()) {
        options.levels = Levels::one;
        all.push_back(options);
    }
    return all;
}

/// Two meshes, several triangles and one, placed twice each.
Scene small_scene() {
    Scene scene = scene_of({random_mesh(40, 1.0f, 0.2f, 1), random_mesh(1, 1.0f, 1.0f, 2)});
    for (Instance instance : scene_of(scene.meshes).instances) {
        instance.transform[3] = glm::vec4(3, 1, -2, 1);
        scene.instances.push_back(instance);
    }
    return scene;
}

std::vector<glm::mat4> transforms_of(const Scene& scene) {
    std::vector<glm::mat4> transforms;
    for (const Instance& instance : scene.instances) transforms.push_back(instance.transform);
    return transforms;
}

/// A mirror, a shear and a shift.
glm::mat4 bent() {
    glm::mat4 map(1.0f);
    map[0][0] = -1.5f;
    map[1][0] = 0.7f;
    map[3] = glm::vec4(0.25f, 0.5f, 4.0f, 1.0f);
    return map;
}

TreeImage image_of(const AnimatedTree& animated) { return download(test_device(), animated.tree()); }

TreeImage built(const AnimatedTree& animated, const BuildOptions& options) {
    return download(test_device(), build(test_device(), animated.scene(), options));
}

template <class Update>
void check_refused(AnimatedTree& animated, const std::string& where, const Update& update) {
    CAPTURE(where);
    const TreeImage before = image_of(animated);
    const std::vector<glm::mat4> transforms = transforms_of(animated.scene());
    const std::vector<Mesh> meshes = animated.scene().meshes;
    try {
        update();
        FAIL("did not throw");
    } catch (const InputError& error) {
        CHECK(error.where == where);
    }
    CHECK(same_trees(image_of(animated), before));
    CHECK(transforms_of(animated.scene()) == transforms);
    for (std::size_t i = 0; i < meshes.size(); ++i) CHECK(animated.scene().meshes[i].positions == meshes[i].positions);
}

} // namespace

TEST_CASE("update: the top level of moved and deformed instances is that of a build, bit for bit") {
    for (const BuildOptions& options : two_level_options()) {
        CAPTURE(name(options.layout));
        CAPTURE(name(options.bounds.kind));
        AnimatedTree animated(test_device(), small_scene(), options);
        CHECK(same_trees(image_of(animated), built(animated, options)));
        for (int frame = 0; frame < 3; ++frame) {
            std::vector<glm::mat4> transforms = transforms_of(animated.scene());
            for (glm::mat4& transform : transforms) transform = bent() * transform;
            animated.move_instances(transforms);
            CHECK(transforms_of(animated.scene()) == transforms);
            CHECK(same_trees(image_of(animated), built(animated, options)));
            animated.deform(1, bent());
            CHECK(transforms_of(animated.scene())[0] == transforms[0]);
            CHECK(transforms_of(animated.scene())[1] != transforms[1]);
            CHECK(same_trees(image_of(animated), built(animated, options)));
        }
    }
}

TEST_CASE("update: a refit to the same shape changes nothing; a tree refitted to another and back is the first") {
    for (const BuildOptions& options : all_options()) {
        CAPTURE(name(options.layout));
        CAPTURE(name(options.levels));
        CAPTURE(name(options.bounds.kind));
        AnimatedTree animated(test_device(), small_scene(), options);
        const TreeImage first = image_of(animated);
        for (const std::uint32_t mesh : {0u, 1u}) {
            const std::vector<glm::vec3> positions = animated.scene().meshes[mesh].positions;
            std::vector<glm::vec3> others = positions;
            for (glm::vec3& p : others) p = {2.0f * p.y, p.x * p.z, p.z - 1.0f};
            animated.refit(mesh, positions);
            CHECK(same_trees(image_of(animated), first));
            animated.refit(mesh, others);
            CHECK(animated.scene().meshes[mesh].positions == others);
            CHECK_FALSE(same_trees(image_of(animated), first));
            CHECK_NOTHROW(validate(image_of(animated), animated.scene(), "refitted"));
            animated.refit(mesh, positions);
            CHECK(same_trees(image_of(animated), first));
            animated.refit(mesh, others);
            animated.rebuild();
            CHECK(same_trees(image_of(animated), built(animated, options)));
            animated.refit(mesh, positions);
            animated.rebuild();
            CHECK(same_trees(image_of(animated), first));
        }
    }
}

TEST_CASE("update: input that cannot be used is refused, and leaves tree and scene as they were") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    AnimatedTree animated(test_device(), small_scene(), {.levels = Levels::two});
    const std::vector<glm::mat4> good = transforms_of(animated.scene());
    const auto refuse_transform = [&](const glm::mat4& bad) {
        std::vector<glm::mat4> transforms = good;
        transforms[0] = bent();
        transforms[2] = bad;
        check_refused(animated, "transforms[2]", [&] { animated.move_instances(transforms); });
        check_refused(animated, "map", [&] { animated.deform(0, bad); });
    };
    glm::mat4 bad(1.0f);
    bad[1][1] = 0.0f;
    refuse_transform(bad);
    bad[1][1] = infinity;
    refuse_transform(bad);
    bad[1][1] = std::numeric_limits<float>::quiet_NaN();
    refuse_transform(bad);
    bad = glm::mat4(1.0f);
    bad[0][3] = 0.5f;
    refuse_transform(bad);
    // Good by itself, but it moves the second mesh (instances 1 and 3) out of range.
    bad = glm::mat4(1.0f);
    bad[3][0] = 2.0f * largest_coordinate;
    check_refused(animated, "instances[1].transform", [&] { animated.deform(1, bad); });
    check_refused(animated, "transforms", [&] { animated.move_instances({good[0], good[1]}); });
    check_refused(animated, "mesh 2", [&] { animated.deform(2, bent()); });

    std::vector<glm::vec3> positions = animated.scene().meshes[0].positions;
    check_refused(animated, "mesh 2", [&] { animated.refit(2, positions); });
    check_refused(animated, "positions", [&] { animated.refit(1, positions); });
    for (const float x : {infinity, std::numeric_limits<float>::quiet_NaN(), 2.0f * largest_coordinate}) {
        positions[7].y = x;
        check_refused(animated, "positions[7]", [&] { animated.refit(0, positions); });
    }
    // Within range, but not where the third instance places it.
    positions[7].y = largest_coordinate;
    std::vector<glm::mat4> doubled = good;
    doubled[2][1][1] = 2.0f;
    animated.move_instances(doubled);
    check_refused(animated, "instances[2].transform", [&] { animated.refit(0, positions); });
}

TEST_CASE("update: one level does not move instances") {
    for (const BuildOptions& options : all_options()) {
        if (options.levels == Levels::two) continue;
        AnimatedTree animated(test_device(), small_scene(), options);
        check_refused(animated, "levels", [&] { animated.move_instances(transforms_of(animated.scene())); });
        check_refused(animated, "levels", [&] { animated.deform(0, bent()); });
    }
}

TEST_CASE("update: scenes without instances, and meshes without one") {
    Scene scene = scene_of({random_mesh(5, 1, 1, 1), random_mesh(30, 1, 1, 2)});
    for (const BuildOptions& options : all_options()) {
        CAPTURE(name(options.layout));
        CAPTURE(name(options.levels));
        for (const std::size_t instances : {0u, 1u}) {
            scene.instances.resize(instances);
            AnimatedTree animated(test_device(), scene, options);
            std::vector<glm::vec3> positions = scene.meshes[1].positions;
            for (glm::vec3& p : positions) p *= 2.0f;
            animated.refit(1, positions);
            CHECK(animated.scene().meshes[1].positions == positions);
            if (instances == 0 || options.levels == Levels::two) {
                animated.deform(1, bent());
                animated.move_instances(std::vector<glm::mat4>(instances, bent()));
            }
            CHECK_NOTHROW(validate(image_of(animated), animated.scene(), "updated"));
            animated.rebuild();
            CHECK(same_trees(image_of(animated), built(animated, options)));
        }
    }
}

TEST_CASE("update: the memory held does not grow with the frames, and an animated tree may be moved") {
    if (small_sizes()) {
        MESSAGE("skipped: takes more triangles and frames than a checker has time for");
        return;
    }
    // A block of the pool may be half as large again as asked, and 4 KiB: with 2000 triangles twice the memory of the
    // first tree is more than that, and ten frames that each kept a large array would pass it.
    Device& device = test_device();
    Scene scene = small_scene();
    scene.meshes[0] = random_mesh(2000, 1.0f, 0.1f, 3);
    for (const BuildOptions& options : all_options()) {
        CAPTURE(name(options.layout));
        CAPTURE(name(options.levels));
        CAPTURE(name(options.bounds.kind));
        device.trim();
        const std::uint64_t others = device.held_bytes();
        AnimatedTree animated(device, scene, options);
        device.trim();
        const std::uint64_t held = device.held_bytes() - others;
        for (int frame = 0; frame < 10; ++frame) {
            if (options.levels == Levels::two) {
                animated.move_instances(transforms_of(animated.scene()));
                animated.deform(0, glm::mat4(1.0f));
            }
            animated.refit(0, animated.scene().meshes[0].positions);
            animated.rebuild();
            AnimatedTree other = std::move(animated);
            animated = std::move(other);
        }
        device.trim();
        CHECK(device.held_bytes() - others <= 2 * held);
    }
}
