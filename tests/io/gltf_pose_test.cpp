// SPDX-License-Identifier: MIT
// Skins and morph targets at rest, against the definition in double precision.
#include "io/gltf_pose.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <doctest/doctest.h>
#include <glm/gtc/type_ptr.hpp>

#include "io/gltf_fixture.hpp"
#include "support.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

/// A square from -1 to 1 that its only joint, node 0, holds. Node 1 shows it.
GltfFixture skinned_square(float size = 1.0f) {
    GltfFixture fixture;
    const std::size_t positions = fixture.positions({-size, -size, 0, size, -size, 0, size, size, 0, -size, size, 0});
    const std::size_t joints = fixture.accessor(fixture.view(std::vector<std::uint8_t>(16, 0)), 5121, 4, "VEC4");
    const std::size_t weights = fixture.accessor(
        fixture.view(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5126, 4, "VEC4");
    fixture.append("nodes", {{"name", "bone"}});
    fixture.show({{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                  {"indices", fixture.indices({0, 1, 2, 0, 2, 3})}},
                 {{"skin", 0}, {"name", "square"}});
    fixture.root["skins"] = {{{"joints", {0}}}};
    return fixture;
}

json& attributes_of(GltfFixture& fixture) { return fixture.root["meshes"][0]["primitives"][0]["attributes"]; }

void check_x_from_minus_1_to_1(const Scene& scene) {
    REQUIRE(scene.instances.size() == 1);
    CHECK(scene.instances[0].transform == glm::mat4(1.0f));
    CHECK(scene.instances[0].name == "square");
    REQUIRE(scene.meshes.size() == 1);
    float low = 0.0f, high = 0.0f;
    for (const glm::vec3& position : scene.meshes[0].positions) {
        low = std::min(low, position.x);
        high = std::max(high, position.x);
    }
    CHECK(low == -1.0f);
    CHECK(high == 1.0f);
    CHECK(scene.counts.dropped_instances == 0);
    CHECK(scene.warnings.empty());
}

} // namespace

TEST_CASE("gltf_pose: a skinned mesh is placed by its joints, not by its node") {
    GltfFixture moved = skinned_square();
    moved.root["nodes"][1]["translation"] = {100, 0, 0};
    check_x_from_minus_1_to_1(moved.load());

    GltfFixture zero = skinned_square();
    zero.root["nodes"][1]["scale"] = {0, 0, 0};
    check_x_from_minus_1_to_1(zero.load());

    // As exporters from centimetres have it: the vertices a hundred times as large, the joint's parent a hundredth.
    GltfFixture centimetres = skinned_square(128.0f);
    centimetres.append("nodes", {{"children", {0}}, {"scale", {0x1p-7, 0x1p-7, 0x1p-7}}});
    check_x_from_minus_1_to_1(centimetres.load());

    // A joint outside the scene that is shown has its place all the same.
    centimetres.root["scenes"] = {{{"nodes", {1}}}};
    check_x_from_minus_1_to_1(centimetres.load());

    // Instances of one skinned node would be in one place.
    GltfFixture instanced = skinned_square();
    instanced.root["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        instanced.positions({1, 2, 3, 4, 5, 6});
    const Scene scene = instanced.load();
    CHECK(scene.instances.size() == 1);
    CHECK(scene.warnings.at(0).starts_with("nodes[1]: is skinned"));
}

namespace {

/// A mesh whose vertices hang on up to eight of five joints, and what becomes of it by the definition.
struct RandomSkin {
    static constexpr std::size_t vertices = 30, joints = 5, sets = 2;
    GltfFixture fixture;
    std::vector<glm::dmat4> joint_to_world;
    std::vector<glm::dmat4> inverse_binds;
    std::vector<glm::dvec3> positions, normals;
    std::vector<std::array<std::size_t, 4 * sets>> joint_numbers;
    std::vector<std::array<double, 4 * sets>> weights; ///< As the file has them.

    glm::dmat4 matrix(std::size_t vertex) const {
        glm::dmat4 sum(0.0);
        double total = 0.0;
        for (std::size_t k = 0; k < 4 * sets; ++k) {
            const std::size_t joint = joint_numbers[vertex][k];
            sum += weights[vertex][k] * (joint_to_world[joint] * inverse_binds[joint]);
            total += weights[vertex][k];
        }
        return sum / total;
    }
};

json numbers_of(const glm::dmat4& matrix) {
    json numbers = json::array();
    for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
    return numbers;
}

glm::dmat4 random_affine(test::Random& random) {
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            matrix[column][row] = static_cast<double>(random.uniform(-1, 1)) + (column == row ? 2.0 : 0.0);
    return matrix;
}

/// Weights of component type 5121 (bytes), 5123 (shorts) or 5126 (floats); they do not sum to 1 but for rounding.
RandomSkin random_skin(int weight_type, bool short_joints, std::uint32_t seed) {
    test::Random random(seed);
    RandomSkin skin;
    GltfFixture& file = skin.fixture;
    std::vector<float> positions, normals, tangents, binds;
    for (std::size_t i = 0; i < 3 * RandomSkin::vertices; ++i) positions.push_back(random.uniform(-5, 5));
    for (std::size_t i = 0; i < RandomSkin::vertices; ++i) {
        const glm::vec3 n = glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), 1.5f));
        normals.insert(normals.end(), {n.x, n.y, n.z});
        skin.normals.emplace_back(n);
        skin.positions.emplace_back(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    }
    json joints = json::array();
    for (std::size_t j = 0; j < RandomSkin::joints; ++j) {
        // A chain: each is the child of the one before.
        const glm::dmat4 local = random_affine(random);
        skin.joint_to_world.push_back(j == 0 ? local : skin.joint_to_world.back() * local);
        json node = {{"matrix", numbers_of(local)}};
        if (j + 1 < RandomSkin::joints) node["children"] = {j + 1};
        file.append("nodes", node);
        joints.push_back(RandomSkin::joints - 1 - j); // numbers of joints are not those of nodes
        const glm::mat4 bind(random_affine(random));
        skin.inverse_binds.emplace_back(bind);
        binds.insert(binds.end(), glm::value_ptr(bind), glm::value_ptr(bind) + 16);
    }
    std::reverse(skin.joint_to_world.begin(), skin.joint_to_world.end());
    skin.joint_numbers.resize(RandomSkin::vertices);
    skin.weights.resize(RandomSkin::vertices);
    json attributes = {{"POSITION", file.positions(positions)}, {"NORMAL", file.positions(normals)}};
    for (std::size_t set = 0; set < RandomSkin::sets; ++set) {
        std::vector<std::uint8_t> numbers, bytes;
        std::vector<std::uint16_t> wide_numbers, shorts;
        std::vector<float> floats;
        for (std::size_t i = 0; i < RandomSkin::vertices; ++i)
            for (std::size_t k = 0; k < 4; ++k) {
                const auto joint = static_cast<std::uint8_t>(random.below(RandomSkin::joints));
                const auto code = static_cast<std::uint8_t>(1 + random.below(31)); // eight sum to some 1/2
                numbers.push_back(joint);
                wide_numbers.push_back(joint);
                bytes.push_back(code);
                shorts.push_back(static_cast<std::uint16_t>(code * 257));
                floats.push_back(static_cast<float>(code) / 255.0f);
                skin.joint_numbers[i][4 * set + k] = joint;
                skin.weights[i][4 * set + k] = code / 255.0;
            }
        const std::string number = std::to_string(set);
        attributes["JOINTS_" + number] =
            short_joints ? file.accessor(file.view(wide_numbers), 5123, RandomSkin::vertices, "VEC4")
                         : file.accessor(file.view(numbers), 5121, RandomSkin::vertices, "VEC4");
        const std::size_t view = weight_type == 5121   ? file.view(bytes)
                                 : weight_type == 5123 ? file.view(shorts)
                                                       : file.view(floats);
        const std::size_t weights = file.accessor(view, weight_type, RandomSkin::vertices, "VEC4");
        if (weight_type != 5126) file.root["accessors"][weights]["normalized"] = true;
        attributes["WEIGHTS_" + number] = weights;
    }
    file.show({{"attributes", attributes}}, {{"skin", 0}, {"scale", {3, 4, 5}}});
    file.root["skins"] = {{{"joints", joints},
                           {"inverseBindMatrices", file.accessor(file.view(binds), 5126, RandomSkin::joints, "MAT4")}}};
    return skin;
}

} // namespace

