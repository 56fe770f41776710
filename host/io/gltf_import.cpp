// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/rounding.hpp"
#include "io/gltf_camera.hpp"
#include "io/gltf_forms.hpp"
#include "io/gltf_lights.hpp"
#include "io/gltf_materials.hpp"
#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"
#include "io/gltf_pose.hpp"
#include "io/gltf_size.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

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
        add_instances(shown_meshes(document_, nodes, warnings_));
        for (const PlacedNode& placed : nodes) {
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

    /// A mesh of the scene that a form became.
    struct Place {
        std::uint32_t mesh;
        MeshBounds bounds;
    };

    void add_instances(const std::vector<ShownMesh>& shown) {
        const MeshForms forms = mesh_forms(document_, shown);
        std::vector<std::optional<Place>> places;
        places.reserve(forms.forms.size());
        for (const MeshForm& form : forms.forms) places.push_back(add_mesh(form, shown));
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const MeshForm& form = forms.forms[forms.of_shown[i]];
            add_instance(shown[i].node, places[forms.of_shown[i]],
                         form.placed_by ? glm::mat4(1.0f) : glm::mat4(shown[i].to_world));
        }
    }

    /// None of a form without triangles, which gets no place in the scene.
    std::optional<Place> add_mesh(const MeshForm& form, const std::vector<ShownMesh>& shown) {
        const std::uint64_t skipped = scene_.counts.skipped_points_and_lines;
        Mesh mesh = load_mesh(document_, form.mesh, pose_of(form, shown), scene_.counts, warnings_);
        // Counted once for each mesh of the file.
        if (!loaded_.insert(form.mesh).second) scene_.counts.skipped_points_and_lines = skipped;
        if (mesh.triangles.empty()) return std::nullopt;
        if (!has_area(mesh))
            warnings_.add(element("meshes", form.mesh), "no triangle has an area, so that no ray meets it");
        const Place place{static_cast<std::uint32_t>(scene_.meshes.size()), mesh_bounds(mesh.positions)};
        scene_.meshes.push_back(std::move(mesh));
        return place;
    }

    Pose pose_of(const MeshForm& form, const std::vector<ShownMesh>& shown) {
        Pose pose;
        const std::vector<double>& weights = morph_weights(document_, form.node);
        if (std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 0.0; }))
            pose.weights = weights;
        if (!form.placed_by) return pose;
        pose.placement = shown[*form.placed_by].to_world;
        const int skin = model_.nodes[form.node].skin;
        if (skin < 0) return pose;
        if (globals_.empty()) globals_ = global_transforms(document_);
        pose.joints = joint_matrices(document_, skin, element("nodes", form.node), globals_, warnings_);
        return pose;
    }

    void add_instance(std::size_t node, const std::optional<Place>& place, const glm::mat4& transform) {
        if (!place) {
            ++scene_.counts.dropped_instances;
            return;
        }
        const std::string_view fault = placement_fault(transform, place->bounds);
        if (!fault.empty()) {
            ++scene_.counts.dropped_instances;
            return warnings_.add(element("nodes", node), "instance dropped: its transform " + std::string(fault));
        }
        scene_.instances.push_back({model_.nodes[node].name, place->mesh, transform});
    }

    const GltfDocument& document_;
    const tinygltf::Model& model_;
    Scene scene_;
    Warnings& warnings_;
    std::set<std::size_t> loaded_;    ///< Meshes of the file.
    std::vector<glm::dmat4> globals_; ///< Of all nodes; empty until a skin needs them.
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
