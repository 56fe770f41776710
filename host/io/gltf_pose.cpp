// SPDX-License-Identifier: MIT
#include "io/gltf_pose.hpp"

#include <cmath>

#include "common/excerpt.hpp"
#include "io/gltf_accessor.hpp"
#include "io/gltf_mesh.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

/// Distance of a sum of weights from 1 that rounding does not explain: eight weights of a byte are off by 2^-6.
constexpr double far_off = 0x1p-5;

double weight_of(const Pose& pose, std::size_t target) {
    return target < pose.weights.size() ? pose.weights[target] : 0.0;
}

/// Normalised; zero where there is no direction.
glm::vec3 direction_of(const glm::dvec3& v) {
    const double square = glm::dot(v, v);
    return square > 0.0 && std::isfinite(square) ? glm::vec3(v / std::sqrt(square)) : glm::vec3(0.0f);
}

/// The vertices of a primitive in double. Normals and tangents are empty where the primitive has none.
struct Vertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> tangents;
    std::vector<bool> mirrored;
};

/// A primitive whose vertices are posed; `where` names it.
struct Posed {
    const GltfDocument& document;
    const tinygltf::Primitive& primitive;
    const Pose& pose;
    const std::string& where;
    Warnings& warnings;

    /// Throws InputError unless there is one value per vertex.
    void check_count(std::size_t values, std::size_t vertices, const std::string& accessor) const {
        if (values != vertices)
            document.fail(accessor, "has " + std::to_string(values) + " elements where there are " +
                                        std::to_string(vertices) + " positions");
    }
};

void add_scaled(const Posed& posed, int accessor, double weight, const std::string& where,
                std::vector<glm::dvec3>& target) {
    if (target.empty()) return;
    const std::vector<glm::vec3> moves = read_vec3(posed.document, accessor, where);
    posed.check_count(moves.size(), target.size(), where);
    for (std::size_t i = 0; i < moves.size(); ++i) target[i] += weight * glm::dvec3(moves[i]);
}

void add_morph_targets(const Posed& posed, Vertices& vertices) {
    for (std::size_t i = 0; i < posed.primitive.targets.size(); ++i) {
        const double weight = weight_of(posed.pose, i);
        if (weight == 0.0) continue;
        for (const auto& [name, accessor] : posed.primitive.targets[i]) {
            const std::string where = element(posed.where + ".targets", i) + "." + excerpt(name);
            if (name == "POSITION")
                add_scaled(posed, accessor, weight, where, vertices.positions);
            else if (name == "NORMAL")
                add_scaled(posed, accessor, weight, where, vertices.normals);
            else if (name == "TANGENT")
                add_scaled(posed, accessor, weight, where, vertices.tangents);
            else
                posed.warnings.add(where, "is not read; the values of the mesh stand in");
        }
    }
}

void place_vertex(const glm::dmat4& matrix, std::size_t i, Vertices& vertices) {
    const glm::dmat3 linear(matrix);
    // Of the cofactors, which are the transposed inverse but for its length and sign.
    const glm::dmat3 normal_map(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                glm::cross(linear[0], linear[1]));
    const double determinant = is_singular(linear) ? 0.0 : glm::dot(linear[0], normal_map[0]);
    vertices.positions[i] = glm::dvec3(matrix * glm::dvec4(vertices.positions[i], 1.0));
    if (!vertices.normals.empty())
        vertices.normals[i] =
            determinant == 0.0 ? glm::dvec3(0.0) : std::copysign(1.0, determinant) * (normal_map * vertices.normals[i]);
    if (!vertices.tangents.empty()) vertices.tangents[i] = linear * vertices.tangents[i];
    vertices.mirrored[i] = determinant < 0.0;
}

/// JOINTS_n and WEIGHTS_n of one n.
struct JointSet {
    std::vector<glm::vec4> joints;
    std::vector<glm::vec4> weights;
    std::string where; ///< Of the joints.
};

/// What was found in the weights, counted in vertices or values.
struct WeightFaults {
    std::size_t unusable = 0;
    std::size_t none = 0;
    std::size_t far_off = 0;
};

std::size_t set_count(const tinygltf::Primitive& primitive) {
    std::size_t sets = 0;
    while (primitive.attributes.contains("JOINTS_" + std::to_string(sets)) ||
           primitive.attributes.contains("WEIGHTS_" + std::to_string(sets)))
        ++sets;
    return sets;
}

/// The accessor of JOINTS_n or WEIGHTS_n.
int set_accessor(const GltfDocument& document, const tinygltf::Primitive& primitive, const std::string& name,
                 const std::string& where) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end())
        document.fail(where + ".attributes." + name, "is missing; JOINTS_n and WEIGHTS_n come together");
    return found->second;
}

std::vector<JointSet> read_joint_sets(const Posed& posed, std::size_t vertices) {
    std::vector<JointSet> sets(set_count(posed.primitive));
    for (std::size_t n = 0; n < sets.size(); ++n) {
        const auto read = [&](const std::string& name) {
            const std::string where = posed.where + ".attributes." + name;
            const int accessor = set_accessor(posed.document, posed.primitive, name, posed.where);
            std::vector<glm::vec4> values = read_vec4(posed.document, accessor, where);
            posed.check_count(values.size(), vertices, where);
            return values;
        };
        const std::string number = std::to_string(n);
        sets[n] = {read("JOINTS_" + number), read("WEIGHTS_" + number), posed.where + ".attributes.JOINTS_" + number};
    }
    return sets;
}

