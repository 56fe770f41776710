// SPDX-License-Identifier: MIT
// Materials, textures, lights and attributes of glTF files, right ones and wrong ones.
#include <cmath>
#include <limits>
#include <numbers>

#include <doctest/doctest.h>

#include "boxwood/gltf.hpp"
#include "io/gltf_fixture.hpp"
#include "io/samples.hpp"
#include "scene/picture.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

std::vector<std::byte> small_png() {
    return encode_png("small", {2, 1}, 3, std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255});
}

/// A triangle with one material, one texture and one picture in the binary chunk.
GltfFixture textured_fixture() {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["meshes"][0]["primitives"][0]["material"] = 0;
    fixture.root["materials"] = {{{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    fixture.root["textures"] = json::array({{{"source", 0}}});
    fixture.root["images"] = {
        {{"bufferView", fixture.view(small_png())}, {"mimeType", "image/png"}, {"name", "small"}}};
    return fixture;
}

GltfFixture lit_fixture(const json& light) {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["extensions"] = {{"KHR_lights_punctual", {{"lights", json::array({light})}}}};
    fixture.root["nodes"].push_back({{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    if (fixture.root.contains("scenes")) fixture.root["scenes"][0]["nodes"].push_back(fixture.root["nodes"].size() - 1);
    return fixture;
}

bool warns(const Scene& scene, const std::string& part) {
    for (const std::string& warning : scene.warnings)
        if (warning.find(part) != std::string::npos) return true;
    return false;
}

} // namespace

TEST_CASE(
    "gltf_materials: a material without members is glTF's default, and a triangle without material the plain one") {
    GltfFixture fixture = test::triangle_fixture();
    CHECK(fixture.load().meshes[0].materials.empty());
    fixture.root["materials"] = json::array({json::object()});
    fixture.root["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = fixture.load();
    CHECK(scene.meshes[0].materials == std::vector<std::uint32_t>{0});
    const Material& material = scene.materials.at(0);
    CHECK(material.base_color == glm::vec4(1.0f));
    CHECK(material.metallic == 1.0f);
    CHECK(material.roughness == 1.0f);
    CHECK(material.specular == 1.0f);
    CHECK(material.emission == glm::vec3(0.0f));
    CHECK(material.alpha_mode == AlphaMode::opaque);
    CHECK_FALSE((material.double_sided || material.unlit || material.base_color_texture.used()));
    fixture.root["meshes"][0]["primitives"][0]["material"] = 1;
    CHECK(fixture.fault() == "meshes[0].primitives[0].material");
}

TEST_CASE("gltf_materials: every member of a material and its extensions is read") {
    GltfFixture fixture = textured_fixture();
    fixture.root["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}};
    fixture.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9987}}};
    fixture.root["materials"][0] = json::parse(R"({
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6,
            "baseColorTexture": {"index": 1, "extensions": {"KHR_texture_transform":
                {"offset": [0.5, 0.25], "rotation": 1.5707963267948966, "scale": [2, 3], "texCoord": 1}}},
            "metallicRoughnessTexture": {"index": 0}},
        "normalTexture": {"index": 1, "texCoord": 1, "scale": 0.7},
        "occlusionTexture": {"index": 0, "strength": 0.8},
        "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 0.5, 0.25],
        "alphaMode": "MASK", "alphaCutoff": 0.9, "doubleSided": true,
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8},
            "KHR_materials_specular": {"specularFactor": 0.3}, "KHR_materials_unlit": {}}})");
    const Scene scene = fixture.load();
    CHECK(scene.warnings.empty());
    const Material& m = scene.materials.at(0);
    CHECK(m.base_color == glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    CHECK(m.metallic == 0.5f);
    CHECK(m.roughness == 0.6f);
    CHECK(m.specular == 0.3f);
    CHECK(m.emission == glm::vec3(8, 4, 2));
    CHECK(m.normal_scale == 0.7f);
    CHECK(m.occlusion_strength == 0.8f);
    CHECK(m.alpha_mode == AlphaMode::mask);
    CHECK(m.alpha_cutoff == 0.9f);
    CHECK((m.double_sided && m.unlit));
    CHECK(m.base_color_texture.texture == 1);
    CHECK(m.base_color_texture.uv_set == 1);
    CHECK(m.metallic_roughness_texture.texture == 0);
    CHECK(m.normal_texture.uv_set == 1);
    CHECK(m.emission_texture.texture == 0);
    // Scaled, turned by a quarter with v growing downwards: u' = 3 v + 0.5, v' = -2 u + 0.25.
    const glm::vec3 uv = m.base_color_texture.transform * glm::vec3(1, 1, 1);
    CHECK(glm::length(uv - glm::vec3(3.5f, -1.75f, 1)) < 1e-6f);
    REQUIRE(scene.textures.size() == 2);
    CHECK(scene.textures[0].wrap_u == Wrap::clamp);
    CHECK(scene.textures[0].wrap_v == Wrap::mirror);
    CHECK(scene.textures[0].nearest);
    CHECK(scene.textures[1].wrap_u == Wrap::repeat);
    CHECK(scene.images.at(0).bytes == small_png());
    CHECK(scene.images[0].name == "small");
}

TEST_CASE("gltf_materials: numbers out of range take the nearest in it, with a warning") {
    GltfFixture fixture = textured_fixture();
    fixture.root["materials"][0] = json::parse(R"({
        "pbrMetallicRoughness": {"baseColorFactor": [2, -1, 0.5, 1e300], "metallicFactor": -0.1, "roughnessFactor": 7},
        "emissiveFactor": [1, 1, 1], "alphaCutoff": -1, "occlusionTexture": {"index": 0, "strength": 3},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1e300}}})");
    const Scene scene = fixture.load();
    const Material& m = scene.materials.at(0);
    CHECK(m.base_color == glm::vec4(1, 0, 0.5f, 1));
    CHECK(m.metallic == 0.0f);
    CHECK(m.roughness == 1.0f);
    CHECK(m.emission == glm::vec3(largest_radiance));
    CHECK(m.alpha_cutoff == 0.0f);
    CHECK(m.occlusion_strength == 1.0f);
    CHECK(scene.warnings.size() == 8);
    CHECK(warns(scene, "materials[0].pbrMetallicRoughness.roughnessFactor: is out of range; taken as 1"));
}

