// SPDX-License-Identifier: MIT
#include "io/gltf_lights.hpp"

#include <cmath>
#include <numbers>

#include "common/excerpt.hpp"
#include "io/gltf_numbers.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

using nlohmann::json;

constexpr const char* extension = "KHR_lights_punctual";

/// Colour times intensity; none, with a warning, when that is no light.
std::optional<glm::vec3> load_intensity(const json& from, const std::string& where, Warnings& warnings) {
    const glm::vec3 color = vector_at(from, "color", glm::vec3(1.0f), {0.0f, largest_radiance}, where, warnings);
    const double intensity = from.value("intensity", 1.0);
    const glm::dvec3 product = glm::dvec3(color) * intensity;
    const double most = std::max({product.x, product.y, product.z});
    const char* fault = !(intensity >= 0.0)                  ? "has a negative intensity"
                        : !(static_cast<float>(most) > 0.0f) ? "gives no light"
                        : most > double{largest_radiance}    ? "has an intensity out of range"
                                                             : nullptr;
    if (fault == nullptr) return glm::vec3(product);
    warnings.add(where, std::string(fault) + ", light left out");
    return std::nullopt;
}

void load_cone(const json& from, const std::string& where, Light& light, Warnings& warnings) {
    const json& spot = object_at(from, "spot");
    constexpr float half_pi = std::numbers::pi_v<float> / 2.0f;
    const std::string inside = where + ".spot";
    light.outer_cone = number_at(spot, "outerConeAngle", light.outer_cone, {smallest_cone, half_pi}, inside, warnings);
    light.inner_cone = number_at(spot, "innerConeAngle", 0.0f, {0.0f, half_pi}, inside, warnings);
    if (light.inner_cone < light.outer_cone) return;
    // glTF allows neither, and equal angles have no place to fade in.
    if (light.inner_cone > light.outer_cone)
        warnings.add(inside + ".innerConeAngle", "is larger than outerConeAngle; taken as that");
    light.inner_cone = std::nextafter(light.outer_cone, 0.0f);
}

/// Normalised; what is so already, but for rounding, passes unchanged.
glm::vec3 direction_of(const glm::dvec3& v) {
    return std::abs(glm::dot(v, v) - 1.0) < 0x1p-20 ? glm::vec3(v) : glm::vec3(glm::normalize(v));
}

} // namespace

std::optional<Light> load_light(const GltfDocument& document, const PlacedNode& placed, Warnings& warnings) {
    const tinygltf::Node& node = document.model.nodes[placed.node];
    const auto found = node.extensions.find(extension);
    if (found == node.extensions.end() || !found->second.Has("light")) return std::nullopt;
    const std::string node_name = element("nodes", placed.node);
    const int index = found->second.Get("light").GetNumberAsInt();
    const json& lights = document.appearance["lights"];
    if (!GltfDocument::has(index, lights.size()))
        document.fail(node_name + ".extensions." + extension + ".light", "names a light that does not exist");
    const json& from = lights[static_cast<std::size_t>(index)];
    const std::string where =
        element(std::string("extensions.") + extension + ".lights", static_cast<std::size_t>(index));

    Light light;
    light.name = node.name.empty() ? from.value("name", std::string()) : node.name;
    const std::string type = from["type"].get<std::string>();
    if (type != "point" && type != "spot" && type != "directional") {
        warnings.add(where + ".type", "is \"" + excerpt(type) + "\", which glTF does not know; light left out");
        return std::nullopt;
    }
    light.kind = type == "point" ? LightKind::point : type == "spot" ? LightKind::spot : LightKind::directional;
    const auto intensity = load_intensity(from, where, warnings);
    if (!intensity) return std::nullopt;
    light.intensity = *intensity;
    if (!transform_fault(glm::mat4(placed.to_world)).empty() || !in_range(glm::vec3(placed.to_world[3]))) {
        warnings.add(node_name, "the light has no usable transform, left out");
        return std::nullopt;
    }
    if (light.kind != LightKind::directional) {
        light.position = glm::vec3(placed.to_world[3]);
        if (from.contains("range")) {
            const auto range = static_cast<float>(from["range"].get<double>());
            if (range > 0.0f) light.range = range;
            if (!(range > 0.0f)) warnings.add(where + ".range", "is not positive; the light has no end");
        }
    }
    if (light.kind != LightKind::point) light.direction = direction_of(-glm::dvec3(placed.to_world[2]));
    if (light.kind == LightKind::spot) load_cone(from, where, light, warnings);
    return light;
}

} // namespace boxwood
