// SPDX-License-Identifier: MIT
#include "io/gltf_forms.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "io/gltf_attributes.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

/// A file of some kB can ask for a copy of a large mesh per node.
constexpr double most_bytes = 0x1p32;

/// Of a vertex, by the places of VertexKey.
constexpr std::array<double, 6> attribute_bytes{12.0, 12.0, 16.0, 8.0, 8.0, 16.0};
constexpr double index_bytes = 4.0;
constexpr double move_bytes = 12.0;      ///< Of a vertex and an attribute in a morph target.
constexpr double influence_bytes = 16.0; ///< Of a vertex and an attribute; those beside joints and weights count, too.
constexpr double joint_bytes = 128.0;
constexpr double weight_bytes = 8.0;

/// What a mesh of the file takes: itself, and what poses read of it.
struct MeshBytes {
    double mesh = 0.0;
    double influences = 0.0;
    std::vector<double> targets;
};

double count_of(const GltfDocument& document, int accessor) {
    const auto& accessors = document.model.accessors;
    if (!GltfDocument::has(accessor, accessors.size())) return 0.0; // an error once it is read
    return static_cast<double>(accessors[static_cast<std::size_t>(accessor)].count);
}

MeshBytes mesh_bytes(const GltfDocument& document, const tinygltf::Mesh& mesh) {
    MeshBytes bytes;
    std::set<VertexKey> known;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        const VertexKey key = vertex_key(primitive);
        const double vertices = count_of(document, key[0]);
        bytes.mesh += index_bytes * count_of(document, primitive.indices);
        bytes.influences += influence_bytes * vertices * static_cast<double>(primitive.attributes.size());
        bytes.targets.resize(std::max(bytes.targets.size(), primitive.targets.size()));
        for (std::size_t i = 0; i < primitive.targets.size(); ++i)
            bytes.targets[i] += move_bytes * vertices * static_cast<double>(primitive.targets[i].size());
        if (!known.insert(key).second) continue;
        for (std::size_t i = 0; i < key.size(); ++i)
            if (key[i] >= 0) bytes.mesh += attribute_bytes[i] * vertices;
    }
    return bytes;
}

double pose_bytes(const GltfDocument& document, const MeshForm& form, const MeshBytes& mesh) {
    const std::vector<double>& weights = morph_weights(document, form.node);
    double bytes = weight_bytes * static_cast<double>(weights.size());
    for (std::size_t i = 0; i < std::min(weights.size(), mesh.targets.size()); ++i)
        if (weights[i] != 0.0) bytes += mesh.targets[i];
    const int skin = document.model.nodes[form.node].skin;
    if (!GltfDocument::has(skin, document.model.skins.size())) return bytes;
    const auto joints = static_cast<double>(document.model.skins[static_cast<std::size_t>(skin)].joints.size());
    return bytes + mesh.influences + joint_bytes * joints;
}

void check_bytes(const GltfDocument& document, const std::vector<MeshForm>& forms) {
    std::map<std::size_t, MeshBytes> meshes;
    double bytes = 0.0;
    for (const MeshForm& form : forms) {
        const auto found = meshes.find(form.mesh);
        if (found != meshes.end()) bytes += found->second.mesh;
        const MeshBytes& mesh =
            found != meshes.end()
                ? found->second
                : meshes.emplace(form.mesh, mesh_bytes(document, document.model.meshes[form.mesh])).first->second;
        bytes += pose_bytes(document, form, mesh);
        if (bytes > most_bytes)
            document.fail(element("nodes", form.node),
                          "is one of so many that skin, morph or flatten a mesh that they need more than 4 GiB");
    }
}

/// Whether instances cannot show what a transform leaves of a mesh.
bool is_flattened(const glm::dmat4& to_world) {
    const glm::mat4 transform(to_world);
    return affine_fault(transform).empty() && !transform_fault(transform).empty() &&
           spans_plane(glm::dmat3(glm::dmat4(transform)));
}

/// A mesh and the weights of the node, where they differ from those of the mesh.
using Shape = std::pair<std::size_t, std::vector<double>>;

Shape shape_of(const GltfDocument& document, std::size_t node) {
    const auto mesh = static_cast<std::size_t>(document.model.nodes[node].mesh);
    const std::vector<double>& weights = morph_weights(document, node);
    return weights == document.model.meshes[mesh].weights ? Shape{mesh, {}} : Shape{mesh, weights};
}

} // namespace

const std::vector<double>& morph_weights(const GltfDocument& document, std::size_t node) {
    const tinygltf::Node& source = document.model.nodes[node];
    return source.weights.empty() ? document.model.meshes[static_cast<std::size_t>(source.mesh)].weights
                                  : source.weights;
}

MeshForms mesh_forms(const GltfDocument& document, const std::vector<ShownMesh>& shown) {
    std::map<Shape, std::vector<std::size_t>> by_shape;
    std::vector<std::size_t> placed;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (document.model.nodes[shown[i].node].skin >= 0 || is_flattened(shown[i].to_world))
            placed.push_back(i);
        else
            by_shape[shape_of(document, shown[i].node)].push_back(i);
    }
    MeshForms result;
    result.of_shown.resize(shown.size());
    for (const auto& [shape, users] : by_shape) {
        for (const std::size_t user : users) result.of_shown[user] = result.forms.size();
        result.forms.push_back({shape.first, shown[users.front()].node, std::nullopt});
    }
    for (const std::size_t i : placed) {
        result.of_shown[i] = result.forms.size();
        const auto mesh = static_cast<std::size_t>(document.model.nodes[shown[i].node].mesh);
        result.forms.push_back({mesh, shown[i].node, i});
    }
    check_bytes(document, result.forms);
    return result;
}

} // namespace boxwood
