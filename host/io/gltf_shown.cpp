// SPDX-License-Identifier: MIT
#include "io/gltf_shown.hpp"

#include <optional>
#include <string>

#include "common/excerpt.hpp"
#include "io/gltf_accessor.hpp"

namespace boxwood {

namespace {

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// The count that all attributes of the instances have, also those of the application's own, which are not read.
std::size_t instance_count(const GltfDocument& document, const tinygltf::Value& attributes, const std::string& where) {
    std::optional<std::size_t> count;
    for (const std::string& name : attributes.Keys()) {
        const std::size_t elements =
            element_count(document, attributes.Get(name).GetNumberAsInt(), where + "." + excerpt(name));
        if (count && *count != elements)
            document.fail(where + "." + excerpt(name), "differs in count from the other attributes");
        count = elements;
    }
    if (!count) document.fail(where, "has no attribute");
    return *count;
}

/// EXT_mesh_gpu_instancing: one T R S per instance below the node's own transform.
void add_instances(const GltfDocument& document, const PlacedNode& placed, const tinygltf::Value& extension,
                   std::vector<ShownMesh>& shown) {
    const std::string where = element("nodes", placed.node) + ".extensions." + instancing + ".attributes";
    const tinygltf::Value& attributes = extension.Get("attributes");
    const std::size_t count = instance_count(document, attributes, where);
    const auto accessor = [&](const char* name) {
        return attributes.Has(name) ? attributes.Get(name).GetNumberAsInt() : -1;
    };
    const int t = accessor("TRANSLATION");
    const int r = accessor("ROTATION");
    const int s = accessor("SCALE");
    const auto translations = t < 0 ? std::vector<glm::vec3>() : read_vec3(document, t, where + ".TRANSLATION");
    const auto rotations = r < 0 ? std::vector<glm::vec4>() : read_vec4(document, r, where + ".ROTATION");
    const auto scales = s < 0 ? std::vector<glm::vec3>() : read_vec3(document, s, where + ".SCALE");
    if (t < 0 && r < 0 && s < 0 && count > largest_implicit_count) document.fail(where, "has too many elements");
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dmat4 local = compose(t < 0 ? glm::dvec3(0.0) : glm::dvec3(translations[i]),
                                         r < 0 ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(rotations[i]),
                                         s < 0 ? glm::dvec3(1.0) : glm::dvec3(scales[i]));
        shown.push_back({placed.node, placed.to_world * local});
    }
}

} // namespace

std::vector<ShownMesh> shown_meshes(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                                    Warnings& warnings) {
    std::vector<ShownMesh> shown;
    for (const PlacedNode& placed : nodes) {
        const tinygltf::Node& node = document.model.nodes[placed.node];
        if (node.mesh < 0) continue;
        const std::string where = element("nodes", placed.node);
        const auto extension = node.extensions.find(instancing);
        if (extension != node.extensions.end() && node.skin < 0) {
            add_instances(document, placed, extension->second, shown);
            continue;
        }
        if (extension != node.extensions.end())
            warnings.add(where, "is skinned, so that its instances would all be in one place; one is loaded");
        shown.push_back({placed.node, placed.to_world});
    }
    return shown;
}

} // namespace boxwood
