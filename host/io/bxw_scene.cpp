// SPDX-License-Identifier: MIT
#include "io/bxw_scene.hpp"

#include "io/bxw_codec.hpp"

namespace boxwood::detail::bxw {

namespace {

// Least bytes of an element, all texts empty.
constexpr std::size_t mesh_bytes = text_bytes + 2 * sizeof(std::uint64_t) + sizeof(std::uint32_t);
constexpr std::size_t instance_bytes = text_bytes + sizeof(std::uint32_t) + sizeof(glm::mat4);
constexpr std::size_t camera_bytes = text_bytes + sizeof(glm::mat4) + sizeof(std::uint32_t) + 2 * sizeof(float);

/// What `mesh` has, as bits of MeshPart.
std::uint32_t parts_of(const Mesh& mesh) {
    return (mesh.materials.empty() ? 0u : mesh_materials) | (mesh.normals.empty() ? 0u : mesh_normals) |
           (mesh.tangents.empty() ? 0u : mesh_tangents) | (mesh.uvs[0].empty() ? 0u : mesh_uvs_0) |
           (mesh.uvs[1].empty() ? 0u : mesh_uvs_1) | (mesh.colors.empty() ? 0u : mesh_colors);
}

Instance decode_instance(Decoder& in) {
    Instance instance;
    instance.name = in.get_text();
    instance.mesh = in.get<std::uint32_t>();
    instance.transform = in.get<glm::mat4>();
    return instance;
}

Camera decode_camera(Decoder& in) {
    Camera camera;
    camera.name = in.get_text();
    camera.to_world = in.get<glm::mat4>();
    const auto perspective = in.get<std::uint32_t>();
    if (perspective > 1) in.fail("has a camera that is neither perspective nor orthographic");
    camera.perspective = perspective == 1;
    camera.vertical_fov = in.get<float>();
    camera.half_height = in.get<float>();
    return camera;
}

} // namespace

std::string encode_scene(const Scene& scene) {
    Encoder out;
    out.put(scene.counts.dropped_triangles);
    out.put(scene.counts.dropped_instances);
    out.put(scene.counts.skipped_points_and_lines);
    out.put_count(scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) {
        out.put_text(mesh.name);
        out.put_count(mesh.positions.size());
        out.put_count(mesh.triangles.size());
        out.put(parts_of(mesh));
    }
    out.put_count(scene.instances.size());
    for (const Instance& instance : scene.instances) {
        out.put_text(instance.name);
        out.put(instance.mesh);
        out.put(instance.transform);
    }
    out.put_count(scene.cameras.size());
    for (const Camera& camera : scene.cameras) {
        out.put_text(camera.name);
        out.put(camera.to_world);
        out.put(static_cast<std::uint32_t>(camera.perspective));
        out.put(camera.vertical_fov);
        out.put(camera.half_height);
    }
    out.put_count(scene.warnings.size());
    for (const std::string& warning : scene.warnings) out.put_text(warning);
    return out.take();
}

SceneOutline decode_scene(std::span<const char> bytes, const std::string& file) {
    Decoder in(bytes, "section scene", file);
    SceneOutline outline;
    Scene& scene = outline.scene;
    scene.counts.dropped_triangles = in.get<std::uint64_t>();
    scene.counts.dropped_instances = in.get<std::uint64_t>();
    scene.counts.skipped_points_and_lines = in.get<std::uint64_t>();
    const std::size_t meshes = in.get_count(mesh_bytes);
    scene.meshes.resize(meshes);
    outline.sizes.resize(meshes);
    for (std::size_t i = 0; i < meshes; ++i) {
        scene.meshes[i].name = in.get_text();
        outline.sizes[i].vertices = in.get<std::uint64_t>();
        outline.sizes[i].triangles = in.get<std::uint64_t>();
        outline.sizes[i].parts = in.get_word(2 * mesh_colors, "has a mesh with an unknown attribute");
    }
    scene.instances.resize(in.get_count(instance_bytes));
    for (Instance& instance : scene.instances) instance = decode_instance(in);
    scene.cameras.resize(in.get_count(camera_bytes));
    for (Camera& camera : scene.cameras) camera = decode_camera(in);
    scene.warnings.resize(in.get_count(text_bytes));
    for (std::string& warning : scene.warnings) warning = in.get_text();
    in.finish();
    return outline;
}

} // namespace boxwood::detail::bxw