TEST_CASE("gltf_materials: a picture that is missing, unreadable or of another format is left out by name, with what "
          "shows it") {
    const auto check = [](const json& image, const std::string& reason) {
        CAPTURE(image.dump());
        GltfFixture fixture = textured_fixture();
        fixture.root["images"].insert(fixture.root["images"].begin(), image);
        fixture.root["textures"] = {{{"source", 0}}, {{"source", 1}}};
        fixture.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
        const Scene scene = fixture.load();
        CHECK(warns(scene, reason));
        CHECK(warns(scene, "images[0]"));
        CHECK(scene.warnings.size() == 1);
        REQUIRE(scene.images.size() == 1);
        REQUIRE(scene.textures.size() == 1);
        CHECK_FALSE(scene.materials[0].base_color_texture.used());
        CHECK(scene.materials[0].emission_texture.texture == 0); // that of the other picture
    };
    check({{"uri", "missing.png"}}, "no folder");
    check({{"uri", "data:image/png;base64,AAAA"}}, "neither PNG nor JPEG");
    check({{"uri", "data:image/png,plain"}}, "neither PNG nor JPEG");
    check({{"uri", "data:image/png;base64,AA*A"}}, "not base64");
    check({{"uri", "http://example.com/a.png"}}, "neither a data URI nor a relative path");
    check({{"bufferView", 99}}, "does not exist");
    check(json::object(), "neither a uri nor a bufferView");

    GltfFixture fixture = textured_fixture();
    fixture.root["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    CHECK(warns(fixture.load(), "textures[0]: has no image"));
    fixture = textured_fixture();
    fixture.root["textures"][0]["source"] = 1;
    CHECK(fixture.fault() == "textures[0].source");
    fixture = textured_fixture();
    fixture.root["textures"][0]["sampler"] = 0;
    CHECK(fixture.fault() == "textures[0].sampler");
    fixture = textured_fixture();
    fixture.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
    CHECK(fixture.fault() == "materials[0].pbrMetallicRoughness.baseColorTexture.index");
    fixture = textured_fixture();
    fixture.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2;
    CHECK(warns(fixture.load(), "TEXCOORD_2"));
}

TEST_CASE("gltf_materials: elements that name the same bytes share one image") {
    GltfFixture fixture = textured_fixture();
    const json image = fixture.root["images"][0];
    for (int i = 0; i < 99; ++i) {
        fixture.root["images"].push_back(image);
        fixture.root["textures"].push_back({{"source", i + 1}});
    }
    fixture.root["materials"][0]["normalTexture"] = {{"index", 99}};
    const Scene scene = fixture.load();
    CHECK(scene.images.size() == 1);
    REQUIRE(scene.textures.size() == 100);
    CHECK(scene.textures[99].image == 0);
    CHECK(scene.materials[0].normal_texture.texture == 99);
}

TEST_CASE("gltf_materials: a required extension of materials that is not read is named") {
    GltfFixture fixture = textured_fixture();
    fixture.root["extensionsRequired"] = {"KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness"};
    fixture.root["materials"][0]["extensions"] = {{"KHR_materials_unlit", json::object()},
                                                  {"KHR_materials_pbrSpecularGlossiness", json::object()}};
    const Scene scene = fixture.load();
    CHECK(scene.materials[0].unlit);
    REQUIRE(scene.warnings.size() == 1);
    CHECK(warns(scene, "extensionsRequired[1]: KHR_materials_pbrSpecularGlossiness"));
}

TEST_CASE("gltf_materials: pictures beside the scene are read, those outside its folder are not") {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "scene");
    const std::vector<std::byte> png = small_png();
    const std::string bytes(reinterpret_cast<const char*>(png.data()), png.size());
    test::write_bytes(folder.path() / "scene" / "a b.png", bytes);
    test::write_bytes(folder.path() / "outside.png", bytes);
    GltfFixture fixture = textured_fixture();
    fixture.root["images"] = {{{"uri", "a%20b.png"}}, {{"uri", "../outside.png"}}, {{"uri", "none.png"}}};
    fixture.root["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    const Scene scene = load_gltf_memory(fixture.bytes(), "test.glb", folder.path() / "scene");
    CHECK(scene.images.size() == 1);
    CHECK(scene.images.at(0).bytes == png);
    CHECK(warns(scene, "images[1].uri: leaves the folder of the scene"));
    CHECK(warns(scene, "images[2].uri: does not exist: none.png"));
}

TEST_CASE("gltf_materials: lights stand where their nodes are and shine along -z") {
    json spot = json::parse(R"({"type": "spot", "color": [1, 0.5, 0], "intensity": 20, "range": 30,
                                "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}})");
    GltfFixture fixture = lit_fixture(spot);
    json& node = fixture.root["nodes"].back();
    node["translation"] = {1, 2, 3};
    node["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}; // about x by -90 degrees: -z becomes -y
    node["scale"] = {2, 3, 4};
    const Light light = fixture.load().lights.at(0);
    CHECK(light.name == "lamp");
    CHECK(light.kind == LightKind::spot);
    CHECK(light.intensity == glm::vec3(20, 10, 0));
    CHECK(light.position == glm::vec3(1, 2, 3));
    CHECK(glm::length(light.direction - glm::vec3(0, -1, 0)) < 1e-6f);
    CHECK(light.range == 30.0f);
    CHECK(light.inner_cone == 0.25f);
    CHECK(light.outer_cone == 0.5f);

    const Light sun = lit_fixture({{"type", "directional"}}).load().lights.at(0);
    CHECK(sun.intensity == glm::vec3(1.0f));
    CHECK(sun.direction == glm::vec3(0, 0, -1));
    const Light point = lit_fixture({{"type", "point"}}).load().lights.at(0);
    CHECK(std::isinf(point.range));
    CHECK(lit_fixture({{"type", "spot"}}).load().lights.at(0).outer_cone == std::numbers::pi_v<float> / 4);
}

TEST_CASE("gltf_materials: lights that give no light are left out, and angles and ranges out of range corrected, with "
          "a warning") {
    const auto left_out = [](const json& light, const std::string& reason) {
        const Scene scene = lit_fixture(light).load();
        return scene.lights.empty() && scene.warnings.size() == 1 && warns(scene, reason);
    };
    CHECK(left_out({{"type", "point"}, {"intensity", 0}}, "lights[0]: gives no light, light left out"));
    CHECK(left_out({{"type", "point"}, {"color", {0, 0, 0}}}, "gives no light"));
    CHECK(left_out({{"type", "spot"}, {"intensity", -3}}, "negative intensity"));
    CHECK(left_out({{"type", "directional"}, {"intensity", 1e300}}, "intensity out of range"));
    CHECK(left_out({{"type", "point"}, {"intensity", 1e-300}}, "gives no light"));
    GltfFixture flat = lit_fixture({{"type", "point"}});
    flat.root["nodes"].back()["scale"] = {0, 1, 1};
    CHECK(flat.load().lights.empty());

    const Scene scene = lit_fixture({{"type", "spot"},
                                     {"range", 0},
                                     {"color", {-1, 2, 1}},
                                     {"spot", {{"innerConeAngle", 2}, {"outerConeAngle", 9}}}})
                            .load();
    REQUIRE(scene.lights.size() == 1); // and valid, or load() has thrown
    CHECK(scene.lights[0].outer_cone == std::numbers::pi_v<float> / 2);
    CHECK(scene.lights[0].inner_cone < scene.lights[0].outer_cone);
    CHECK(scene.lights[0].intensity == glm::vec3(0, 2, 1));
    CHECK(std::isinf(scene.lights[0].range));
    CHECK(scene.warnings.size() == 4);
    for (const double angle : {0.0, -1.0, 1e-300}) {
        const Scene thin = lit_fixture({{"type", "spot"}, {"spot", {{"outerConeAngle", angle}}}}).load();
        CHECK(thin.lights.size() == 1);
    }
    GltfFixture fixture = lit_fixture({{"type", "point"}});
    fixture.root["nodes"].back()["extensions"]["KHR_lights_punctual"]["light"] = 1;
    CHECK(fixture.fault().ends_with(".extensions.KHR_lights_punctual.light"));
    CHECK(left_out({{"type", "laser"}}, "lights[0].type: is \"laser\", which glTF does not know; light left out"));
}

TEST_CASE("gltf_materials: attributes of every accessor type are read, normalised and cleaned") {
    GltfFixture fixture = test::triangle_fixture();
    json& attributes = fixture.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] =
        fixture.accessor(fixture.view(std::vector<float>{0, 0, 2, 0, 0, 0, not_a_number, 0, 1}), 5126, 3, "VEC3");
    attributes["TANGENT"] = fixture.accessor(
        fixture.view(std::vector<float>{3, 0, 0, -0.5f, 0, 0, 0, 1, 1, not_a_number, 0, 1}), 5126, 3, "VEC4");
    attributes["TEXCOORD_0"] =
        fixture.accessor(fixture.view(std::vector<float>{0.5f, 2, not_a_number, 0, 1e30f, 0}), 5126, 3, "VEC2");
    attributes["TEXCOORD_1"] =
        fixture.accessor(fixture.view(std::vector<std::uint16_t>{0, 65535, 13107, 0, 0, 0}), 5123, 3, "VEC2");
    fixture.root["accessors"].back()["normalized"] = true;
    attributes["COLOR_0"] = fixture.accessor(
        fixture.view(std::vector<std::uint8_t>{255, 0, 51, 0, 0, 0, 0, 0, 0, 255, 0, 0}, 4), 5121, 3, "VEC3");
    fixture.root["accessors"].back()["normalized"] = true;
    const Scene scene = fixture.load();
    const Mesh& mesh = scene.meshes.at(0);
    CHECK(mesh.normals == std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}});
    CHECK(mesh.tangents == std::vector<glm::vec4>{{1, 0, 0, -1}, {0, 0, 0, 0}, {0, 0, 0, 0}});
    CHECK(mesh.uvs[0] == std::vector<glm::vec2>{{0.5f, 2}, {0, 0}, {0, 0}});
    CHECK(mesh.uvs[1] == std::vector<glm::vec2>{{0, 1}, {0.2f, 0}, {0, 0}});
    CHECK(mesh.colors == std::vector<glm::vec4>{{1, 0, 0.2f, 1}, {0, 0, 0, 1}, {0, 1, 0, 1}});
    CHECK(warns(scene, "attributes.NORMAL: values not finite or out of range: 1"));
    CHECK(warns(scene, "attributes.NORMAL: normals of length zero: 1"));
    CHECK(warns(scene, "attributes.TANGENT: values not finite or out of range: 1"));
    CHECK(warns(scene, "attributes.TEXCOORD_0: values not finite or out of range: 2; taken as 0"));
    CHECK(scene.warnings.size() == 4);

    attributes["NORMAL"] = fixture.accessor(fixture.view(std::vector<float>{0, 0, 1}), 5126, 1, "VEC3");
    CHECK(fixture.fault() == "meshes[0].primitives[0].attributes.NORMAL");
}