const glm::dmat4& joint_matrix(const Posed& posed, const JointSet& set, std::size_t vertex, int place) {
    const float number = set.joints[vertex][place]; // integers are exact, a NaN fails both comparisons
    const std::size_t joints = posed.pose.joints.size();
    if (!(number >= 0.0f && number < static_cast<float>(joints)) || number != std::floor(number))
        posed.document.fail(element(set.where, vertex),
                            "names a joint that its skin does not have; there are " + std::to_string(joints));
    return posed.pose.joints[static_cast<std::size_t>(number)];
}

/// The weighted sum of the joints of one vertex.
glm::dmat4 blended(const Posed& posed, const std::vector<JointSet>& sets, std::size_t vertex, WeightFaults& faults) {
    glm::dmat4 sum(0.0);
    double weights = 0.0;
    for (const JointSet& set : sets)
        for (int k = 0; k < 4; ++k) {
            const double weight = set.weights[vertex][k];
            if (!(weight >= 0.0 && std::isfinite(weight))) ++faults.unusable;
            if (!(weight > 0.0 && std::isfinite(weight))) continue; // what a joint without weight names does not matter
            sum += weight * joint_matrix(posed, set, vertex, k);
            weights += weight;
        }
    if (weights == 0.0) {
        ++faults.none;
        return joint_matrix(posed, sets.front(), vertex, 0);
    }
    if (std::abs(weights - 1.0) > far_off) ++faults.far_off;
    return sum / weights;
}

void warn(const Posed& posed, const WeightFaults& faults) {
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0) posed.warnings.add(posed.where + ".attributes.WEIGHTS_0", what + std::to_string(count));
    };
    add(faults.unusable, "weights negative or not finite, taken as 0: ");
    add(faults.none, "vertices without weight, placed by their first joint: ");
    add(faults.far_off, "vertices whose weights do not sum to 1, divided by their sum: ");
}

void place(const Posed& posed, Vertices& vertices) {
    if (!posed.pose.joints.empty() && set_count(posed.primitive) > 0) {
        const std::vector<JointSet> sets = read_joint_sets(posed, vertices.positions.size());
        WeightFaults faults;
        for (std::size_t i = 0; i < vertices.positions.size(); ++i)
            place_vertex(blended(posed, sets, i, faults), i, vertices);
        return warn(posed, faults);
    }
    if (!posed.pose.placement) return;
    if (!posed.pose.joints.empty())
        posed.warnings.add(posed.where, "has no joints though its mesh is skinned; its node places it");
    for (std::size_t i = 0; i < vertices.positions.size(); ++i) place_vertex(*posed.pose.placement, i, vertices);
}

} // namespace

std::vector<int> pose_accessors(const GltfDocument& document, const tinygltf::Primitive& primitive, const Pose& pose,
                                const std::string& where) {
    std::vector<int> accessors;
    for (std::size_t i = 0; i < primitive.targets.size(); ++i)
        if (weight_of(pose, i) != 0.0)
            for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
                const auto found = primitive.targets[i].find(name);
                accessors.push_back(found == primitive.targets[i].end() ? -1 : found->second);
            }
    if (pose.joints.empty()) return accessors;
    for (std::size_t n = 0; n < set_count(primitive); ++n)
        for (const char* name : {"JOINTS_", "WEIGHTS_"})
            accessors.push_back(set_accessor(document, primitive, name + std::to_string(n), where));
    return accessors;
}

std::vector<bool> pose_vertices(const GltfDocument& document, const tinygltf::Primitive& primitive, const Pose& pose,
                                const std::string& where, std::size_t first, Mesh& mesh, Warnings& warnings) {
    const std::size_t count = mesh.positions.size() - first;
    Vertices vertices;
    vertices.mirrored.resize(count);
    vertices.positions.assign(mesh.positions.end() - static_cast<std::ptrdiff_t>(count), mesh.positions.end());
    if (mesh.normals.size() == mesh.positions.size())
        vertices.normals.assign(mesh.normals.end() - static_cast<std::ptrdiff_t>(count), mesh.normals.end());
    if (mesh.tangents.size() == mesh.positions.size())
        for (std::size_t i = 0; i < count; ++i) vertices.tangents.emplace_back(mesh.tangents[first + i]);

    const Posed posed{document, primitive, pose, where, warnings};
    add_morph_targets(posed, vertices);
    place(posed, vertices);
    for (std::size_t i = 0; i < count; ++i) {
        mesh.positions[first + i] = glm::vec3(vertices.positions[i]);
        if (!vertices.normals.empty()) mesh.normals[first + i] = direction_of(vertices.normals[i]);
        if (vertices.tangents.empty()) continue;
        glm::vec4& tangent = mesh.tangents[first + i];
        const glm::vec3 direction = direction_of(vertices.tangents[i]);
        const float side = vertices.mirrored[i] ? -tangent.w : tangent.w;
        tangent = direction == glm::vec3(0.0f) ? glm::vec4(0.0f) : glm::vec4(direction, side);
    }
    return vertices.mirrored;
}

} // namespace boxwood
