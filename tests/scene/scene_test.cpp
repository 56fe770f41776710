// SPDX-License-Identifier: MIT
#include "boxwood/scene.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "scene/transform.hpp"
#include "support.hpp"

TEST_SUITE_BEGIN("scene");

using namespace boxwood;

namespace {

Scene two_triangles() {
    Scene scene;
    scene.meshes.push_back({"one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {glm::uvec3(0, 1, 2)}});
    scene.meshes.push_back({"two", {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}, {{0, 1, 2}, {2, 1, 3}}});
    return scene;
}

glm::mat4 scaled(float x, float y, float z) { return {{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}, {0, 0, 0, 1}}; }

// Throws from validate(): the element that it names.
std::string fault(const Scene& scene) {
    try {
        validate(scene, "file");
    } catch (const InputError& error) {
        CHECK(error.file == "file");
        return error.where;
    }
    return "";
}

} // namespace

TEST_CASE("scene: counts: meshes once, instances each time") {
    Scene scene = two_triangles();
    CHECK(scene.triangle_count() == 3);
    CHECK(scene.vertex_count() == 7);
    CHECK(scene.instanced_triangle_count() == 0);
    scene.instances = {{"", 1, glm::mat4(1)}, {"", 0, glm::mat4(1)}, {"", 1, glm::mat4(1)}};
    CHECK(scene.instanced_triangle_count() == 5);
    CHECK(scene.triangle_count() == 3);
}

TEST_CASE("scene: validate names what breaks a promise") {
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(fault(Scene{}) == "");
    Scene scene = two_triangles();
    scene.instances = {{"", 1, glm::mat4(1)}, {"", 0, scaled(-1, 2, 3)}};
    scene.cameras = {Camera{}};
    CHECK(fault(scene) == "");

    const auto broken = [&scene](auto change) {
        Scene copy = scene;
        change(copy);
        return fault(copy);
    };
    CHECK(broken([](Scene& s) { s.meshes[1].triangles.clear(); }) == "meshes[1].triangles");
    CHECK(broken([](Scene& s) { s.meshes[1].triangles[1].z = 4; }) == "meshes[1].triangles[1]");
    CHECK(broken([&](Scene& s) { s.meshes[0].positions[2].y = infinity; }) == "meshes[0].positions[2]");
    CHECK(broken([](Scene& s) { s.meshes[0].positions[2].y = std::nanf(""); }) == "meshes[0].positions[2]");
    CHECK(broken([&](Scene& s) { s.meshes[0].positions[1].x = -std::nextafter(largest_coordinate, infinity); }) ==
          "meshes[0].positions[1]");
    CHECK(broken([](Scene& s) { s.meshes[0].positions[1].x = -largest_coordinate; }) == "");
    CHECK(broken([](Scene& s) { s.instances[1].mesh = 2; }) == "instances[1].mesh");
    CHECK(broken([](Scene& s) { s.instances[1].transform[2][2] = 0; }) == "instances[1].transform");
    CHECK(broken([](Scene& s) { s.instances[1].transform[3][3] = 2; }) == "instances[1].transform");
    CHECK(broken([](Scene& s) { s.instances[0].transform[3][0] = 2 * largest_coordinate; }) ==
          "instances[0].transform");
    CHECK(broken([](Scene& s) { s.cameras[0].vertical_fov = std::numbers::pi_v<float>; }) == "cameras[0].vertical_fov");
    CHECK(broken([](Scene& s) { s.cameras[0].to_world[1] = {}; }) == "cameras[0].to_world");
}

TEST_CASE("scene: a transform is judged by its shape, not by its size") {
    const float c = std::sqrt(0.5f);
    const glm::mat4 turn{{c, c, 0, 0}, {-c, c, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (const int exponent : {-100, -60, -20, 0, 20, 60, 100}) {
        CAPTURE(exponent);
        const float size = std::ldexp(1.0f, exponent);
        const glm::mat4 grow = scaled(size, size, size);
        CHECK(transform_fault(grow * turn) == "");
        CHECK(transform_fault(turn * scaled(size, 1, 1)) == ""); // thin along its own axes
        CHECK(transform_fault(scaled(size, 1, 1) * turn) == ""); // thin along the world's
        CHECK(transform_fault(grow * turn * scaled(1, 0, 1) * turn) == "is singular");
    }
    CHECK(transform_fault(scaled(1e-39f, 1, 1)) == "has an inverse out of the range of float");
    CHECK(transform_fault(scaled(std::nanf(""), 1, 1)) == "is not finite");
}

TEST_CASE("scene: flatten: triangles in instance order, transformed in double, rounded once") {
    Scene scene = two_triangles();
    test::Random random(1);
    for (glm::vec3& position : scene.meshes[1].positions) {
        for (int axis = 0; axis < 3; ++axis) position[axis] = random.uniform(0.0f, 100.0f);
    }
    const glm::mat4 place{{0.1f, 0.7f, -0.3f, 0}, {-1.3f, 0.2f, 0.9f, 0}, {0.4f, 0.6f, 1.1f, 0}, {1e5f, -7, 3e-4f, 1}};
    scene.instances = {{"a", 1, place}, {"b", 0, glm::mat4(1)}, {"c", 1, scaled(-1, 1, 1)}};
    scene.cameras = {Camera{"view"}};
    const Scene flat = flatten(scene);

    REQUIRE(flat.meshes.size() == 1);
    REQUIRE(flat.instances.size() == 1);
    CHECK(flat.instances[0].transform == glm::mat4(1));
    CHECK(flat.cameras.size() == 1);
    REQUIRE(flat.triangle_count() == 5);
    std::size_t triangle = 0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const glm::uvec3& source : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3 p = mesh.positions[source[corner]];
                const glm::vec3 got = flat.meshes[0].positions[flat.meshes[0].triangles[triangle][corner]];
                for (int row = 0; row < 3; ++row) {
                    const auto m = [&](int column) {
                        return static_cast<long double>(instance.transform[column][row]);
                    };
                    const long double exact = m(0) * p.x + m(1) * p.y + m(2) * p.z + m(3);
                    const float rounded = static_cast<float>(exact);
                    CHECK(std::abs(got[row] - rounded) <= std::abs(rounded) * 0x1p-23f);
                }
            }
            ++triangle;
        }
    }
    CHECK(flatten(Scene{}).meshes.empty());
}

TEST_CASE("scene: flatten refuses 2^31 triangles before it takes memory") {
    Scene scene = two_triangles();
    scene.meshes[0].triangles.assign(1 << 16, glm::uvec3(0, 1, 2));
    scene.instances.assign(1 << 15, {"", 0, glm::mat4(1)});
    CHECK_THROWS_AS(flatten(scene), CapacityError);
}

TEST_SUITE_END();
