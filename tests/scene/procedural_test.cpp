// SPDX-License-Identifier: MIT
#include "boxwood/procedural.hpp"

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "scene/random.hpp"

TEST_SUITE_BEGIN("scene");

using namespace boxwood;

namespace {

// FNV-1a over everything that has geometry.
std::uint64_t digest(const Scene& scene) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&hash](const void* data, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
    };
    for (const Mesh& mesh : scene.meshes) {
        add(mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
        add(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    }
    for (const Instance& instance : scene.instances) {
        add(&instance.mesh, sizeof instance.mesh);
        add(&instance.transform, sizeof instance.transform);
    }
    return hash;
}

// Six times the volume enclosed by a closed mesh whose faces look outwards (divergence theorem).
double volume(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        sum += glm::dot(glm::dvec3(mesh.positions[t.x]),
                        glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
    }
    return sum / 6.0;
}

// Every directed edge has its opposite as often as itself: closed, and turned the same way throughout.
bool is_closed(const Mesh& mesh) {
    std::map<std::pair<unsigned, unsigned>, int> edges;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            ++edges[{t[i], t[(i + 1) % 3]}];
            --edges[{t[(i + 1) % 3], t[i]}];
        }
    }
    for (const auto& [edge, balance] : edges) {
        if (balance != 0) return false;
    }
    return true;
}

} // namespace

TEST_CASE("procedural: every kind is valid, has a camera, and depends on nothing but its options") {
    for (const ProceduralKind& kind : procedural_kinds()) {
        CAPTURE(kind.name);
        CHECK(!kind.description.empty());
        const Scene scene = make_procedural(kind.name);
        CHECK_NOTHROW(validate(scene, kind.name));
        CHECK(scene.cameras.size() == 1);
        CHECK(scene.triangle_count() > 0);
        CHECK(digest(scene) == digest(make_procedural(kind.name)));
        const bool seeded = kind.name == "random" || kind.name == "terrain" || kind.name == "forest" ||
                            kind.name == "hair" || kind.name == "planks";
        CHECK((digest(scene) != digest(make_procedural(kind.name, {0, 0, 2}))) == seeded);
    }
    CHECK(procedural_kinds().size() == 9);
}

