// SPDX-License-Identifier: MIT
#include "io/gltf_extensions.hpp"

#include <doctest/doctest.h>

#include "io/gltf_fixture.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

using Lines = std::vector<std::string>;

json draco_of(std::size_t view) { return {{draco, {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}; }

} // namespace

TEST_CASE("gltf_extensions: each extension that is used and not read is named once, with what stands in for it") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["extensionsUsed"] = {"KHR_materials_clearcoat",
                                      "KHR_materials_unlit",
                                      "KHR_materials_clearcoat",
                                      "EXT_meshopt_compression",
                                      "KHR_lights_punctual",
                                      "ACME_new",
                                      7,
                                      "KHR_mesh_quantization"};
    fixture.root["extensionsRequired"] = {"KHR_materials_clearcoat", "KHR_materials_volume"};
    CHECK(fixture.load().warnings ==
          Lines{"extensionsUsed[0]: KHR_materials_clearcoat is not read; surfaces have no coat",
                "extensionsUsed[3]: EXT_meshopt_compression is not read; the uncompressed data beside it is",
                "extensionsUsed[5]: ACME_new is not read; what is there without it is",
                "extensionsRequired[1]: KHR_materials_volume is not read; surfaces let no light through"});
    fixture.root["extensionsUsed"] = "KHR_materials_sheen"; // not even a list, and not needed
    fixture.root.erase("extensionsRequired");
    CHECK(fixture.load().warnings.empty());
}

TEST_CASE("gltf_extensions: a primitive of Draco alone is left out by name, one with uncompressed data is read") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["extensionsUsed"] = {draco};
    json& primitive = fixture.root["meshes"][0]["primitives"][0];
    primitive["extensions"] = draco_of(0);
    Scene scene = fixture.load();
    CHECK(scene.triangle_count() == 1);
    CHECK(scene.warnings.size() == 1);

    // Accessors that only tell what the compressed data hold: as zeros they would be triangles that nobody sees.
    const GltfFixture whole = fixture;
    for (const char* missing : {"positions", "indices", "both", "positions, no indices"}) {
        CAPTURE(missing);
        fixture = whole;
        const std::string parts = missing;
        if (parts != "indices") fixture.root["accessors"][0].erase("bufferView");
        if (parts == "indices" || parts == "both") fixture.root["accessors"][1].erase("bufferView");
        if (parts == "positions, no indices") fixture.root["meshes"][0]["primitives"][0].erase("indices");
        scene = fixture.load();
        CHECK(scene.meshes.empty());
        REQUIRE(scene.warnings.size() == 2);
        CHECK(scene.warnings[0].starts_with("extensionsUsed[0]: KHR_draco_mesh_compression is not read"));
        CHECK(scene.warnings[1] ==
              "meshes[0].primitives[0]: has no data but what KHR_draco_mesh_compression holds, left out");
    }
}

TEST_CASE(
    "gltf_extensions: a buffer that only compressed data could fill is refused with the name of their extension") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["extensionsUsed"] = {"EXT_meshopt_compression"};
    fixture.root["buffers"] = {{{"byteLength", fixture.binary.size()}}, {{"byteLength", 36}}};
    fixture.root["bufferViews"][0] = {
        {"buffer", 1},
        {"byteLength", 36},
        {"extensions", {{"EXT_meshopt_compression", {{"buffer", 0}, {"byteLength", 20}, {"mode", "ATTRIBUTES"}}}}}};
    CHECK_THROWS_WITH_AS(fixture.load(), doctest::Contains("EXT_meshopt_compression is not read"), InputError);
}

TEST_CASE("gltf_extensions: of specular-glossiness the diffuse part is the base colour where nothing else is") {
    GltfFixture fixture = test::triangle_fixture();
    fixture.root["extensionsUsed"] = {specular_glossiness};
    fixture.root["textures"] = json::array({{{"source", 0}}});
    fixture.root["images"] = {
        {{"uri", "data:image/png;base64,iVBORw0KGgo="}}}; // a signature, which is all that is read here
    fixture.root["materials"] = {
        {{"extensions",
          {{specular_glossiness,
            {{"diffuseFactor", {0.8, 0.1, 0.2, 0.5}},
             {"diffuseTexture",
              {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.25, 0.5}}}}}}}},
             {"glossinessFactor", 0.9}}}}}}};
    const Scene scene = fixture.load();
    const Material& material = scene.materials.at(0);
    CHECK(material.base_color == glm::vec4(0.8f, 0.1f, 0.2f, 0.5f));
    CHECK(material.base_color_texture.texture == 0);
    CHECK(material.base_color_texture.uv_set == 1);
    CHECK(material.base_color_texture.transform[2] == glm::vec3(0.25f, 0.5f, 1.0f));
    CHECK(material.metallic == 0.0f);
    CHECK(material.roughness == 1.0f);
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0].starts_with("extensionsUsed[0]: KHR_materials_pbrSpecularGlossiness is not read; "));

    fixture.root["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 0.5}};
    const Material other = fixture.load().materials.at(0);
    CHECK(other.base_color == glm::vec4(1.0f));
    CHECK(other.metallic == 0.5f);
    fixture.root["materials"][0]["extensions"][specular_glossiness]["diffuseFactor"] = "red";
    CHECK(fixture.fault() == "materials[0].extensions.KHR_materials_pbrSpecularGlossiness.diffuseFactor");
}

TEST_SUITE_END();
