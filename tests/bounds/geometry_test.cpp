// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "boxwood/error.hpp"
#include "boxwood/geometry.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("bounds");

namespace {

/// Two meshes of 3 and 4 vertices, so that a wrong offset cannot give the right index.
Scene two_meshes() {
    Scene scene;
    scene.meshes.push_back({"a", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    scene.meshes.push_back({"b", {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 7}}, {{0, 1, 2}, {0, 2, 3}}});
    return scene;
}

glm::dvec3 apply(const float (&rows)[12], const glm::dvec3& p) {
    glm::dvec3 result;
    for (int r = 0; r < 3; ++r)
        result[r] = double(rows[4 * r]) * p.x + double(rows[4 * r + 1]) * p.y + double(rows[4 * r + 2]) * p.z +
                    double(rows[4 * r + 3]);
    return result;
}

} // namespace

TEST_CASE("geometry: meshes are concatenated with offsets") {
    Scene scene = two_meshes();
    scene.instances.push_back({"i", 1, glm::mat4(1.0f)});
    const Geometry geometry = upload(test_device(), scene);

    CHECK(geometry.vertex_count() == 7);
    CHECK(geometry.triangle_count() == 3);
    const std::vector<std::uint32_t> expected_triangles = {0, 1, 2, 3, 4, 5, 3, 5, 6};
    CHECK(download(test_device(), geometry.triangles) == expected_triangles);
    const std::vector<float> positions = download(test_device(), geometry.positions);
    CHECK(positions[3 * 6 + 0] == 5.0f);
    CHECK(positions[3 * 6 + 2] == 7.0f);
    const std::vector<MeshRange> ranges = download(test_device(), geometry.meshes);
    CHECK(ranges[0].first_vertex == 0);
    CHECK(ranges[0].vertex_count == 3);
    CHECK(ranges[1].first_vertex == 3);
    CHECK(ranges[1].vertex_count == 4);
    CHECK(ranges[1].first_triangle == 1);
    CHECK(ranges[1].triangle_count == 2);
    const std::vector<InstanceRecord> records = download(test_device(), geometry.instances);
    REQUIRE(records.size() == 1);
    CHECK(records[0].mesh == 1);
    CHECK(records[0].root == 0);
}

TEST_CASE("geometry: one mesh and no mesh") {
    Scene scene = two_meshes();
    scene.meshes.resize(1);
    scene.instances.push_back({"i", 0, glm::mat4(1.0f)});
    const Geometry one = upload(test_device(), scene);
    CHECK(download(test_device(), one.triangles) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(download(test_device(), one.positions) == std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});

    const Geometry none = upload(test_device(), Scene{});
    CHECK(none.vertex_count() == 0);
    CHECK(none.triangle_count() == 0);
    CHECK(none.meshes.size() == 0);
    CHECK(none.instances.size() == 0);
}

TEST_CASE("geometry: records carry the transform and its inverse") {
    Scene scene = two_meshes();
    // Mirror, shear and a large offset; the rows are in the file's order, so columns of glm.
    const glm::mat4 transform(glm::vec4(-2, 0, 0.5f, 0), glm::vec4(1, 3, 0, 0), glm::vec4(0, 0.25f, 0.125f, 0),
                              glm::vec4(1000, -7, 3, 1));
    scene.instances.push_back({"i", 0, transform});
    scene.instances.push_back({"j", 1, glm::mat4(1.0f)});
    const std::vector<InstanceRecord> records = instance_records(scene);
    REQUIRE(records.size() == 2);

    Random random(1);
    for (int n = 0; n < 100; ++n) {
        const glm::dvec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const glm::dvec3 world = apply(records[0].to_world, p);
        const glm::dvec3 expected = glm::dvec3(glm::dmat4(transform) * glm::dvec4(p, 1));
        CHECK(glm::length(world - expected) == 0.0);
        // Rounding the inverse moves the point by at most half an ulp of each of its products: the largest is about
        // 8 (row) * 1000 (offset) * 2^-24, four of them.
        CHECK(glm::length(apply(records[0].to_object, world) - p) <= 4 * 8 * 1000 * 0x1p-24);
    }
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) CHECK(records[1].to_object[4 * r + c] == (r == c ? 1.0f : 0.0f));
}

TEST_CASE("geometry: an instance of a mesh that is not there is refused by name") {
    Scene scene = two_meshes();
    scene.instances.push_back({"i", 1, glm::mat4(1.0f)});
    scene.instances.push_back({"j", 2, glm::mat4(1.0f)});
    try {
        upload(test_device(), scene);
        FAIL("accepted");
    } catch (const InputError& error) {
        CHECK(error.where == "instances[1]");
    }
}

TEST_CASE("geometry: a scene that does not fit is refused before anything is uploaded") {
    if (small_sizes()) {
        MESSAGE("skipped: fills the device's memory");
        return;
    }
    Device& device = test_device();
    const DeviceInfo& info = device.info();
    // All arrays of the scene but the last fit beside what is held.
    Scene scene = two_meshes();
    scene.instances.resize(1000);
    const std::uint64_t needed = 7 * 12 + 3 * 12 + 2 * sizeof(MeshRange) + 1000 * sizeof(InstanceRecord);
    device.trim();
    std::vector<Buffer<unsigned char>> filler;
    const std::uint64_t largest = std::min<std::uint64_t>(info.largest_buffer_bytes, 1u << 30);
    while (device.held_bytes() < info.global_bytes - (needed - 1)) {
        const std::uint64_t left = info.global_bytes - (needed - 1) - device.held_bytes();
        filler.push_back(make_buffer<unsigned char>(device, std::min(left, largest), "filler"));
    }
    const std::uint64_t held = device.held_bytes();
    device.reset_peak();
    try {
        upload(device, scene);
        FAIL("accepted");
    } catch (const CapacityError& error) {
        CHECK(error.asked == held + needed);
        CHECK(error.available == info.global_bytes);
    }
    CHECK(device.held_bytes() == held);
    CHECK(device.peak_bytes() == held);
    scene.instances.resize(999);
    CHECK_NOTHROW(upload(device, scene));
}
