// SPDX-License-Identifier: MIT
#include "boxwood/geometry.hpp"
#include <algorithm>

#include <string>

#include "boxwood/error.hpp"
#include "runtime/capacity.hpp"

namespace boxwood {

namespace {

/// Rows of the upper 3x4 part of an affine matrix, rounded to float.
void store_rows(const glm::dmat3& linear, const glm::dvec3& translation, float (&rows)[12]) {
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) rows[4 * r + c] = static_cast<float>(linear[c][r]);
        rows[4 * r + 3] = static_cast<float>(translation[r]);
    }
}

std::vector<MeshRange> mesh_ranges(const Scene& scene) {
    std::vector<MeshRange> ranges;
    ranges.reserve(scene.meshes.size());
    MeshRange next{};
    for (const Mesh& mesh : scene.meshes) {
        next.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
        next.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
        ranges.push_back(next);
        next.first_vertex += next.vertex_count;
        next.first_triangle += next.triangle_count;
    }
    return ranges;
}

std::vector<glm::vec3> all_positions(const Scene& scene) {
    std::vector<glm::vec3> positions;
    positions.reserve(scene.vertex_count());
    for (const Mesh& mesh : scene.meshes)
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    return positions;
}

std::vector<glm::uvec3> all_triangles(const Scene& scene) {
    std::vector<glm::uvec3> triangles;
    triangles.reserve(scene.triangle_count());
    std::uint32_t first_vertex = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (const glm::uvec3& triangle : mesh.triangles) triangles.push_back(triangle + first_vertex);
        first_vertex += static_cast<std::uint32_t>(mesh.positions.size());
    }
    return triangles;
}

/// Uploads vectors of three components as an array of scalars.
template <class T, class Vector>
Buffer<T> upload_components(Device& device, const std::vector<Vector>& vectors, const char* label) {
    static_assert(sizeof(Vector) == 3 * sizeof(T));
    Buffer<T> buffer = make_buffer<T>(device, 3 * vectors.size(), label);
    detail::write(device, buffer.view().handle(), vectors.data(), vectors.size() * sizeof(Vector));
    return buffer;
}

} // namespace

std::vector<InstanceRecord> instance_records(const Scene& scene) {
    std::vector<InstanceRecord> records;
    records.reserve(scene.instances.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.mesh >= scene.meshes.size())
            throw InputError("scene", "instances[" + std::to_string(i) + "]",
                             "mesh " + std::to_string(instance.mesh) + " is out of range; the scene has " +
                                 std::to_string(scene.meshes.size()));
        const glm::dmat3 linear{glm::dmat4(instance.transform)};
        const glm::dvec3 translation{instance.transform[3]};
        const glm::dmat3 inverse = glm::inverse(linear);
        InstanceRecord record{};
        store_rows(linear, translation, record.to_world);
        store_rows(inverse, -(inverse * translation), record.to_object);
        record.mesh = instance.mesh;
        records.push_back(record);
    }
    return records;
}

Geometry upload(Device& device, const Scene& scene) {
    const BufferNeed needs[] = {{"positions", 3 * scene.vertex_count(), sizeof(float)},
                                {"triangles", 3 * scene.triangle_count(), sizeof(std::uint32_t)},
                                {"meshes", scene.meshes.size(), sizeof(MeshRange)},
                                {"instances", scene.instances.size(), sizeof(InstanceRecord)}};
    check_fits(device, needs, "the scene");
    const std::vector<InstanceRecord> records = instance_records(scene);

    Geometry geometry;
    // One mesh needs no copy: its arrays are the concatenation.
    if (scene.meshes.size() == 1) {
        geometry.positions = upload_components<float>(device, scene.meshes[0].positions, "positions");
        geometry.triangles = upload_components<std::uint32_t>(device, scene.meshes[0].triangles, "triangles");
    } else {
        geometry.positions = upload_components<float>(device, all_positions(scene), "positions");
        geometry.triangles = upload_components<std::uint32_t>(device, all_triangles(scene), "triangles");
    }
    geometry.meshes = upload(device, mesh_ranges(scene), "meshes");
    geometry.instances = upload(device, records, "instances");
    geometry.transforms = std::any_of(scene.instances.begin(), scene.instances.end(),
                                      [](const Instance& i) { return i.transform != glm::mat4(1.0f); });
    return geometry;
}

} // namespace boxwood