TEST_CASE("gltf_pose: a vertex is at the weighted sum of its joints, of any component types and two sets") {
    for (const int weight_type : {5121, 5123, 5126})
        for (const bool short_joints : {false, true}) {
            CAPTURE(weight_type);
            CAPTURE(short_joints);
            const RandomSkin skin = random_skin(weight_type, short_joints, 11);
            const Scene scene = skin.fixture.load();
            const Mesh& mesh = scene.meshes.at(0);
            REQUIRE(mesh.positions.size() == RandomSkin::vertices);
            for (std::size_t i = 0; i < RandomSkin::vertices; ++i) {
                const glm::dmat4 matrix = skin.matrix(i);
                const glm::dvec3 wanted(matrix * glm::dvec4(skin.positions[i], 1.0));
                CHECK(glm::length(glm::dvec3(mesh.positions[i]) - wanted) <= 1e-6 * (1.0 + glm::length(wanted)));
                const glm::dvec3 normal =
                    glm::normalize(glm::transpose(glm::inverse(glm::dmat3(matrix))) * skin.normals[i]);
                CHECK(glm::length(glm::dvec3(mesh.normals[i]) - normal) <= 1e-5);
            }
            REQUIRE(scene.warnings.size() == 1); // the sums are far off 1
            CHECK(scene.warnings[0] ==
                  "meshes[0].primitives[0].attributes.WEIGHTS_0: vertices whose weights do not sum to 1, divided by "
                  "their sum: 30");
        }
}

