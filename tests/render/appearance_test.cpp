// SPDX-License-Identifier: MIT
#include <cmath>

#include "boxwood/error.hpp"
#include "render/appearance_attributes.hpp"
#include "render/appearance_scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

TEST_CASE("appearance: shading requires what materials and meshes in use ask for, and nothing else") {
    Scene scene = one_square(plain_material());
    CHECK(shading_requirements(Scene{}).attribute_floats() == 0);
    CHECK_FALSE(shading_requirements(scene).specular);
    CHECK(shading_requirements(scene).attribute_floats() == 0); // coordinates that no material reads

    // A second mesh with everything, first without an instance.
    Mesh rich = square();
    rich.normals.assign(4, {0, 0, 1});
    rich.colors.assign(4, {1, 1, 1, 1});
    rich.uvs[1] = rich.uvs[0];
    rich.materials = {1, BOXWOOD_NONE};
    scene.meshes.push_back(rich);
    Material material;
    material.emission = {1, 0, 0};
    material.alpha_mode = AlphaMode::blend;
    material.normal_texture = {0, 1};
    scene.materials.push_back(material);
    scene.images.push_back(image("noise", {2, 2}, noise({2, 2}, 1)));
    scene.textures.push_back({0});
    ShadingRequirements needs = shading_requirements(scene);
    CHECK(needs.attribute_floats() == 0);
    CHECK_FALSE((needs.materials || needs.textures || needs.alpha || needs.emission || needs.specular));

    scene.instances.push_back({"rich", 1, glm::mat4(1.0f)});
    needs = shading_requirements(scene);
    CHECK_FALSE(needs.transforms);
    CHECK((needs.materials && needs.normals && needs.tangents && needs.colors && needs.textures));
    CHECK((needs.alpha && needs.specular && needs.emission && !needs.punctual));
    CHECK(needs.uv_sets == 2);
    CHECK(needs.attribute_floats() == 15);
    scene.lights.push_back({});
    CHECK(shading_requirements(scene).punctual);
}

TEST_CASE("appearance: every required word has its reason, which names the element that asks first") {
    Scene scene = one_square(plain_material());
    CHECK(reasons(scene, {}).empty());
    CHECK(reasons(Scene{}, {}).empty());
    scene.materials[0].name = "lamp";
    scene.materials[0].emission = {1, 0, 0};
    scene.materials[0].normal_texture = {0, 1};
    scene.images.push_back(image("noise", {2, 2}, noise({2, 2}, 1)));
    scene.textures.push_back({0});
    scene.meshes[0].materials[1] = BOXWOOD_NONE;
    scene.meshes[0].colors.assign(4, {1, 1, 1, 1});
    scene.instances.push_back({"again", 0, glm::mat4(2.0f)});
    scene.lights.push_back({"sun", LightKind::directional});
    BuildOptions options;
    options.bounds.kind = Bounds::obb_points;
    const std::vector<Reason> all = reasons(scene, options);
    std::vector<std::string> expected = words(requirements(scene, options));
    const std::vector<std::string> shading = words(shading_requirements(scene));
    expected.insert(expected.end(), shading.begin(), shading.end());
    REQUIRE(all.size() == expected.size());
    for (std::size_t i = 0; i < all.size(); ++i) CHECK(all[i].word == expected[i]);
    const auto because = [&all](const std::string& word) {
        for (const Reason& reason : all)
            if (reason.word == word) return reason.because;
        return std::string("nothing");
    };
    CHECK(because("two-levels") == "meshes[0] \"square\" is placed 2 times");
    CHECK(because("oriented-boxes") == "the options ask for obb-points");
    CHECK(because("transforms") == "instances[1] \"again\" is placed by a transform");
    CHECK(because("materials") == "materials[0] \"lamp\" and the plain material are in use");
    CHECK(because("second-texture-coordinates") == "materials[0] \"lamp\" has a texture of its normal");
    CHECK(because("colors") == "meshes[0] \"square\" has colours");
    CHECK(because("emission") == "materials[0] \"lamp\" emits light");
    CHECK(because("punctual-lights") == "lights[0] \"sun\" is one");
    CHECK(because("alpha") == "nothing");
}

