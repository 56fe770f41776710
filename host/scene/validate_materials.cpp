// SPDX-License-Identifier: MIT
#include "scene/validate_materials.hpp"

#include <cmath>
#include <numbers>

#include "boxwood/error.hpp"
#include "scene/materials_in_use.hpp"
#include "scene/picture.hpp"

namespace boxwood {

namespace {

/// Relative error of the length of a direction that counts as normalised.
constexpr float rounding = 0x1p-12f;

std::string element(const std::string& array, std::size_t index) { return array + "[" + std::to_string(index) + "]"; }

/// One element and how its members are checked; a NaN fails every test.
struct Checked {
    const std::string& file;
    std::string where;

    void require(bool right, const char* member, const char* fault) const {
        if (!right) throw InputError(file, where + "." + member, fault);
    }
    void number(float value, float low, float high, const char* member) const {
        require(value >= low && value <= high, member, "is out of range");
    }
    template <class Vector>
    void vector(const Vector& value, float low, float high, const char* member) const {
        for (int i = 0; i < Vector::length(); ++i) number(value[i], low, high, member);
    }
};

bool unit(const glm::vec3& v) { return std::abs(glm::dot(v, v) - 1.0f) <= rounding; }

void validate_use(const Scene& scene, const TextureUse& use, const Checked& owner, const char* member) {
    owner.require(!use.used() || use.texture < scene.textures.size(), member, "names a texture that does not exist");
    owner.require(use.uv_set < 2, member, "reads a set of texture coordinates that does not exist");
    for (int column = 0; column < 3; ++column)
        owner.vector(use.transform[column], -largest_coordinate, largest_coordinate, member);
}

void validate_material(const Scene& scene, const Material& material, const Checked& checked) {
    checked.vector(material.base_color, 0.0f, 1.0f, "base_color");
    checked.number(material.metallic, 0.0f, 1.0f, "metallic");
    checked.number(material.roughness, 0.0f, 1.0f, "roughness");
    checked.number(material.specular, 0.0f, 1.0f, "specular");
    checked.vector(material.emission, 0.0f, largest_radiance, "emission");
    checked.number(material.normal_scale, -largest_coordinate, largest_coordinate, "normal_scale");
    checked.number(material.occlusion_strength, 0.0f, 1.0f, "occlusion_strength");
    checked.number(material.alpha_cutoff, 0.0f, largest_coordinate, "alpha_cutoff");
    static constexpr const char* members[] = {"base_color_texture", "metallic_roughness_texture", "normal_texture",
                                              "occlusion_texture", "emission_texture"};
    const auto uses = texture_uses(material);
    for (std::size_t i = 0; i < uses.size(); ++i) validate_use(scene, *uses[i], checked, members[i]);
}

void validate_light(const Light& light, const Checked& checked) {
    checked.vector(light.intensity, 0.0f, largest_radiance, "intensity");
    checked.require(light.intensity != glm::vec3(0.0f), "intensity", "is zero");
    checked.vector(light.position, -largest_coordinate, largest_coordinate, "position");
    checked.require(light.range > 0.0f, "range", "is not positive");
    checked.require(unit(light.direction), "direction", "is not normalised");
    checked.number(light.outer_cone, smallest_cone, std::numbers::pi_v<float> / 2.0f, "outer_cone");
    checked.require(light.inner_cone >= 0.0f && light.inner_cone < light.outer_cone, "inner_cone",
                    "is not between 0 and outer_cone");
}

/// Calls right(element) for each.
template <class T, class Right>
void validate_attribute(const Mesh& mesh, const std::vector<T>& values, const Checked& checked, const char* member,
                        const char* fault, Right right) {
    if (values.empty()) return;
    checked.require(values.size() == mesh.positions.size(), member, "has not one element per vertex");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!right(values[i])) throw InputError(checked.file, element(checked.where + "." + member, i), fault);
}

} // namespace

void validate_materials(const Scene& scene, const std::string& file) {
    for (std::size_t i = 0; i < scene.images.size(); ++i)
        Checked{file, element("images", i)}.require(picture_format(scene.images[i].bytes).has_value(), "bytes",
                                                    "are neither PNG nor JPEG");
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        Checked{file, element("textures", i)}.require(scene.textures[i].image < scene.images.size(), "image",
                                                      "names an image that does not exist");
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        validate_material(scene, scene.materials[i], {file, element("materials", i)});
    for (std::size_t i = 0; i < scene.lights.size(); ++i) validate_light(scene.lights[i], {file, element("lights", i)});
}

void validate_materials(const Scene& scene, const Mesh& mesh, const std::string& file, const std::string& where) {
    const Checked checked{file, where};
    if (!mesh.materials.empty()) {
        checked.require(mesh.materials.size() == mesh.triangles.size(), "materials",
                        "has not one element per triangle");
        for (std::size_t i = 0; i < mesh.materials.size(); ++i)
            if (mesh.materials[i] != BOXWOOD_NONE && mesh.materials[i] >= scene.materials.size())
                throw InputError(file, element(where + ".materials", i), "names a material that does not exist");
    }
    const char* direction = "is neither normalised nor zero";
    validate_attribute(mesh, mesh.normals, checked, "normals", direction,
                       [](const glm::vec3& n) { return unit(n) || n == glm::vec3(0.0f); });
    validate_attribute(mesh, mesh.tangents, checked, "tangents", direction, [](const glm::vec4& t) {
        const glm::vec3 v(t);
        return (unit(v) || v == glm::vec3(0.0f)) && (t == glm::vec4(0.0f) || std::abs(t.w) == 1.0f);
    });
    for (const std::vector<glm::vec2>& uvs : mesh.uvs)
        validate_attribute(mesh, uvs, checked, "uvs", "is not finite or out of range", [](const glm::vec2& uv) {
            return std::abs(uv.x) <= largest_coordinate && std::abs(uv.y) <= largest_coordinate;
        });
    validate_attribute(mesh, mesh.colors, checked, "colors", "is not finite", [](const glm::vec4& c) {
        return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w);
    });
}

} // namespace boxwood
