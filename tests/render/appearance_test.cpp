// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/appearance.hpp"
#include "boxwood/error.hpp"
#include "boxwood/geometry.hpp"
#include "io/picture.hpp"
#include "render/appearance_attributes.hpp"
#include "render/texture_levels.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// The unit square in the plane z = 0, facing +z, with uv = (x, y).
Mesh square() {
    Mesh mesh{"square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return mesh;
}

Scene one_square(const Material& material) {
    Scene scene;
    scene.meshes.push_back(square());
    scene.meshes[0].materials = {0, 0};
    scene.materials.push_back(material);
    scene.instances.push_back({"square", 0, glm::mat4(1.0f)});
    return scene;
}

EncodedImage image(const std::string& name, PictureSize size, const std::vector<std::uint8_t>& rgba) {
    return {name, encode_png(name, size, 4, rgba)};
}

std::vector<std::uint8_t> noise(PictureSize size, std::uint64_t salt) {
    Random random(salt);
    std::vector<std::uint8_t> rgba(4 * size.width * size.height);
    for (std::uint8_t& byte : rgba) byte = static_cast<std::uint8_t>(random.below(256));
    return rgba;
}

Appearance appearance_of(const Scene& scene, std::vector<std::string>& warnings) {
    return upload_appearance(test_device(), scene, shading_requirements(scene), warnings);
}

/// Of a scene that gives no warning.
Appearance appearance_of(const Scene& scene) {
    std::vector<std::string> warnings;
    Appearance appearance = appearance_of(scene, warnings);
    CHECK(warnings.empty());
    return appearance;
}

double srgb_to_linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
double linear_to_srgb(double l) { return l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055; }

} // namespace

TEST_CASE("shading requires what materials and meshes in use ask for, and nothing else") {
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
    CHECK((needs.materials && needs.normals && needs.tangents && needs.colors && needs.textures));
    CHECK((needs.alpha && needs.specular && needs.emission && !needs.punctual));
    CHECK(needs.uv_sets == 2);
    CHECK(needs.attribute_floats() == 15);
    scene.lights.push_back({});
    CHECK(shading_requirements(scene).punctual);
}

TEST_CASE("every required word has its reason, which names the element that asks first") {
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
    CHECK(because("materials") == "materials[0] \"lamp\" and the plain material are in use");
    CHECK(because("second-texture-coordinates") == "materials[0] \"lamp\" has a texture of its normal");
    CHECK(because("colors") == "meshes[0] \"square\" has colours");
    CHECK(because("emission") == "materials[0] \"lamp\" emits light");
    CHECK(because("punctual-lights") == "lights[0] \"sun\" is one");
    CHECK(because("alpha") == "nothing");
}