TEST_CASE("gltf_pose: joints that mirror turn triangles and tangents, so that their fronts and bitangents stay with "
          "the surface") {
    GltfFixture fixture = skinned_square();
    attributes_of(fixture)["NORMAL"] = fixture.positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    attributes_of(fixture)["TANGENT"] = fixture.accessor(
        fixture.view(std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}), 5126, 4, "VEC4");
    for (const bool mirrored : {false, true}) {
        fixture.root["nodes"][0]["scale"] = {mirrored ? -2 : 2, 2, 2};
        const Mesh mesh = fixture.load().meshes.at(0);
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            CHECK(glm::cross(b - a, c - a).z > 0.0f);
        }
        CHECK(mesh.normals[0] == glm::vec3(0, 0, 1));
        const glm::vec4 t = mesh.tangents[0];
        CHECK(t.x == (mirrored ? -1.0f : 1.0f));
        CHECK(t.w * glm::cross(mesh.normals[0], glm::vec3(t)) == glm::vec3(0, 1, 0)); // where the bitangent was
    }
    // A joint that flattens leaves no normals but those of the triangles.
    fixture.root["nodes"][0]["scale"] = {1, 1, 0};
    CHECK(fixture.load().meshes.at(0).normals[0] == glm::vec3(0));
}

TEST_CASE("gltf_pose: weights that say nothing are replaced with a warning, joints that do not exist are named") {
    const auto with_weights = [](const std::vector<float>& first) {
        GltfFixture fixture = skinned_square();
        std::vector<float> weights(16, 0.0f);
        for (std::size_t i = 0; i < 16; ++i) weights[i] = i % 4 == 0 ? 1.0f : 0.0f;
        std::copy(first.begin(), first.end(), weights.begin());
        attributes_of(fixture)["WEIGHTS_0"] = fixture.accessor(fixture.view(weights), 5126, 4, "VEC4");
        return fixture;
    };
    const auto warning = [](const GltfFixture& fixture) {
        const Scene scene = fixture.load();
        REQUIRE(scene.meshes.size() == 1);
        CHECK(scene.meshes[0].positions[0] == glm::vec3(-1, -1, 0));
        return scene.warnings.empty() ? std::string() : scene.warnings[0];
    };
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::string where = "meshes[0].primitives[0].attributes.WEIGHTS_0: ";
    CHECK(warning(with_weights({0.98f})).empty()); // rounding of eight bytes
    CHECK(warning(with_weights({0.5f})).starts_with(where + "vertices whose weights"));
    CHECK(warning(with_weights({1, 0, nan, 0})).starts_with(where + "weights negative or not finite"));
    CHECK(warning(with_weights({1, infinity, 0, 0})).starts_with(where + "weights negative or not finite"));
    CHECK(warning(with_weights({1, -1, 0, 0})).starts_with(where + "weights negative or not finite"));
    CHECK(warning(with_weights({0, 0, 0, 0})).starts_with(where + "vertices without weight"));

    GltfFixture fixture = skinned_square();
    const std::string joints = "meshes[0].primitives[0].attributes.JOINTS_0";
    const auto with_joint = [&](std::uint8_t number, std::size_t place) {
        std::vector<std::uint8_t> numbers(16, 0);
        numbers[4 + place] = number;
        attributes_of(fixture)["JOINTS_0"] = fixture.accessor(fixture.view(numbers), 5121, 4, "VEC4");
        return fixture.fault();
    };
    CHECK(with_joint(1, 0) == joints + "[1]");
    CHECK(with_joint(1, 2) == "no error"); // without weight
    attributes_of(fixture)["JOINTS_0"] = 99;
    CHECK(fixture.fault() == joints);
    attributes_of(fixture).erase("JOINTS_0");
    CHECK(fixture.fault() == joints);
    attributes_of(fixture)["JOINTS_0"] =
        fixture.accessor(fixture.view(std::vector<std::uint8_t>(12, 0)), 5121, 3, "VEC4");
    CHECK(fixture.fault() == joints);
}

