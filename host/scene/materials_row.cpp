// SPDX-License-Identifier: MIT
// What materials look like: a row of plastics and a row of metals, from polished on the left to matt on the right.
#include <algorithm>
#include <string>

#include "scene/picture.hpp"
#include "scene/procedural_kinds.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

constexpr std::uint32_t columns = 6;
constexpr float radius = 0.4375f;

Mesh make_quad(const char* name, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    return {name, {corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Two by two squares with a dark line around each, so that there is detail of two sizes.
EncodedImage chequer() {
    constexpr std::uint32_t side = 64, line = 2;
    std::vector<std::uint8_t> rgb;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t cell = side / 2, in_x = x % cell, in_y = y % cell;
            const bool edge = in_x < line || in_y < line || in_x >= cell - line || in_y >= cell - line;
            const bool light = (x / cell + y / cell) % 2 == 0;
            const std::uint8_t grey = edge ? 60 : light ? 215 : 125;
            rgb.insert(rgb.end(), {grey, grey, static_cast<std::uint8_t>(grey - grey / 8)});
        }
    }
    return {"chequer", encode_png("chequer", {side, side}, 3, rgb)};
}

void add_floor(Scene& scene) {
    Mesh floor = make_quad("floor", {-8, 0, 8}, {16, 0, 0}, {0, 0, -16});
    floor.uvs[0] = {{0, 0}, {16, 0}, {16, 16}, {0, 16}};
    paint(scene, floor, "floor", glm::vec3(1.0f));
    scene.materials.back().base_color_texture.texture = 0;
    scene.textures.push_back({0});
    scene.images.push_back(chequer());
    scene.instances.push_back({"floor", static_cast<std::uint32_t>(scene.meshes.size()), glm::mat4(1.0f)});
    scene.meshes.push_back(std::move(floor));
}

void add_sphere(Scene& scene, const Mesh& shape, bool metal, std::uint32_t column) {
    const float roughness = static_cast<float>(column) / (columns - 1);
    Mesh mesh = shape;
    mesh.name = (metal ? "metal " : "plastic ") + std::to_string(column);
    paint(scene, mesh, "", metal ? glm::vec3(0.95f, 0.78f, 0.42f) : glm::vec3(0.12f, 0.3f, 0.62f));
    Material& material = scene.materials.back();
    material.name = mesh.name;
    material.metallic = metal ? 1.0f : 0.0f;
    material.specular = 1.0f;
    material.roughness = std::max(roughness, 0.03125f);
    glm::mat4 transform(radius);
    transform[3] = {static_cast<float>(column) - 0.5f * (columns - 1), radius, metal ? -0.625f : 0.625f, 1.0f};
    scene.instances.push_back({mesh.name, static_cast<std::uint32_t>(scene.meshes.size()), transform});
    scene.meshes.push_back(std::move(mesh));
}

void add_lights(Scene& scene) {
    Mesh lamp = make_quad("lamp", {-1.5f, 3, -0.5f}, {3, 0, 0}, {0, 0, 1}); // faces down
    paint(scene, lamp, "lamp", glm::vec3(0.0f));
    scene.materials.back().emission = {9.0f, 8.5f, 8.0f};
    scene.instances.push_back({"lamp", static_cast<std::uint32_t>(scene.meshes.size()), glm::mat4(1.0f)});
    scene.meshes.push_back(std::move(lamp));
    scene.lights.push_back({"point", LightKind::point, {9, 10, 12}, {-4, 3, 4}});
}

} // namespace

Scene make_materials(const ProceduralOptions& options) {
    const std::uint64_t wanted = options.triangles != 0 ? std::max<std::uint64_t>(4, options.triangles) : 24'580;
    const Mesh shape = sphere_mesh(std::max<std::uint64_t>(1, floor_sqrt((wanted - 4) / (8 * 2 * columns))));
    Scene scene;
    add_floor(scene);
    for (const bool metal : {false, true})
        for (std::uint32_t column = 0; column < columns; ++column) add_sphere(scene, shape, metal, column);
    add_lights(scene);
    scene.cameras.push_back({"camera", look_at({0, 2.5, 6.5}, {0, 0.375, 0}), true, 0.625f});
    return scene;
}

} // namespace boxwood