TEST_CASE("attributes are interleaved, with zeros and white where a mesh lacks them") {
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

TEST_CASE("of one material in use there is one record and no list, and an empty scene has nothing") {
    Scene scene = one_square(plain_material());
    scene.materials.insert(scene.materials.begin(), Material{});
    scene.meshes[0].materials = {1, 1};
    const Appearance appearance = appearance_of(scene);
    CHECK(appearance.triangle_materials.size() == 0);
    CHECK(appearance.attributes.size() == 0);
    CHECK(appearance.lights.size() == 0);
    CHECK(appearance.light_distribution.size() == 0);
    const auto materials = download(test_device(), appearance.materials);
    REQUIRE(materials.size() == 1);
    CHECK(materials[0].base_color[0] == 0.8f);
    CHECK(appearance_of(Scene{}).materials.size() == 1);
}

TEST_CASE("made tangents follow growing u, whatever the size, and v's side decides their sign") {
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
            CHECK(t.w == 1.0f);
        }
        for (glm::vec2& uv : mesh.uvs[0]) uv.y = -uv.y;
        for (const glm::vec4& t : make_tangents(scene, mesh)) {
            CHECK(glm::length(glm::vec3(t) - glm::vec3(along, 0)) < 1e-6f);
            CHECK(t.w == -1.0f);
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

TEST_CASE("tangents of a mesh stay, and are made where they are zero") {
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
    CHECK(tangent(1) == glm::vec4(1, 0, 0, 1));
    CHECK(tangent(2) == glm::vec4(1, 0, 0, 1));
    CHECK(tangent(3) == glm::vec4(0, 0, 1, 1));
}

TEST_CASE("the texture's transform turns made tangents") {
    Material material;
    material.normal_texture.texture = 0;
    // u' = v, v' = -u: u' grows along y.
    material.normal_texture.transform = glm::mat3(0, -1, 0, 1, 0, 0, 0, 0, 1);
    const Scene scene = one_square(material);
    for (const glm::vec4& t : make_tangents(scene, scene.meshes[0])) CHECK(t == glm::vec4(0, 1, 0, 1));
}

TEST_CASE("emitting triangles are lights in world space, of instances that mirror and stretch, too") {
    Material lamp = plain_material();
    lamp.emission = {1, 2, 6};
    Scene scene = one_square(lamp);
    glm::mat4 placed = glm::translate(glm::mat4(1.0f), glm::vec3(5, 6, 7));
    placed = glm::rotate(placed, 0.7f, glm::vec3(1, 2, 3));
    placed = glm::scale(placed, glm::vec3(-2, 3, 0.5f));
    placed = glm::rotate(placed, 1.1f, glm::vec3(0, 1, 1));
    scene.instances.push_back({"mirrored", 0, placed});
    scene.lights.push_back({"lamp", LightKind::point, {3, 3, 3}, {1, 2, 3}});

    const Appearance appearance = appearance_of(scene);
    const auto lights = download(test_device(), appearance.lights);
    REQUIRE(lights.size() == 5);
    CHECK(lights[0].kind == BOXWOOD_POINT_LIGHT);
    std::vector<double> powers = {4 * std::numbers::pi * 3};
    for (std::uint32_t i = 1; i < 5; ++i) {
        const LightRecord& light = lights[i];
        CHECK(light.kind == BOXWOOD_TRIANGLE_LIGHT);
        CHECK(light.instance == (i - 1) / 2);
        CHECK(light.primitive == (i - 1) % 2);
        CHECK(light.intensity[2] == 6.0f);
        CHECK(light.two_sided == 0);
        // Heron's formula on the vertices in world space, and a point in front of the square in object space.
        const glm::dmat4 to_world(scene.instances[light.instance].transform);
        const glm::uvec3 t = scene.meshes[0].triangles[light.primitive];
        glm::dvec3 v[3];
        for (int k = 0; k < 3; ++k)
            v[k] = glm::dvec3(to_world * glm::dvec4(glm::dvec3(scene.meshes[0].positions[t[k]]), 1));
        const double a = glm::distance(v[0], v[1]), b = glm::distance(v[1], v[2]), c = glm::distance(v[2], v[0]);
        const double s = 0.5 * (a + b + c), area = std::sqrt(s * (s - a) * (s - b) * (s - c));
        CHECK(light.area == doctest::Approx(area).epsilon(1e-6));
        const glm::dvec3 normal(light.direction[0], light.direction[1], light.direction[2]);
        CHECK(glm::length(normal) == doctest::Approx(1.0).epsilon(1e-6));
        CHECK(std::abs(glm::dot(normal, v[1] - v[0])) < 1e-6 * a);
        CHECK(std::abs(glm::dot(normal, v[2] - v[0])) < 1e-6 * c);
        const glm::dvec3 front(to_world * glm::dvec4(0, 0, 1, 0));
        CHECK(glm::dot(normal, front) > 0);
        for (int k = 0; k < 2; ++k)
            for (int axis = 0; axis < 3; ++axis)
                CHECK(light.edges[k][axis] == doctest::Approx(v[k + 1][axis] - v[0][axis]).epsilon(1e-5));
        powers.push_back(std::numbers::pi * 3 * area);
    }
    const auto distribution = download(test_device(), appearance.light_distribution);
    REQUIRE(distribution.size() == 6);
    CHECK(distribution.front() == 0.0f);
    CHECK(distribution.back() == 1.0f);
    double total = 0;
    for (const double power : powers) total += power;
    for (std::size_t i = 0; i < powers.size(); ++i)
        CHECK(distribution[i + 1] - distribution[i] == doctest::Approx(powers[i] / total).epsilon(1e-5));
}

TEST_CASE(
    "triangles without area or light are no lights; double-sided ones count twice; punctual ones by what they send") {
    Material lamp = plain_material();
    lamp.emission = {1, 1, 1};
    lamp.double_sided = true;
    Scene scene = one_square(lamp);
    scene.meshes[0].triangles = {{0, 1, 2}, {0, 1, 1}, {0, 2, 3}};
    scene.meshes[0].materials = {0, 0, BOXWOOD_NONE};
    Light spot{"spot", LightKind::spot, {2, 2, 2}};
    spot.inner_cone = 0.2f;
    spot.outer_cone = 0.6f;
    scene.lights = {{"sun", LightKind::directional, {1, 1, 1}}, spot};
    const Appearance appearance = appearance_of(scene);
    const auto lights = download(test_device(), appearance.lights);
    REQUIRE(lights.size() == 3);
    CHECK(lights[2].primitive == 0);
    CHECK(lights[2].two_sided == 1);
    // Full at the inner cone, none at the outer one.
    CHECK(std::cos(0.2) * lights[1].cone_scale + lights[1].cone_offset == doctest::Approx(1.0).epsilon(1e-5));
    CHECK(std::abs(std::cos(0.6) * lights[1].cone_scale + lights[1].cone_offset) < 1e-5);

    double sent = 0; // by the spot: a sum over the angle from its axis
    const int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / steps;
        const double ramp = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
        const double fade = std::clamp(ramp, 0.0, 1.0);
        sent += 2 * std::numbers::pi * std::sin(angle) * 2 * fade * fade * std::numbers::pi / steps;
    }
    const double powers[] = {std::numbers::pi * 0.5, sent, std::numbers::pi * 0.5 * 2};
    const double total = powers[0] + powers[1] + powers[2];
    const auto distribution = download(test_device(), appearance.light_distribution);
    for (int i = 0; i < 3; ++i)
        CHECK(distribution[i + 1] - distribution[i] == doctest::Approx(powers[i] / total).epsilon(1e-5));
}

TEST_CASE("levels of detail are means by area, in linear light, of pictures of any size") {
    // Powers of two, odd, one across, and one texel.
    for (const PictureSize size : {PictureSize{8, 4}, {7, 5}, {1, 6}, {13, 1}, {1, 1}, {3, 3}}) {
        const Picture picture{size, noise(size, size.width)};
        for (const bool srgb : {false, true}) {
            CAPTURE(size.width);
            CAPTURE(srgb);
            const std::vector<std::uint32_t> levels = texture_levels(picture, srgb);
            REQUIRE(levels.size() == level_texels(size));
            for (std::size_t i = 0; i < std::size_t{size.width} * size.height; ++i)
                for (std::size_t c = 0; c < 4; ++c) CHECK((levels[i] >> 8 * c & 255) == picture.rgba[4 * i + c]);
            const std::uint32_t width = std::max(1u, size.width / 2), height = std::max(1u, size.height / 2);
            if (level_count(size) == 1) continue;
            // Each texel of level 0 as width x height equal pieces: a texel of level 1 is a block of them.
            for (std::uint32_t y = 0; y < height; ++y)
                for (std::uint32_t x = 0; x < width; ++x)
                    for (std::uint32_t c = 0; c < 4; ++c) {
                        double sum = 0;
                        for (std::uint32_t v = 0; v < size.height; ++v)
                            for (std::uint32_t u = 0; u < size.width; ++u) {
                                const std::uint32_t px = (x * size.width + u) / width,
                                                    py = (y * size.height + v) / height;
                                const double code = picture.rgba[4 * (py * size.width + px) + c] / 255.0;
                                sum += srgb && c < 3 ? srgb_to_linear(code) : code;
                            }
                        sum /= size.width * size.height;
                        const double expected = 255 * (srgb && c < 3 ? linear_to_srgb(sum) : sum);
                        const std::size_t at = std::size_t{size.width} * size.height + y * width + x;
                        CHECK(std::abs((levels[at] >> 8 * c & 255) - expected) < 0.51);
                    }
        }
    }
}

TEST_CASE("a picture is stored once per encoding, a record once per texture and encoding") {
    Material material;
    material.base_color_texture.texture = 0;
    material.occlusion_texture.texture = 0;
    material.metallic_roughness_texture.texture = 1;
    material.normal_texture.texture = 1;
    material.emission_texture = {2, 1, glm::mat3(2, 0, 0, 0, 3, 0, 0.25f, 0.5f, 1)};
    material.emission = {1, 1, 1};
    Scene scene = one_square(material);
    scene.images = {image("a", {4, 4}, noise({4, 4}, 1)), image("b", {2, 1}, {255, 0, 0, 255, 0, 0, 0, 255})};
    scene.textures = {{0}, {0, Wrap::clamp, Wrap::mirror, true}, {1}};
    const Appearance appearance = appearance_of(scene);
    const auto records = download(test_device(), appearance.textures);
    REQUIRE(records.size() == 4); // 0 as colour, 0 as numbers, 1 as numbers, 2 as colour
    CHECK(appearance.texels.size() == 21 + 21 + 3);
    const auto material_records = download(test_device(), appearance.materials);
    const TextureInput* inputs = material_records[0].textures;
    const auto record = [&](int place) { return records[inputs[place].texture]; };
    CHECK(record(BOXWOOD_BASE_COLOR).srgb == 1);
    CHECK(record(BOXWOOD_OCCLUSION).srgb == 0);
    CHECK(record(BOXWOOD_OCCLUSION).first_texel == record(BOXWOOD_NORMAL).first_texel);
    CHECK(record(BOXWOOD_BASE_COLOR).first_texel != record(BOXWOOD_NORMAL).first_texel);
    CHECK(inputs[BOXWOOD_METALLIC_ROUGHNESS].texture == inputs[BOXWOOD_NORMAL].texture);
    CHECK(record(BOXWOOD_NORMAL).wrap_u == 2);
    CHECK(record(BOXWOOD_NORMAL).wrap_v == 1);
    CHECK(record(BOXWOOD_NORMAL).nearest == 1);
    CHECK(record(BOXWOOD_EMISSION).width == 2);
    CHECK(record(BOXWOOD_EMISSION).levels == 2);
    CHECK(inputs[BOXWOOD_EMISSION].uv_set == 1);
    const float rows[] = {2, 0, 0.25f, 0, 3, 0.5f};
    for (int i = 0; i < 6; ++i) CHECK(inputs[BOXWOOD_EMISSION].rows[i] == rows[i]);
    // Nothing of it without the requirement.
    ShadingRequirements needs = shading_requirements(scene);
    needs.textures = false;
    std::vector<std::string> warnings;
    const Appearance untextured = upload_appearance(test_device(), scene, needs, warnings);
    CHECK(untextured.textures.size() == 0);
    CHECK(untextured.texels.size() == 0);
    CHECK(download(test_device(), untextured.materials)[0].textures[0].texture == BOXWOOD_NONE);
}

TEST_CASE("a black emission texture makes no lights, and a partly black one weaker ones") {
    Material lamp = plain_material();
    lamp.emission = {1, 1, 1};
    lamp.emission_texture.texture = 0;
    Scene scene = one_square(lamp);
    scene.textures = {{0}};
    scene.images = {image("black", {1, 1}, {0, 0, 0, 255})};
    CHECK(appearance_of(scene).lights.size() == 0);
    scene.images = {image("half", {2, 1}, {0, 0, 0, 255, 255, 255, 255, 255})};
    scene.lights.push_back({"point", LightKind::point, glm::vec3(0.125f)});
    const Appearance appearance = appearance_of(scene);
    REQUIRE(appearance.lights.size() == 3);
    // pi * 1/2 * 1/2 for each triangle, 4 pi / 8 for the point.
    const auto distribution = download(test_device(), appearance.light_distribution);
    CHECK(distribution[1] == doctest::Approx(0.5));
    CHECK(distribution[2] == doctest::Approx(0.75));
}

TEST_CASE("pictures that cannot be read are grey, or flat, and named") {
    Material material;
    material.base_color_texture.texture = 0;
    material.normal_texture.texture = 0;
    Scene scene = one_square(material);
    scene.textures = {{0}};
    const EncodedImage good = image("good", {8, 8}, noise({8, 8}, 3));
    EncodedImage truncated = good, huge = good, gif = good;
    truncated.bytes.resize(truncated.bytes.size() / 2);
    for (const std::size_t at : {16, 20}) { // width and height in the header: 65536 x 65536
        huge.bytes[at + 1] = std::byte{1};
        huge.bytes[at + 3] = std::byte{0};
    }
    gif.bytes[0] = std::byte{'G'};
    for (const EncodedImage& bad : {truncated, huge, gif, EncodedImage{"none", {}}}) {
        scene.images = {bad};
        std::vector<std::string> warnings;
        const Appearance appearance = appearance_of(scene, warnings);
        CHECK(warnings.size() >= 1);
        for (const std::string& warning : warnings) CHECK(warning.find(bad.name) != std::string::npos);
        const auto records = download(test_device(), appearance.textures);
        REQUIRE(records.size() == 2);
        CHECK(records[0].width == 1);
        CHECK(records[0].height == 1);
        CHECK(records[0].levels == 1);
        CHECK(download(test_device(), appearance.texels)[records[0].first_texel] == 0xff808080u);
        const MaterialRecord record = download(test_device(), appearance.materials)[0];
        CHECK(record.textures[BOXWOOD_BASE_COLOR].texture == 0);
        CHECK(record.textures[BOXWOOD_NORMAL].texture == BOXWOOD_NONE);
    }
}

TEST_SUITE_END();