TEST_CASE("gltf_pose: a skin's own faults are named") {
    const auto fault = [](const json& skin) {
        GltfFixture fixture = skinned_square();
        fixture.root["skins"][0] = skin;
        return fixture.fault();
    };
    CHECK(fault({{"joints", {0}}, {"skeleton", 0}, {"name", "s"}}) == "no error");
    CHECK(fault({{"joints", json::array()}}) == "skins[0].joints");
    CHECK(fault(json::object()) == "skins[0].joints");
    CHECK(fault({{"joints", {-1, 0}}}) == "skins[0].joints"); // joints are numbered by place
    CHECK(fault({{"joints", {2}}}) == "skins[0].joints[0]");
    CHECK(fault({{"joints", {"a"}}}) == "skins[0].joints");
    CHECK(fault({{"joints", {0}}, {"inverseBindMatrices", 0}}) == "skins[0].inverseBindMatrices"); // a VEC3
    CHECK(fault({{"joints", {0}}, {"inverseBindMatrices", "a"}}) == "skins[0].inverseBindMatrices");

    GltfFixture fixture = skinned_square();
    fixture.root["nodes"][1]["skin"] = 1;
    CHECK(fixture.fault() == "nodes[1].skin");
    fixture.root["nodes"][1]["skin"] = 0;
    std::vector<float> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.0000001f};
    const auto add_matrix = [&] { return fixture.accessor(fixture.view(matrix), 5126, 1, "MAT4"); };
    fixture.root["skins"][0]["inverseBindMatrices"] = add_matrix();
    CHECK(fixture.load().meshes.at(0).positions[2] == glm::vec3(1, 1, 0));
    matrix[15] = 2;
    fixture.root["skins"][0]["inverseBindMatrices"] = add_matrix();
    const Scene scene = fixture.load();
    CHECK(scene.meshes.at(0).positions[2] == glm::vec3(1, 1, 0)); // the same as without the 2
    CHECK(scene.warnings.at(0).starts_with("skins[0].inverseBindMatrices[0]: is not affine"));
    fixture.root["skins"][0]["joints"] = {0, 1};
    CHECK(fixture.fault() == "skins[0].inverseBindMatrices"); // one for two joints
}

TEST_CASE("gltf_pose: a skinned mesh that its joints move out of range is dropped, counted and named") {
    GltfFixture fixture = skinned_square();
    fixture.append("nodes", {{"mesh", 0}}); // the mesh itself is good
    for (const json& node : {json{{"scale", {1e30, 1e30, 1e30}}}, json{{"rotation", {0, 0, 0, 0}}}}) {
        fixture.root["nodes"][0] = node;
        const Scene scene = fixture.load();
        CHECK(scene.instances.size() == 1);
        CHECK(scene.counts.dropped_instances == 1);
        CHECK(scene.counts.dropped_triangles == 2);
        REQUIRE(scene.warnings.size() == 1);
        CHECK(scene.warnings[0].starts_with("meshes[0].primitives[0].attributes.POSITION[0]"));
    }
}

TEST_CASE("gltf_pose: a primitive without joints in a skinned mesh is placed by its node, with a warning") {
    GltfFixture fixture = skinned_square();
    attributes_of(fixture).erase("JOINTS_0");
    attributes_of(fixture).erase("WEIGHTS_0");
    fixture.root["nodes"][1]["translation"] = {10, 0, 0};
    const Scene scene = fixture.load();
    CHECK(scene.meshes.at(0).positions[0] == glm::vec3(9, -1, 0));
    CHECK(scene.warnings.at(0).starts_with("meshes[0].primitives[0]: has no joints"));
}

