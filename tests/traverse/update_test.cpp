// SPDX-License-Identifier: MIT
// Hits in an animated scene against brute force and against a new build. All three share the arithmetic of a triangle
// test and break ties alike, so equal bits are asked for.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "boxwood/update.hpp"
#include "oracles/brute_force.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

constexpr Kind animated_kinds[] = {{Layout::wide8, Levels::one},
                                   {Layout::wide8, Levels::two},
                                   {Layout::binary, Levels::one},
                                   {Layout::binary, Levels::two},
                                   {Layout::binary, Levels::one, Bounds::obb_points},
                                   {Layout::binary, Levels::two, Bounds::obb_points},
                                   {Layout::binary, Levels::one, Bounds::obb_moments},
                                   {Layout::binary, Levels::two, Bounds::obb_moments}};

/// An animated tree beside a plain scene that goes through the same changes.
class Animation {
public:
    Animation(Scene scene, const Kind& kind, std::vector<Ray> rays)
        : kind_(kind), options_{.levels = kind.levels, .layout = kind.layout, .bounds = {.kind = kind.bounds}},
          rays_(std::move(rays)), scene_(std::move(scene)), animated_(test_device(), scene_, options_) {
        check("build");
    }

    void move(Random& random) {
        std::vector<glm::mat4> transforms;
        for (Instance& instance : scene_.instances) {
            instance.transform = random_map(random, transforms.size() % 2 == 0);
            instance.transform[3] = glm::vec4(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2), 1);
            transforms.push_back(instance.transform);
        }
        animated_.move_instances(transforms);
        check("move_instances");
    }

    void deform(Random& random, std::uint32_t mesh) {
        const glm::mat4 map = random_map(random, mesh == 0);
        for (Instance& instance : scene_.instances)
            if (instance.mesh == mesh) instance.transform = glm::mat4(glm::dmat4(instance.transform) * glm::dmat4(map));
        animated_.deform(mesh, map);
        check("deform");
    }

    void refit(std::uint32_t mesh, float phase) {
        for (glm::vec3& p : scene_.meshes[mesh].positions)
            p += 0.4f * glm::vec3(std::sin(3.0f * p.y + phase), std::sin(2.0f * p.z + phase), std::cos(p.x + phase));
        animated_.refit(mesh, scene_.meshes[mesh].positions);
        check("refit");
    }

    void rebuild() {
        animated_.rebuild();
        check("rebuild");
    }

private:
    /// Sheared, and mirrored or not: a diagonal that outweighs the rest of each column keeps it invertible.
    static glm::mat4 random_map(Random& random, bool mirrored) {
        glm::mat4 map(1.0f);
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row) map[column][row] += random.uniform(-0.3f, 0.3f);
        if (mirrored) map[0] = -map[0];
        return map;
    }

    void check(const std::string& update) const {
        CAPTURE(update);
        Device& device = test_device();
        const TreeImage image = download(device, animated_.tree());
        CHECK_NOTHROW(validate(image, scene_, update));
        const std::vector<Hit> hits = trace(image, rays_);
        const std::vector<Hit> expected = BruteForce(scene_, kind_.levels).closest_hits(rays_);
        CHECK(count_different(hits, expected) == 0);
        CHECK(count_different(hits, trace(download(device, build(device, scene_, options_)), rays_)) == 0);
        // Rays that all miss would agree too.
        const auto misses = std::ranges::count(hits, BOXWOOD_NONE, &Hit::primitive);
        CHECK(static_cast<std::size_t>(misses) < hits.size());
    }

    Kind kind_;
    BuildOptions options_;
    std::vector<Ray> rays_;
    Scene scene_;
    AnimatedTree animated_;
};

} // namespace

TEST_CASE("update: hits in an animated scene are those of a new build, frame after frame") {
    // Three meshes, placed nine times: each several times, mirrored and sheared, under several top nodes. 60 triangles:
    // several levels of either layout.
    const std::uint32_t triangles = small_sizes() ? 12 : 60, rays = small_sizes() ? 60 : 1500;
    const int frames = small_sizes() ? 1 : 3;
    for (const Kind& kind : animated_kinds) {
        CAPTURE(words(kind));
        Random random(11);
        const Scene scene = instanced_scene(random, 3, 9, triangles);
        Animation animation(scene, kind, random_rays(random, rays, 2.0f));
        for (int frame = 0; frame < frames; ++frame) {
            CAPTURE(frame);
            if (kind.levels == Levels::two) {
                animation.move(random);
                animation.deform(random, static_cast<std::uint32_t>(frame) % 3);
            }
            animation.refit(static_cast<std::uint32_t>(frame + 1) % 3, static_cast<float>(frame));
            // Over the volumes that the refit left.
            if (kind.levels == Levels::two) animation.move(random);
            if (frame == 1) animation.rebuild();
        }
    }
}

TEST_CASE("update: one mesh placed once as it is, the tree over its own triangles") {
    for (const Kind& kind : animated_kinds) {
        CAPTURE(words(kind));
        Random random(12);
        // 1: a root over one leaf; 33 and 200: several levels.
        for (const std::uint32_t triangles : {1u, small_sizes() ? 33u : 200u}) {
            const Scene scene = single(random_mesh(random, triangles, triangles == 1 ? 0.9f : 0.3f));
            Animation animation(scene, kind, random_rays(random, small_sizes() ? 200 : 500, 1.0f));
            animation.refit(0, 1.0f);
            animation.rebuild();
            animation.refit(0, 2.0f);
        }
    }
}
