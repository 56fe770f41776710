// SPDX-License-Identifier: MIT
#include "io/bxw_scene.hpp"

#include <cstring>
#include <string_view>
#include <type_traits>

#include "boxwood/error.hpp"

namespace boxwood::bxw {

namespace {

class Encoder {
public:
    template <class T>
    void put(const T& value) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> ||
                      std::is_same_v<T, glm::mat4>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void put_count(std::size_t count) { put(static_cast<std::uint64_t>(count)); }
    void put_text(std::string_view text) {
        put_count(text.size());
        bytes_.append(text);
    }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

class Decoder {
public:
    Decoder(std::span<const char> bytes, const std::string& file) : rest_(bytes), file_(file) {}

    template <class T>
    T get() {
        if (rest_.size() < sizeof(T)) fail("ends too early");
        T value;
        std::memcpy(&value, rest_.data(), sizeof value);
        rest_ = rest_.subspan(sizeof value);
        return value;
    }

    /// A list's count, refused when the rest of the section cannot hold that many elements of `least` bytes each.
    std::size_t get_count(std::size_t least) {
        const auto count = get<std::uint64_t>();
        if (count > rest_.size() / least) fail("counts more elements than it holds");
        return static_cast<std::size_t>(count);
    }

    std::string get_text() {
        const std::size_t size = get_count(1);
        std::string text(rest_.data(), size);
        rest_ = rest_.subspan(size);
        return text;
    }

    void finish() const {
        if (!rest_.empty()) fail("has bytes behind its last element");
    }

    [[noreturn]] void fail(const char* what) const { throw InputError(file_, "section scene", what); }

private:
    std::span<const char> rest_;
    const std::string& file_;
};

// Least bytes of an element, all texts empty.
constexpr std::size_t text_bytes = sizeof(std::uint64_t);
constexpr std::size_t mesh_bytes = text_bytes + 2 * sizeof(std::uint64_t);
constexpr std::size_t instance_bytes = text_bytes + sizeof(std::uint32_t) + sizeof(glm::mat4);
constexpr std::size_t camera_bytes = text_bytes + sizeof(glm::mat4) + sizeof(std::uint32_t) + 2 * sizeof(float);

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
    Decoder in(bytes, file);
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

} // namespace boxwood::bxw