TEST_CASE("gltf_pose: morph targets are added with the weights of the mesh, or of the node before them") {
    GltfFixture fixture = test::triangle_fixture();
    json& primitive = fixture.root["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = fixture.positions({0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["attributes"]["TANGENT"] =
        fixture.accessor(fixture.view(std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}), 5126, 3, "VEC4");
    primitive["targets"] = {{{"POSITION", fixture.positions({8, 0, 0, 0, 0, 0, 0, 0, 0})},
                             {"NORMAL", fixture.positions({0, 0, 0, 4, 0, 0, 0, 0, 0})},
                             {"TANGENT", fixture.positions({0, 0, 0, 0, 0, 0, 0, 4, 0})}},
                            {{"POSITION", fixture.positions({0, 16, 0, 0, 0, 0, 0, 0, 1})}}};
    const Mesh base = fixture.load().meshes.at(0);
    CHECK(base.positions[0] == glm::vec3(0, 0, 0)); // no weights: none counts
    fixture.root["meshes"][0]["weights"] = {0.25, 0.5};
    fixture.append("nodes", {{"mesh", 0}, {"weights", {0, 1}}});
    fixture.append("nodes", {{"mesh", 0}, {"weights", {0, 1}}, {"translation", {1, 0, 0}}});
    fixture.append("nodes", {{"mesh", 0}, {"weights", {0.25, 0.5}}});
    const Scene scene = fixture.load();
    CHECK(scene.warnings.empty());
    REQUIRE(scene.meshes.size() == 2); // one for each choice of weights
    REQUIRE(scene.instances.size() == 4);
    CHECK(scene.instances[0].mesh == 0);
    CHECK(scene.instances[1].mesh == 1);
    CHECK(scene.instances[2].mesh == 1);
    CHECK(scene.instances[3].mesh == 0);
    CHECK(scene.meshes[0].positions == std::vector<glm::vec3>{{2, 8, 0}, {1, 0, 0}, {0, 1, 0.5f}});
    CHECK(scene.meshes[1].positions == std::vector<glm::vec3>{{0, 16, 0}, {1, 0, 0}, {0, 1, 1}});
    const float c = std::sqrt(0.5f);
    CHECK(glm::length(scene.meshes[0].normals[1] - glm::vec3(c, 0, c)) < 1e-6f);
    CHECK(scene.meshes[0].normals[0] == glm::vec3(0, 0, 1));
    CHECK(glm::length(scene.meshes[0].tangents[2] - glm::vec4(c, c, 0, -1)) < 1e-6f);
    CHECK(scene.meshes[1].normals == base.normals);

    // Weights for targets that are not there, and a target that is not read.
    fixture.root["meshes"][0]["weights"] = {0, 0, 7};
    fixture.root["nodes"][3].erase("weights");
    primitive["targets"][0]["COLOR_0"] = primitive["targets"][0]["POSITION"];
    CHECK(fixture.load().warnings.empty());
    fixture.root["nodes"][0]["weights"] = {1};
    CHECK(fixture.load().warnings.at(0).starts_with("meshes[0].primitives[0].targets[0].COLOR_0"));

    primitive["targets"][0] = {{"POSITION", fixture.positions({0, 0, 0})}};
    CHECK(fixture.fault() == "meshes[0].primitives[0].targets[0].POSITION");
    fixture.root["meshes"][0]["weights"] = {"a"};
    CHECK(fixture.fault() == "meshes[0].weights");
    fixture.root["meshes"][0].erase("weights");
    fixture.root["nodes"][0]["weights"] = 1;
    CHECK(fixture.fault() == "nodes[0].weights");
}

TEST_CASE("gltf_pose: morph targets come before joints") {
    GltfFixture fixture = skinned_square();
    fixture.root["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", fixture.positions({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0})}}};
    fixture.root["meshes"][0]["weights"] = {1};
    fixture.root["nodes"][0]["scale"] = {2, 2, 2};
    CHECK(fixture.load().meshes.at(0).positions[1] == glm::vec3(4, -2, 0)); // 2 * (1 + 1)
}

TEST_SUITE_END();
