// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/rounding.hpp"
#include "io/gltf_accessor.hpp"
#include "io/gltf_camera.hpp"
#include "io/gltf_lights.hpp"
#include "io/gltf_materials.hpp"
#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"
#include "io/gltf_size.hpp"
#include "runtime/excerpt.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// False when certainly every triangle is a point or a line, such as after a file's numbers were rounded.
bool has_area(const Mesh& mesh) {
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&mesh](const glm::uvec3& t) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        return glm::cross(b - a, c - a) != glm::dvec3(0.0);
    });
}

class Importer {
public:
    Importer(const GltfDocument& document, Warnings& warnings)
        : document_(document), model_(document.model), warnings_(warnings) {}

    Scene load() {
        const std::vector<PlacedNode> nodes = place_nodes(document_, warnings_);
        const std::vector<bool> used = used_meshes(nodes);
        check_size(document_, nodes, used, host_memory());
        load_materials(document_, scene_, warnings_);
        load_used_meshes(used);
        for (const PlacedNode& placed : nodes) {
            add_instances(placed);
            if (auto camera = load_camera(document_, placed, warnings_)) scene_.cameras.push_back(std::move(*camera));
            if (auto light = load_light(document_, placed, warnings_)) scene_.lights.push_back(std::move(*light));
        }
        if (collapses(scene_))
            warnings_.add("scene",
                          "every instance is too small for floats so far from the origin, so that hardly a ray meets "
                          "anything; move it to the origin or enlarge it");
        scene_.warnings = warnings_.take();
        return std::move(scene_);
    }

private:
    // By mesh of the file, whether some node shows it.
    std::vector<bool> used_meshes(const std::vector<PlacedNode>& nodes) {
        std::vector<bool> used(model_.meshes.size(), false);
        for (const PlacedNode& placed : nodes) {
            const int mesh = model_.nodes[placed.node].mesh;
            if (mesh < 0) continue;
            if (!GltfDocument::has(mesh, used.size())) {
                document_.fail(element("nodes", placed.node) + ".mesh", "names a mesh that does not exist");
            }
            used[static_cast<std::size_t>(mesh)] = true;
        }
        for (std::size_t i = 0; i < used.size(); ++i)
            if (!used[i]) warnings_.add_repeated(element("meshes", i), "is shown by no node of the scene, left out");
        return used;
    }

    // Meshes that some node shows, in file order. One without triangles gets no place in the scene.
    void load_used_meshes(const std::vector<bool>& used) {
        places_.resize(used.size());
        for (std::size_t i = 0; i < used.size(); ++i) {
            if (!used[i]) continue;
            Mesh mesh = load_mesh(document_, i, scene_.counts, warnings_);
            if (mesh.triangles.empty()) continue;
            places_[i] = static_cast<std::uint32_t>(scene_.meshes.size());
            if (!has_area(mesh))
                warnings_.add(element("meshes", i), "no triangle has an area, so that no ray meets it");
            bounds_.push_back(mesh_bounds(mesh.positions));
            scene_.meshes.push_back(std::move(mesh));
        }
    }

    void add_instances(const PlacedNode& placed) {
        const tinygltf::Node& node = model_.nodes[placed.node];
        if (node.mesh < 0) return;
        // glTF places a skinned mesh by its joints alone, whatever the transform of its node. In the pose in which the
        // skin was bound that comes to one transform for the whole mesh, and exporters keep the node at that place; so
        // the node's own transform stands in for the rest pose.
        if (node.skin >= 0) warnings_.add(element("nodes", placed.node), "is skinned, loaded in rest pose");
        if (const auto found = node.extensions.find(instancing); found != node.extensions.end()) {
            return add_gpu_instances(placed, found->second);
        }
        add_instance(placed, placed.to_world);
    }

    void add_instance(const PlacedNode& placed, const glm::dmat4& to_world) {
        const tinygltf::Node& node = model_.nodes[placed.node];
        const auto mesh = places_[static_cast<std::size_t>(node.mesh)];
        if (!mesh) {
            ++scene_.counts.dropped_instances;
            return;
        }
        const glm::mat4 transform(to_world);
        const std::string_view fault = placement_fault(transform, bounds_[*mesh]);
        if (!fault.empty()) {
            ++scene_.counts.dropped_instances;
            return warnings_.add(element("nodes", placed.node),
                                 "instance dropped: its transform " + std::string(fault));
        }
        scene_.instances.push_back({node.name, *mesh, transform});
    }

    // EXT_mesh_gpu_instancing: one T R S per instance below the node's own transform. Every attribute has one element
    // per instance; attributes of the application's own count but are not read.
    void add_gpu_instances(const PlacedNode& placed, const tinygltf::Value& extension) {
        const std::string where = element("nodes", placed.node) + ".extensions." + instancing + ".attributes";
        std::optional<std::size_t> count;
        const tinygltf::Value& attributes = extension.Get("attributes");
        for (const std::string& name : attributes.Keys()) {
            const std::size_t elements =
                element_count(document_, attributes.Get(name).GetNumberAsInt(), where + "." + excerpt(name));
            if (count && *count != elements)
                document_.fail(where + "." + excerpt(name), "differs in count from the other attributes");
            count = elements;
        }
        if (!count) document_.fail(where, "has no attribute");

        const auto accessor = [&](const char* name) {
            return attributes.Has(name) ? attributes.Get(name).GetNumberAsInt() : -1;
        };
        const int t = accessor("TRANSLATION");
        const int r = accessor("ROTATION");
        const int s = accessor("SCALE");
        const auto translations = t < 0 ? std::vector<glm::vec3>() : read_vec3(document_, t, where + ".TRANSLATION");
        const auto rotations = r < 0 ? std::vector<glm::vec4>() : read_vec4(document_, r, where + ".ROTATION");
        const auto scales = s < 0 ? std::vector<glm::vec3>() : read_vec3(document_, s, where + ".SCALE");
        if (t < 0 && r < 0 && s < 0 && *count > largest_implicit_count) document_.fail(where, "has too many elements");
        for (std::size_t i = 0; i < *count; ++i) {
            const glm::dmat4 local = compose(t < 0 ? glm::dvec3(0.0) : glm::dvec3(translations[i]),
                                             r < 0 ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(rotations[i]),
                                             s < 0 ? glm::dvec3(1.0) : glm::dvec3(scales[i]));
            add_instance(placed, placed.to_world * local);
        }
    }

    const GltfDocument& document_;
    const tinygltf::Model& model_;
    Scene scene_;
    Warnings& warnings_;
    std::vector<std::optional<std::uint32_t>> places_; ///< By mesh of the file: its index in the scene.
    std::vector<MeshBounds> bounds_;                   ///< By mesh of the scene.
};

} // namespace

Scene load_gltf_memory(std::span<const std::byte> bytes, std::string file, const std::filesystem::path& folder) {
    try {
        Warnings warnings;
        const GltfDocument document = open_gltf(bytes, file, folder, warnings);
        return Importer(document, warnings).load();
    } catch (const std::bad_alloc&) {
        throw InputError(file, "", "needs more memory than there is");
    } catch (const std::length_error&) {
        throw InputError(file, "", "needs more memory than there is");
    }
}

Scene load_gltf(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_regular_file(file, file.string(), "");
    const std::filesystem::path folder = file.parent_path();
    return load_gltf_memory(bytes, file.string(), folder.empty() ? std::filesystem::path(".") : folder);
}

} // namespace boxwood
