// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include <doctest/doctest.h>
#include <unistd.h>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "io/samples.hpp"
#include "support.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;

namespace {

bool same_bits(const glm::mat4& a, const glm::mat4& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Writes and reads back; every float must come back bit for bit.
void check_round_trip(const Scene& scene) {
    const auto file =
        std::filesystem::temp_directory_path() / ("boxwood-export-" + std::to_string(::getpid()) + ".glb");
    save_glb(file, scene);
    const Scene loaded = load_gltf(file);
    std::filesystem::remove(file);

    REQUIRE(loaded.meshes.size() == scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        CHECK(loaded.meshes[i].name == scene.meshes[i].name);
        CHECK(loaded.meshes[i].positions == scene.meshes[i].positions);
        CHECK(loaded.meshes[i].triangles == scene.meshes[i].triangles);
    }
    REQUIRE(loaded.instances.size() == scene.instances.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        CHECK(loaded.instances[i].name == scene.instances[i].name);
        CHECK(loaded.instances[i].mesh == scene.instances[i].mesh);
        CHECK(same_bits(loaded.instances[i].transform, scene.instances[i].transform));
    }
    REQUIRE(loaded.cameras.size() == scene.cameras.size());
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        CHECK(loaded.cameras[i].name == scene.cameras[i].name);
        CHECK(same_bits(loaded.cameras[i].to_world, scene.cameras[i].to_world));
        CHECK(loaded.cameras[i].perspective == scene.cameras[i].perspective);
        const bool perspective = scene.cameras[i].perspective;
        if (perspective) CHECK(loaded.cameras[i].vertical_fov == scene.cameras[i].vertical_fov);
        if (!perspective) CHECK(loaded.cameras[i].half_height == scene.cameras[i].half_height);
    }
    CHECK(loaded.warnings.empty());
    REQUIRE(loaded.materials.size() == scene.materials.size());
    REQUIRE(loaded.lights.size() == scene.lights.size());
    REQUIRE(loaded.images.size() == scene.images.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        CHECK(loaded.meshes[i].materials == scene.meshes[i].materials);
}

Scene one_triangle() {
    Scene scene;
    scene.meshes.push_back({"\"quoted\" \\ \n \u2764", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {glm::uvec3(0, 1, 2)}});
    scene.instances.push_back({"", 0, glm::mat4(1)});
    return scene;
}

} // namespace

TEST_CASE("gltf_export: every procedural scene comes back as it was") {
    for (const ProceduralKind& kind : procedural_kinds()) {
        CAPTURE(kind.name);
        check_round_trip(make_procedural(kind.name));
    }
    check_round_trip(Scene{});
}

TEST_CASE("gltf_export: any transform comes back bit for bit") {
    test::Random random(4);
    Scene scene = one_triangle();
    for (int i = 0; i < 2000; ++i) {
        Instance instance{"instance", 0, glm::mat4(1)};
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) {
                const float size = std::ldexp(random.uniform(1.0f, 2.0f), static_cast<int>(random.below(40)) - 20);
                instance.transform[column][row] = random.below(2) == 0 ? size : -size;
            }
        }
        instance.transform[0][0] *= 0x1p25f; // keeps the matrix far from singular
        instance.transform[1][1] *= 0x1p25f;
        instance.transform[2][2] *= 0x1p25f;
        scene.instances.push_back(instance);
    }
    scene.instances[1].transform = {{1, 0, -0.0f, 0}, {0, -1, 0, 0}, {0, 0, 1, 0}, {0, -0.0f, 0, 1}};
    scene.instances[2].transform[3].x = std::numeric_limits<float>::denorm_min();
    check_round_trip(scene);
}

TEST_CASE("gltf_export: cameras of both kinds come back") {
    Scene scene = one_triangle();
    scene.cameras.push_back({"a", glm::mat4(1), true, 0.7f});
    scene.cameras.push_back({"b", {{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {1, 2, 3, 1}}, false, 0.8f, 2.5f});
    check_round_trip(scene);
}

TEST_CASE("gltf_export: materials, textures, pictures, lights and attributes come back") {
    Scene scene = test::sample_scene();
    scene.counts = {};
    scene.warnings = {};
    scene.cameras.clear();                                        // what a camera's kind does not read is not kept
    scene.meshes[1].normals[0] = {0, 0, 1};                       // a zero one gives a warning
    scene.materials[0].emission = {largest_radiance, 3.0f, 0.0f}; // the most there may be
    const test::TemporaryFolder folder;
    save_glb(folder.path() / "all.glb", scene);
    const Scene loaded = load_gltf(folder.path() / "all.glb");
    CHECK(loaded.warnings.empty());
    CHECK(test::same(loaded, scene));

    // A turned texture, but for rounding.
    const float c = std::cos(0.7f), s = std::sin(0.7f);
    const glm::mat3 turned(2 * c, -2 * s, 0, -3 * s, -3 * c, 0, 0.25f, 0.5f, 1);
    scene.materials[0].normal_texture.transform = turned;
    save_glb(folder.path() / "all.glb", scene);
    const glm::mat3 back = load_gltf(folder.path() / "all.glb").materials[0].normal_texture.transform;
    for (int column = 0; column < 3; ++column) CHECK(glm::length(back[column] - turned[column]) < 1e-6f);
}

TEST_CASE("gltf_export: nothing is written when it cannot be, or when the scene is broken") {
    const auto folder = std::filesystem::temp_directory_path() / ("boxwood-no-folder-" + std::to_string(::getpid()));
    CHECK_THROWS_AS(save_glb(folder / "scene.glb", one_triangle()), OutputError);
    CHECK(!std::filesystem::exists(folder));

    const auto file =
        std::filesystem::temp_directory_path() / ("boxwood-broken-" + std::to_string(::getpid()) + ".glb");
    Scene broken = one_triangle();
    broken.meshes[0].triangles[0].x = 3;
    CHECK_THROWS_AS(save_glb(file, broken), InputError);
    CHECK(!std::filesystem::exists(file));
}

TEST_SUITE_END();