TEST_CASE("gltf_materials: primitives that share positions but not attributes or materials keep their own") {
    GltfFixture fixture;
    const std::size_t p = fixture.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const std::size_t up =
        fixture.accessor(fixture.view(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, 3, "VEC3");
    const std::size_t down =
        fixture.accessor(fixture.view(std::vector<float>{0, 0, -1, 0, 0, -1, 0, 0, -1}), 5126, 3, "VEC3");
    const std::size_t uv = fixture.accessor(fixture.view(std::vector<float>{0, 0, 1, 0, 0, 1}), 5126, 3, "VEC2");
    const std::size_t i = fixture.indices({0, 1, 2});
    fixture.show({{"attributes", {{"POSITION", p}, {"NORMAL", up}}}, {"indices", i}});
    json& primitives = fixture.root["meshes"][0]["primitives"];
    primitives.push_back({{"attributes", {{"POSITION", p}, {"NORMAL", down}}}, {"indices", i}, {"material", 1}});
    primitives.push_back({{"attributes", {{"POSITION", p}, {"NORMAL", up}}}, {"indices", i}, {"material", 0}});
    primitives.push_back({{"attributes", {{"POSITION", p}, {"TEXCOORD_0", uv}}}, {"indices", i}});
    fixture.root["materials"] = json::array({json::object(), json::object()});
    const Mesh mesh = fixture.load().meshes.at(0);
    REQUIRE(mesh.positions.size() == 9); // the first and the third share theirs
    CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}, {0, 1, 2}, {6, 7, 8}});
    CHECK(mesh.materials == std::vector<std::uint32_t>{BOXWOOD_NONE, 1, 0, BOXWOOD_NONE});
    REQUIRE(mesh.normals.size() == 9);
    CHECK(mesh.normals[0].z == 1.0f);
    CHECK(mesh.normals[3].z == -1.0f);
    CHECK(mesh.normals[6] == glm::vec3(0.0f));
    REQUIRE(mesh.uvs[0].size() == 9);
    CHECK(mesh.uvs[0][1] == glm::vec2(0.0f));
    CHECK(mesh.uvs[0][7] == glm::vec2(1, 0));
}

TEST_CASE("gltf_materials: triangles that are dropped take their materials and attributes along") {
    GltfFixture fixture;
    const std::size_t p = fixture.positions({0, 0, 0, not_a_number, 0, 0, 1, 0, 0, 0, 1, 0});
    const std::size_t uv = fixture.accessor(fixture.view(std::vector<float>{0, 0, 1, 1, 2, 2, 3, 3}), 5126, 4, "VEC2");
    const json attributes = {{"POSITION", p}, {"TEXCOORD_0", uv}};
    fixture.show({{"attributes", attributes}, {"indices", fixture.indices({0, 1, 2})}, {"material", 0}});
    fixture.root["meshes"][0]["primitives"].push_back(
        {{"attributes", attributes}, {"indices", fixture.indices({0, 2, 3})}, {"material", 1}});
    fixture.root["materials"] = json::array({json::object(), json::object()});
    const Scene scene = fixture.load();
    CHECK(scene.counts.dropped_triangles == 1);
    CHECK(scene.meshes.at(0).materials == std::vector<std::uint32_t>{1});
    CHECK(scene.meshes[0].uvs[0] == std::vector<glm::vec2>{{0, 0}, {2, 2}, {3, 3}});
}

TEST_SUITE_END();