TEST_CASE("procedural: triangle counts are reached from below as closely as the shape allows") {
    // 1 is below every shape's least; 40,000 lies between two sizes of each.
    const auto count = [](const char* kind, std::uint64_t wanted) {
        return make_procedural(kind, {wanted}).triangle_count();
    };
    CHECK(count("cornell", 1) == 32);
    CHECK(count("cornell", 40'000) == 32 * 35 * 35);
    CHECK(count("random", 1) == 1);
    CHECK(count("random", 40'001) == 40'001);
    CHECK(count("terrain", 1) == 2);
    CHECK(count("terrain", 40'500) == 2 * 142 * 142);
    CHECK(count("sphere", 1) == 8);
    CHECK(count("sphere", 40'000) == 8 * 70 * 70);
    CHECK(count("forest", 1) == 18 * 4 + 2);
    CHECK(count("forest", 40'000) == 18 * 4 * 555 + 2);
    CHECK(count("menger", 1) == 12);
    CHECK(count("menger", 143) == 12);
    CHECK(count("menger", 144) == 144);
    CHECK(count("menger", 40'000) == 4 * 8000 + 8 * 512);
    CHECK(count("hair", 1) == 50);
    CHECK(count("hair", 40'000) == 800 * 50);
    CHECK(count("materials", 1) == 12 * 8 + 4);
    CHECK(count("materials", 40'000) == 12 * 8 * 20 * 20 + 4);
    CHECK(count("planks", 1) == 12);
    CHECK(count("planks", 40'000) == 3333 * 12);
}

TEST_CASE("procedural: surfaces have materials, and smooth ones the normals of their shape") {
    for (const ProceduralKind& kind : procedural_kinds()) {
        CAPTURE(kind.name);
        const Scene scene = make_procedural(kind.name, {3000});
        for (const Mesh& mesh : scene.meshes) CHECK(mesh.materials.empty() == (kind.name == "random"));
    }
    // Against the triangles around each vertex, weighted by area; terrain is rough.
    for (const char* kind : {"sphere", "terrain"}) {
        const Mesh mesh = make_procedural(kind, {30'000}).meshes[0];
        std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
            for (int i = 0; i < 3; ++i) sums[t[i]] += glm::cross(b - a, c - a);
        }
        REQUIRE(mesh.normals.size() == sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i)
            CHECK(glm::dot(glm::normalize(sums[i]), glm::dvec3(mesh.normals[i])) > 0.85);
    }
    // The box is lit from its ceiling, downwards.
    const Scene cornell = make_procedural("cornell");
    const Mesh& lamp = cornell.meshes[7];
    CHECK(cornell.materials[lamp.materials[0]].emission == glm::vec3(15.0f));
    const glm::vec3 a = lamp.positions[lamp.triangles[0].x];
    const glm::vec3 across =
        glm::cross(lamp.positions[lamp.triangles[0].y] - a, lamp.positions[lamp.triangles[0].z] - a);
    CHECK(across.y < 0.0f);
    CHECK(make_procedural("materials").lights.size() == 1);
}

TEST_CASE("procedural: the sphere is closed, outward and shares every vertex") {
    for (const std::uint64_t f : {1, 2, 3, 10, 64}) {
        CAPTURE(f);
        const Scene scene = make_procedural("sphere", {8 * f * f});
        const Mesh& mesh = scene.meshes.at(0);
        CHECK(mesh.triangles.size() == 8 * f * f);
        CHECK(mesh.positions.size() == 4 * f * f + 2); // Euler: V = 2 + F / 2
        CHECK(is_closed(mesh));
        for (const glm::vec3& p : mesh.positions) CHECK(std::abs(glm::length(glm::dvec3(p)) - 1.0) < 0x1p-22);
        if (f == 64) CHECK(volume(mesh) == doctest::Approx(4.18879).epsilon(0.001));
        if (f == 1) CHECK(volume(mesh) == doctest::Approx(4.0 / 3.0).epsilon(1e-6));
    }
}

TEST_CASE("procedural: the sponge encloses (20/27)^level of its cube and nothing inside") {
    double cube = 8.0;
    for (const std::uint64_t triangles : {12, 144, 2112, 36096}) {
        CAPTURE(triangles);
        const Scene scene = make_procedural("menger", {triangles});
        const Mesh& mesh = scene.meshes.at(0);
        CHECK(mesh.triangles.size() == triangles);
        CHECK(is_closed(mesh));
        CHECK(volume(mesh) == doctest::Approx(cube).epsilon(1e-5));
        cube *= 20.0 / 27.0;
    }
}

TEST_CASE("procedural: random triangles lie in the unit cube") {
    for (const std::uint64_t triangles : {1, 7, 8, 63, 64, 4096}) {
        const Scene scene = make_procedural("random", {triangles});
        for (const glm::vec3& p : scene.meshes[0].positions) {
            CHECK((p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= 1 && p.y <= 1 && p.z <= 1));
        }
    }
}

TEST_CASE("procedural: the terrain is one sheet that faces up") {
    const Scene scene = make_procedural("terrain", {5'000});
    const Mesh& mesh = scene.meshes[0];
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        const double up = glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a).y;
        CHECK(up > 0);
        area += 0.5 * up;
    }
    CHECK(area == doctest::Approx(4.0).epsilon(1e-6)); // the projection covers [-1, 1]^2 once
}

TEST_CASE("procedural: the cornell box has its closed form") {
    const Scene scene = make_procedural("cornell");
    CHECK(scene.meshes.size() == 8);
    CHECK(scene.instances.size() == 8);
    // A block without its bottom: the volume of the prism, for the bottom lies in the plane y = -1.
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.name != "short block") continue;
        Mesh lifted = mesh;
        for (glm::vec3& p : lifted.positions) p.y += 1; // now the missing bottom contributes nothing
        CHECK(volume(lifted) == doctest::Approx(0.5625 * 0.5625 * 0.5625).epsilon(1e-6));
    }
    for (const Mesh& mesh : scene.meshes) {
        for (const glm::vec3& p : mesh.positions)
            CHECK((std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1));
    }
}

TEST_CASE("procedural: the forest has the instances it was asked for, standing on its ground") {
    // 1: the ground alone; 2: one tree; 82 fills a square of 9 x 9 and 83 starts the next.
    for (const std::uint64_t instances : {1, 2, 82, 83, 5000}) {
        CAPTURE(instances);
        const Scene scene = make_procedural("forest", {0, instances});
        CHECK_NOTHROW(validate(scene, "forest"));
        REQUIRE(scene.instances.size() == instances);
        const float half = scene.meshes[0].positions[2].x;
        std::set<std::uint32_t> kinds;
        for (const Instance& instance : scene.instances) {
            kinds.insert(instance.mesh);
            CHECK(std::abs(instance.transform[3].x) <= half);
            CHECK(std::abs(instance.transform[3].z) <= half);
            const glm::dmat3 linear(instance.transform);
            CHECK(std::abs(glm::dot(linear[0], linear[2])) < 1e-6); // turned and scaled, never sheared
            CHECK(glm::determinant(linear) > 0);
        }
        if (instances == 5000) CHECK(kinds.size() == 4);
    }
}

TEST_CASE("procedural: planks are closed boards of fixed shape, turned off the axes") {
    // 1 board; 9: the second pile has one; 4000: the default.
    for (const std::uint64_t boards : {1, 9, 4000}) {
        CAPTURE(boards);
        const Scene scene = make_procedural("planks", {12 * boards});
        const Mesh& mesh = scene.meshes[0];
        REQUIRE(mesh.positions.size() == 8 * boards);
        CHECK(is_closed(mesh));
        const glm::dvec3 p0(mesh.positions[0]);
        const double length = glm::length(glm::dvec3(mesh.positions[1]) - p0);
        const double width = glm::length(glm::dvec3(mesh.positions[2]) - p0);
        const double thickness = glm::length(glm::dvec3(mesh.positions[4]) - p0);
        CHECK(length == doctest::Approx(32 * width).epsilon(1e-4));
        CHECK(width == doctest::Approx(4 * thickness).epsilon(1e-3));
        CHECK(volume(mesh) == doctest::Approx(static_cast<double>(boards) * length * width * thickness).epsilon(1e-3));
        // Rotations are spread evenly: the mean of the squared direction is a third on each axis. 500 piles give it
        // to 0.3 / sqrt(500); four times that is allowed.
        if (boards < 4000) continue;
        glm::dvec3 mean(0.0);
        for (std::size_t i = 0; i < boards; ++i) {
            const glm::dvec3 edge = glm::dvec3(mesh.positions[8 * i + 1]) - glm::dvec3(mesh.positions[8 * i]);
            mean += edge * edge / (length * length) / static_cast<double>(boards);
        }
        for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(mean[axis] - 1.0 / 3.0) < 0.054);
    }
}

TEST_CASE("procedural: strands of hair are closed, slender, and lean between the axes") {
    const Scene scene = make_procedural("hair", {50 * 100});
    const Mesh& mesh = scene.meshes[0];
    REQUIRE(mesh.triangles.size() == 50 * 100);
    CHECK(is_closed(mesh));
    CHECK(volume(mesh) > 0.0);
    for (std::size_t strand = 0; strand < 100; ++strand) {
        const glm::dvec3 root(mesh.positions[27 * strand]), next(mesh.positions[27 * strand + 3]);
        const glm::dvec3 tip(mesh.positions[27 * strand + 24]);
        CHECK(glm::length(tip - root) > 32 * glm::length(glm::dvec3(mesh.positions[27 * strand + 1]) - root));
        const glm::dvec3 direction = glm::normalize(next - root);
        for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(direction[axis]) > 0.25);
    }
}

TEST_CASE("procedural: splitmix64 gives its published sequence") {
    Random random(1234567); // reference values of the algorithm for this seed
    CHECK(random.bits() == 6457827717110365317u);
    CHECK(random.bits() == 3203168211198807973u);
    CHECK(random.bits() == 9817491932198370423u);
}

TEST_CASE("procedural: an unknown kind or an endless count is refused") {
    CHECK_THROWS_WITH_AS(make_procedural("bunny"),
                         doctest::Contains("cornell, random, terrain, sphere, forest, menger, hair, planks"),
                         InputError);
    CHECK_THROWS_AS(make_procedural("random", {std::uint64_t{1} << 31}), InputError);
    CHECK_THROWS_AS(make_procedural("forest", {0, std::uint64_t{1} << 31}), InputError);
}

TEST_SUITE_END();