TEST_CASE("appearance: attributes are interleaved, with zeros and white where a mesh lacks them") {
    Scene scene = one_square(plain_material());
    Mesh rich = square();
    rich.normals.assign(4, {0, 0, 1});
    rich.colors = {{.1f, .2f, .3f, .4f}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
    rich.materials = {BOXWOOD_NONE, 1};
    scene.meshes.push_back(rich);
    Material material;
    material.base_color_texture.texture = 0;
    scene.materials.push_back(material);
    scene.images.push_back(image("noise", {2, 2}, noise({2, 2}, 1)));
    scene.textures.push_back({0});
    scene.instances.push_back({"rich", 1, glm::mat4(1.0f)});

    const Appearance appearance = appearance_of(scene);
    const std::vector<float> plain_vertex = {0, 0, 0, 1, 0, 1, 1, 1, 1}; // normal, uv, colour of vertex 1 of the first
    const std::vector<float> rich_vertex = {0, 0, 1, 0, 0, .1f, .2f, .3f, .4f};
    const std::vector<float> all = download(test_device(), appearance.attributes);
    REQUIRE(all.size() == 8 * 9);
    CHECK(std::vector<float>(all.begin() + 9, all.begin() + 18) == plain_vertex);
    CHECK(std::vector<float>(all.begin() + 36, all.begin() + 45) == rich_vertex);
    // The plain material is the last.
    CHECK(download(test_device(), appearance.triangle_materials) == std::vector<std::uint32_t>{0, 0, 2, 1});
    const auto materials = download(test_device(), appearance.materials);
    REQUIRE(materials.size() == 3);
    CHECK(materials[2].base_color[0] == 0.8f);
    CHECK(materials[1].textures[BOXWOOD_BASE_COLOR].texture == 0);
    CHECK(materials[0].textures[BOXWOOD_BASE_COLOR].texture == BOXWOOD_NONE);
}

TEST_CASE("appearance: there are two sets of texture coordinates at most") {
    const Scene scene = one_square(plain_material());
    ShadingRequirements needs = shading_requirements(scene);
    std::vector<std::string> warnings;
    needs.uv_sets = 2;
    CHECK(upload_appearance(test_device(), scene, needs, warnings).attributes.size() == 4 * 4);
    needs.uv_sets = 3;
    CHECK_THROWS_AS(upload_appearance(test_device(), scene, needs, warnings), InputError);
}

TEST_CASE("appearance: of one material in use there is one record and no list, and an empty scene has nothing") {
    Scene scene = one_square(plain_material());
    scene.materials.insert(scene.materials.begin(), Material{});
    scene.meshes[0].materials = {1, 1};
    const Appearance appearance = appearance_of(scene);
    CHECK(appearance.triangle_materials.size() == 0);
    CHECK(appearance.attributes.size() == 0);
    CHECK(appearance.lights.size() == 0);
    CHECK(appearance.light_nodes.size() == 0);
    const auto materials = download(test_device(), appearance.materials);
    REQUIRE(materials.size() == 1);
    CHECK(materials[0].base_color[0] == 0.8f);
    CHECK(appearance_of(Scene{}).materials.size() == 1);
}

TEST_CASE("appearance: made tangents follow growing u, whatever the size, and v's side decides their sign") {
    Material material;
    material.normal_texture.texture = 0;
    for (const float scale : {1.0f, 0x1p-40f, 0x1p40f}) {
        CAPTURE(scale);
        Scene scene = one_square(material);
        Mesh& mesh = scene.meshes[0];
        for (glm::vec3& p : mesh.positions) p *= scale;
        const glm::vec2 along(0.8f, 0.6f), across(-0.6f, 0.8f); // u grows along the first, v along the second
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::vec2 p(mesh.positions[i] / scale);
            mesh.uvs[0][i] = {3 * glm::dot(p, along), 7 * glm::dot(p, across)};
        }
        for (const glm::vec4& t : make_tangents(scene, mesh)) {
            CHECK(glm::length(glm::vec3(t) - glm::vec3(along, 0)) < 1e-6f);
            CHECK(t.w == -1.0f); // the bitangent goes against v
        }
        for (glm::vec2& uv : mesh.uvs[0]) uv.y = -uv.y;
        for (const glm::vec4& t : make_tangents(scene, mesh)) {
            CHECK(glm::length(glm::vec3(t) - glm::vec3(along, 0)) < 1e-6f);
            CHECK(t.w == 1.0f);
        }
        // A vertex normal away from the triangle's: the tangent is perpendicular to it.
        mesh.normals.assign(4, glm::normalize(glm::vec3(0.5f, 0, 1)));
        for (const glm::vec4& t : make_tangents(scene, mesh)) {
            CHECK(std::abs(glm::dot(glm::vec3(t), mesh.normals[0])) < 1e-6f);
            CHECK(glm::length(glm::vec3(t)) == doctest::Approx(1.0));
        }
        // Coordinates along a line, and all the same: no direction.
        for (glm::vec2& uv : mesh.uvs[0]) uv.y = uv.x;
        for (const glm::vec4& t : make_tangents(scene, mesh)) CHECK(t == glm::vec4(0.0f));
        mesh.uvs[0].assign(4, {0.5f, 0.5f});
        for (const glm::vec4& t : make_tangents(scene, mesh)) CHECK(t == glm::vec4(0.0f));
    }
}

TEST_CASE("appearance: tangents of a mesh stay, and are made where they are zero") {
    Material material;
    material.normal_texture.texture = 0;
    Scene scene = one_square(material);
    scene.textures = {{0}};
    scene.images = {image("flat", {1, 1}, {128, 128, 255, 255})};
    scene.meshes[0].tangents = {{0, 1, 0, -1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 1}};
    const Appearance appearance = appearance_of(scene);
    REQUIRE(appearance.requirements.attribute_floats() == 9); // normal, tangent, uv
    const auto all = download(test_device(), appearance.attributes);
    const auto tangent = [&all](std::size_t vertex) {
        const float* at = &all[9 * vertex + 3];
        return glm::vec4(at[0], at[1], at[2], at[3]);
    };
    CHECK(tangent(0) == glm::vec4(0, 1, 0, -1));
    CHECK(tangent(1) == glm::vec4(1, 0, 0, -1));
    CHECK(tangent(2) == glm::vec4(1, 0, 0, -1));
    CHECK(tangent(3) == glm::vec4(0, 0, 1, 1));
}

TEST_CASE("appearance: the texture's transform turns made tangents") {
    Material material;
    material.normal_texture.texture = 0;
    // u' = v, v' = -u: u' grows along y.
    material.normal_texture.transform = glm::mat3(0, -1, 0, 1, 0, 0, 0, 0, 1);
    const Scene scene = one_square(material);
    for (const glm::vec4& t : make_tangents(scene, scene.meshes[0])) CHECK(t == glm::vec4(0, 1, 0, -1));
}

TEST_SUITE_END();
