// SPDX-License-Identifier: MIT
#include "io/gltf_nodes.hpp"

#include <cmath>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace boxwood {

namespace {

/// A node to visit. Roots have no parent, so that their matrices pass through without arithmetic.
struct Pending {
    std::size_t node;
    const glm::dmat4* parent;
};

// The parents of all nodes must make trees: no node with two, none that no root reaches (it would be on a cycle).
std::vector<std::size_t> find_roots(const GltfDocument& document) {
    const std::vector<tinygltf::Node>& nodes = document.model.nodes;
    std::vector<bool> has_parent(nodes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t k = 0; k < nodes[i].children.size(); ++k) {
            const int child = nodes[i].children[k];
            const auto where = [&] { return element(element("nodes", i) + ".children", k); };
            if (!GltfDocument::has(child, nodes.size())) document.fail(where(), "names a node that does not exist");
            if (has_parent[static_cast<std::size_t>(child)]) {
                document.fail(where(), "names nodes[" + std::to_string(child) + "], which has a parent already");
            }
            has_parent[static_cast<std::size_t>(child)] = true;
        }
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!has_parent[i]) roots.push_back(i);
    }
    std::vector<std::size_t> stack = roots;
    std::vector<bool> reached(nodes.size(), false);
    while (!stack.empty()) {
        const std::size_t node = stack.back();
        stack.pop_back();
        reached[node] = true;
        for (const int child : nodes[node].children) stack.push_back(static_cast<std::size_t>(child));
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!reached[i]) document.fail(element("nodes", i), "is its own ancestor");
    }
    return roots;
}

/// Of the nodes that a scene lists, those that are not there already: below another one, or listed before.
std::vector<std::size_t> without_repeats(const GltfDocument& document, const std::vector<std::size_t>& listed,
                                         const std::string& where, Warnings& warnings) {
    const std::vector<tinygltf::Node>& nodes = document.model.nodes;
    std::vector<bool> there(nodes.size(), false);
    std::vector<std::size_t> stack = listed;
    for (std::vector<std::size_t> below; !stack.empty(); stack.swap(below), below.clear())
        for (const std::size_t node : stack)
            for (const int child : nodes[node].children) {
                const auto index = static_cast<std::size_t>(child);
                if (!there[index]) below.push_back(index);
                there[index] = true;
            }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        if (there[listed[i]])
            warnings.add_repeated(element(where, i), "names a node that is in the scene already; it is there once");
        else
            roots.push_back(listed[i]);
        there[listed[i]] = true;
    }
    return roots;
}

std::vector<std::size_t> scene_roots(const GltfDocument& document, Warnings& warnings) {
    const tinygltf::Model& model = document.model;
    std::vector<std::size_t> roots = find_roots(document);
    if (model.defaultScene >= 0 && !GltfDocument::has(model.defaultScene, model.scenes.size())) {
        document.fail("scene", "is " + std::to_string(model.defaultScene) + ", which does not exist");
    }
    if (model.scenes.empty()) return roots;
    const auto scene = static_cast<std::size_t>(model.defaultScene >= 0 ? model.defaultScene : 0);
    roots.clear();
    for (const int node : model.scenes[scene].nodes) {
        if (!GltfDocument::has(node, model.nodes.size())) {
            document.fail(element(element("scenes", scene) + ".nodes", roots.size()),
                          "names a node that does not exist");
        }
        roots.push_back(static_cast<std::size_t>(node));
    }
    return without_repeats(document, roots, element("scenes", scene) + ".nodes", warnings);
}

template <class Vector>
Vector value_or(const std::vector<double>& values, Vector otherwise) {
    for (std::size_t i = 0; i < values.size(); ++i) otherwise[static_cast<glm::length_t>(i)] = values[i];
    return otherwise;
}

glm::dmat4 local_transform(const GltfDocument& document, std::size_t index, Warnings& warnings) {
    const tinygltf::Node& node = document.model.nodes[index];
    if (!node.matrix.empty()) {
        glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
        const std::string where = element("nodes", index) + ".matrix";
        const glm::dvec4 row = glm::row(matrix, 3);
        constexpr double rounding = 0x1p-20; // a few units in the last place of float
        if (glm::dvec3(row) != glm::dvec3(0.0) || !(std::abs(row.w - 1.0) <= rounding))
            document.fail(where, "is not affine: its last row is not 0 0 0 1");
        if (row.w != 1.0) warnings.add_repeated(where, "has a last element that is not quite 1; taken as 1");
        matrix[3][3] = 1.0;
        return matrix;
    }
    if (node.rotation.empty() && node.scale.empty() && node.translation.empty()) return glm::dmat4(1.0);
    return compose(value_or(node.translation, glm::dvec3(0.0)), value_or(node.rotation, glm::dvec4(0, 0, 0, 1)),
                   value_or(node.scale, glm::dvec3(1.0)));
}

} // namespace

glm::dmat4 compose(glm::dvec3 translation, glm::dvec4 rotation, glm::dvec3 scale) {
    // Quantised and decimal rotations are unit length only nearly; without this they would scale.
    const glm::dvec4 q = rotation / glm::length(rotation);
    const glm::dmat3 turn = glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z));
    return {glm::dvec4(turn[0] * scale.x, 0.0), glm::dvec4(turn[1] * scale.y, 0.0), glm::dvec4(turn[2] * scale.z, 0.0),
            glm::dvec4(translation, 1.0)};
}

std::vector<PlacedNode> place_nodes(const GltfDocument& document, Warnings& warnings) {
    const std::vector<tinygltf::Node>& nodes = document.model.nodes;
    const std::vector<std::size_t> roots = scene_roots(document, warnings);
    std::vector<Pending> stack;
    for (std::size_t i = roots.size(); i-- > 0;) stack.push_back({roots[i], nullptr});

    std::vector<PlacedNode> placed;
    placed.reserve(nodes.size()); // each is placed once at most, so that pointers to parents stay valid
    while (!stack.empty()) {
        const Pending next = stack.back();
        stack.pop_back();
        const glm::dmat4 local = local_transform(document, next.node, warnings);
        placed.push_back({next.node, next.parent != nullptr ? *next.parent * local : local});
        const std::vector<int>& children = nodes[next.node].children;
        for (std::size_t i = children.size(); i-- > 0;) {
            stack.push_back({static_cast<std::size_t>(children[i]), &placed.back().to_world});
        }
    }
    return placed;
}

std::vector<glm::dmat4> global_transforms(const GltfDocument& document) {
    Warnings ignored; // place_nodes has them
    std::vector<glm::dmat4> transforms(document.model.nodes.size());
    std::vector<std::size_t> stack = find_roots(document);
    for (const std::size_t root : stack) transforms[root] = local_transform(document, root, ignored);
    while (!stack.empty()) {
        const std::size_t parent = stack.back();
        stack.pop_back();
        for (const int index : document.model.nodes[parent].children) {
            const auto child = static_cast<std::size_t>(index);
            transforms[child] = transforms[parent] * local_transform(document, child, ignored);
            stack.push_back(child);
        }
    }
    return transforms;
}

} // namespace boxwood
