// SPDX-License-Identifier: MIT
#include <glm/gtc/matrix_access.hpp>

#include "io/gltf_accessor.hpp"
#include "io/gltf_pose.hpp"

namespace boxwood {

namespace {

/// Of the last row of an inverse bind matrix, relative to its 1: decimal and float arithmetic of exporters.
constexpr float rounding = 0x1p-16f;

std::vector<glm::mat4> read_inverse_binds(const GltfDocument& document, const tinygltf::Skin& skin,
                                          const std::string& where, Warnings& warnings) {
    if (skin.inverseBindMatrices < 0) return std::vector<glm::mat4>(skin.joints.size(), glm::mat4(1.0f));
    std::vector<glm::mat4> matrices = read_mat4(document, skin.inverseBindMatrices, where);
    if (matrices.size() < skin.joints.size())
        document.fail(where, "has " + std::to_string(matrices.size()) + " matrices where there are " +
                                 std::to_string(skin.joints.size()) + " joints");
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        const glm::vec4 off = glm::abs(glm::row(matrices[i], 3) - glm::vec4(0, 0, 0, 1));
        if (off.x > rounding || off.y > rounding || off.z > rounding || off.w > rounding)
            warnings.add_repeated(element(where, i), "is not affine; its last row is taken as 0 0 0 1");
        matrices[i] = glm::row(matrices[i], 3, glm::vec4(0, 0, 0, 1));
    }
    return matrices;
}

} // namespace

std::vector<glm::dmat4> joint_matrices(const GltfDocument& document, int index, const std::string& node,
                                       const std::vector<glm::dmat4>& globals, Warnings& warnings) {
    const std::vector<tinygltf::Skin>& skins = document.model.skins;
    if (!GltfDocument::has(index, skins.size())) document.fail(node + ".skin", "names a skin that does not exist");
    const std::string where = element("skins", static_cast<std::size_t>(index));
    const tinygltf::Skin& skin = skins[static_cast<std::size_t>(index)];
    if (skin.joints.empty()) document.fail(where + ".joints", "has no joint");
    const std::vector<glm::mat4> inverse_binds =
        read_inverse_binds(document, skin, where + ".inverseBindMatrices", warnings);
    std::vector<glm::dmat4> matrices;
    matrices.reserve(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        if (!GltfDocument::has(skin.joints[i], globals.size()))
            document.fail(element(where + ".joints", i), "names a node that does not exist");
        matrices.push_back(globals[static_cast<std::size_t>(skin.joints[i])] * glm::dmat4(inverse_binds[i]));
    }
    return matrices;
}

} // namespace boxwood
