// SPDX-License-Identifier: MIT
#include "boxwood/procedural.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "boxwood/error.hpp"
#include "scene/procedural_kinds.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

struct Kind {
    const char* name;
    const char* description;
    Scene (*make)(const ProceduralOptions&);
};

constexpr std::array kinds{
    Kind{"cornell", "a box with two blocks and a light quad", make_cornell},
    Kind{"random", "unconnected triangles in the unit cube", make_random},
    Kind{"terrain", "a heightfield of fractal noise", make_terrain},
    Kind{"sphere", "a closed unit sphere", make_sphere},
    Kind{"forest", "instanced trees of three kinds on a plane", make_forest},
    Kind{"menger", "the outside of a Menger sponge", make_menger},
    Kind{"hair", "bundles of long strands that lean away from the axes", make_hair},
    Kind{"planks", "piles of long boards, each pile turned at random", make_planks},
    Kind{"materials", "rows of spheres, matt to polished, on a textured floor under two lights", make_materials},
};

} // namespace

std::uint64_t floor_sqrt(std::uint64_t value) {
    auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(value)));
    while (root * root > value) --root;
    while ((root + 1) * (root + 1) <= value) ++root;
    return root;
}

void paint(Scene& scene, Mesh& mesh, const char* name, glm::vec3 color) {
    Material material;
    material.name = name;
    material.base_color = glm::vec4(color, 1.0f);
    material.metallic = 0.0f;
    material.specular = 0.0f;
    mesh.materials.assign(mesh.triangles.size(), static_cast<std::uint32_t>(scene.materials.size()));
    scene.materials.push_back(material);
}

Scene single_mesh_scene(Mesh mesh, glm::dvec3 eye, glm::dvec3 target) {
    Scene scene;
    scene.instances.push_back({mesh.name, 0, glm::mat4(1.0f)});
    scene.meshes.push_back(std::move(mesh));
    scene.cameras.push_back({"camera", look_at(eye, target)});
    return scene;
}

std::vector<ProceduralKind> procedural_kinds() {
    std::vector<ProceduralKind> list;
    for (const Kind& kind : kinds) list.push_back({kind.name, kind.description});
    return list;
}

Scene make_procedural(std::string_view kind, const ProceduralOptions& options) {
    constexpr std::uint64_t limit = std::uint64_t{1} << 31;
    if (options.triangles >= limit) throw InputError(std::string(kind), "triangles", "must be below 2147483648");
    if (options.instances >= limit) throw InputError(std::string(kind), "instances", "must be below 2147483648");
    std::string known;
    for (const Kind& candidate : kinds) {
        if (kind == candidate.name) return candidate.make(options);
        known += (known.empty() ? "" : ", ") + std::string(candidate.name);
    }
    throw InputError(std::string(kind), "kind", "is not a procedural scene; choose one of " + known);
}

} // namespace boxwood
