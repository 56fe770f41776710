// SPDX-License-Identifier: MIT
#include "cli/study_scenes.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/gltf.hpp"
#include "build/area_triangles.hpp"
#include "scene/random.hpp"

namespace boxwood::cli {

namespace {

/// In [low, high), of 53 bits.
double uniform(Random& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random.bits() >> 11) * 0x1p-53;
}

glm::dvec3 uniform_vector(Random& random, double low, double high) {
    const double x = uniform(random, low, high), y = uniform(random, low, high), z = uniform(random, low, high);
    return {x, y, z};
}

/// The first vertices anywhere in [0, 10]^3, the second within 1 of the first along each axis, the third of the second.
Mesh random_triangles(std::uint32_t count, std::uint64_t seed) {
    Random random(seed * 0x2545f4914f6cdd1du + count);
    Mesh mesh{"random", {}, {}};
    for (std::uint32_t i = 0; i < count; ++i) {
        glm::dvec3 vertex = uniform_vector(random, 0.0, 10.0);
        for (int corner = 0; corner < 3; ++corner) {
            mesh.positions.emplace_back(vertex);
            vertex += uniform_vector(random, -1.0, 1.0);
        }
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return mesh;
}

/// The words of an entry that load_areas does not read.
void read_words(const nlohmann::json& entry, Configuration& configuration) {
    configuration.scene = entry.at("scene").get<std::string>();
    configuration.orientation = entry.at("orientation").get<std::string>();
}

} // namespace

std::vector<Configuration> load_configurations(const std::filesystem::path& file) {
    const std::vector<InfluenceArea> areas = load_areas(file);
    std::ifstream stream(file);
    const nlohmann::json entries = nlohmann::json::parse(stream, nullptr, false);
    std::vector<Configuration> configurations(areas.size());
    for (std::size_t i = 0; i < areas.size(); ++i) {
        Configuration& configuration = configurations[i];
        try {
            read_words(entries.at(i), configuration);
        } catch (const nlohmann::json::exception&) {
            throw InputError(file.string(), "area " + std::to_string(i),
                             "needs the words \"scene\" and \"orientation\" to be studied");
        }
        configuration.area = areas[i].kind == AreaKind::plane ? "plane" : "point";
        configuration.record = influence_records(std::span(&areas[i], 1), file.string())[0];
    }
    return configurations;
}

std::optional<Mesh> load_study_scene(const std::string& name, const std::filesystem::path& folder, std::uint64_t seed) {
    if (name == "Random100") return random_triangles(100, seed);
    if (name == "Random1000") return random_triangles(1000, seed);
    const std::string stem = name == "Suzanne" ? "MonkeyModel" : name == "Wood" ? "WoodScene" : name;
    const std::filesystem::path file = folder / ("pah_" + stem + ".glb");
    std::error_code none; // a name that no file can have
    if (!std::filesystem::exists(file, none)) return std::nullopt;
    Scene scene = flatten(load_gltf(file));
    return scene.meshes.empty() ? Mesh{} : std::move(scene.meshes[0]);
}

Mesh local_mesh(Device& device, const Mesh& mesh, const InfluenceRecord& area) {
    Scene scene;
    scene.meshes.push_back(mesh);
    const Geometry geometry = upload(device, scene);
    Mesh local{mesh.name, mesh.positions, {}};
    for (const std::uint32_t triangle :
         download(device, area_triangles(device, geometry.positions, geometry.triangles, area)))
        local.triangles.push_back(mesh.triangles[triangle]);
    return local;
}

std::vector<Ray> area_rays(const InfluenceRecord& area, std::uint32_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const double x = uniform(random, -1.0, 1.0) * area.half_width;
        const double y = uniform(random, -1.0, 1.0) * area.half_height;
        for (int k = 0; k < 3; ++k) {
            const double aside = x * area.right[k] + y * area.up[k];
            const double direction = area.point ? area.forward[k] + aside : double{area.forward[k]};
            const double start = area.point ? area.near * direction : aside;
            ray.origin[k] = static_cast<float>(area.origin[k] + start);
            ray.direction[k] = static_cast<float>(direction);
        }
        ray.t_min = 0.0f;
        ray.t_max = std::numeric_limits<float>::infinity();
    }
    return rays;
}

} // namespace boxwood::cli
