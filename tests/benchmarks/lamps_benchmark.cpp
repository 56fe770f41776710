// SPDX-License-Identifier: MIT
// boxwood-benchmark-lamps: shadow rays towards a directional and a rectangular light over each scene, by one tree
// (sah), with the local trees of the areas of these lights that are worth it (pah) and of all of them, and by one tree
// that knows of them (blend). In one process and in turns; with --report also written as JSON.
#include <cmath>
#include <cstdio>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/area_probe.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"
#include "race.hpp"
#include "scene/random.hpp"

namespace boxwood {

namespace {

using benchmarks::Arguments;

/// A scene flattened to one mesh, lit by a sun and by a lamp above its middle, a quarter of its size.
struct Lit {
    Scene scene;
    glm::vec3 sun = glm::normalize(glm::vec3(-0.4f, -1.0f, -0.3f));
    glm::vec3 lamp{0.0f}; ///< Middle.
    float half = 0.0f;    ///< Half its sides.
};

Scene load(const std::string& name) {
    for (const ProceduralKind& kind : procedural_kinds())
        if (kind.name == name) return flatten(make_procedural(name));
    return flatten(load_gltf(name));
}

Lit light(const std::string& name) {
    Lit lit;
    lit.scene = load(name);
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : lit.scene.meshes.at(0).positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 size = high - low;
    lit.half = 0.125f * std::max(size.x, size.z);
    lit.lamp = 0.5f * (low + high);
    lit.lamp.y = high.y + 0.25f * std::max(size.y, lit.half);
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = lit.sun;
    lit.scene.lights = {sun};
    Material glow;
    glow.emission = glm::vec3(10.0f);
    lit.scene.materials.push_back(glow);
    Mesh lamp;
    for (int i = 0; i < 4; ++i)
        lamp.positions.push_back(lit.lamp +
                                 glm::vec3(i & 1 ? lit.half : -lit.half, 0.0f, i & 2 ? lit.half : -lit.half));
    lamp.triangles = {{0, 1, 2}, {1, 3, 2}}; // it shines down
    lamp.materials.assign(2, static_cast<std::uint32_t>(lit.scene.materials.size() - 1));
    lit.scene.meshes.push_back(lamp);
    lit.scene.instances.push_back({"", 1, glm::mat4(1.0f)});
    return lit;
}

/// From what 512 x 512 camera rays hit: one ray to the sun and one to a point of the lamp, for each.
std::vector<Ray> shadow_rays_of(Device& device, const Lit& lit, const Tree& tree) {
    constexpr std::uint32_t side = 512;
    Buffer<Ray> primary = make_buffer<Ray>(device, side * side, "primary rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, side * side, "hits");
    const Camera camera = lit.scene.cameras.empty() ? default_camera(lit.scene) : lit.scene.cameras[0];
    primary_rays(device, camera, side, side, primary);
    closest_hit(device, tree, primary, hits);
    Random random(1);
    std::vector<Ray> rays;
    const std::vector<Ray> sources = download(device, primary);
    const std::vector<Hit> found = download(device, hits);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (found[i].primitive == BOXWOOD_NONE) continue;
        glm::vec3 p;
        for (int k = 0; k < 3; ++k) p[k] = sources[i].origin[k] + found[i].t * sources[i].direction[k];
        const glm::vec3 to_lamp =
            lit.lamp + glm::vec3(random.uniform(-lit.half, lit.half), 0.0f, random.uniform(-lit.half, lit.half)) - p;
        const float near = 0x1p-12f; // of the way to the lamp, or of its size
        rays.push_back({{p.x, p.y, p.z}, near * lit.half, {-lit.sun.x, -lit.sun.y, -lit.sun.z}, INFINITY});
        rays.push_back({{p.x, p.y, p.z}, near, {to_lamp.x, to_lamp.y, to_lamp.z}, 1.0f - near});
    }
    return rays;
}

std::vector<InfluenceArea> worth(const std::vector<ProbedArea>& judged) {
    std::vector<InfluenceArea> areas;
    for (const ProbedArea& each : judged)
        if (each.kept) areas.push_back(each.area);
    return areas;
}

Tree build_with(Device& device, const Scene& scene, Builder builder, const std::vector<InfluenceArea>& areas) {
    BuildOptions options{.levels = Levels::one, .builder = builder, .areas = areas};
    if (areas.empty() && needs_areas(builder)) options.builder = Builder::sah;
    return build(device, scene, options);
}

/// Share of the rays that a local tree answered in a search for the closest hit.
double answered(Device& device, const Tree& tree, const Buffer<Ray>& rays) {
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "hits");
    Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, rays.size(), "statistics");
    closest_hit(device, tree, rays, hits, statistics);
    double count = 0.0;
    for (const RayStatistics& each : download(device, statistics)) count += each.areas == 2;
    return count / static_cast<double>(rays.size());
}

void measure(Device& device, const std::string& name, const Arguments& arguments, nlohmann::json& milliseconds,
             nlohmann::json& ratios) {
    const Lit lit = light(name);
    const std::vector<InfluenceArea> lights = areas_from_lights(lit.scene);
    const std::vector<InfluenceArea> local = worth(judge_areas(device, lit.scene, lights, {.builder = Builder::pah}));
    const std::vector<InfluenceArea> known = worth(judge_areas(device, lit.scene, lights, {.builder = Builder::blend}));
    const Tree trees[] = {
        build_with(device, lit.scene, Builder::sah, {}), build_with(device, lit.scene, Builder::pah, local),
        build_with(device, lit.scene, Builder::pah, lights), build_with(device, lit.scene, Builder::blend, known)};
    const Buffer<Ray> rays = upload(device, shadow_rays_of(device, lit, trees[0]), "shadow rays");
    Buffer<std::uint32_t> shadows = make_buffer<std::uint32_t>(device, rays.size(), "shadows");
    std::vector<std::function<void()>> contenders;
    for (const Tree& tree : trees) contenders.push_back([&] { any_hit(device, tree, rays, shadows); });
    std::size_t different = 0;
    contenders[0]();
    const std::vector<std::uint32_t> expected = download(device, shadows);
    for (const auto& contender : contenders) {
        contender();
        const std::vector<std::uint32_t> found = download(device, shadows);
        for (std::size_t i = 0; i < found.size(); ++i) different += (found[i] != 0) != (expected[i] != 0);
    }
    const std::vector<double> ms = benchmarks::race(device, contenders, arguments.rounds);
    std::printf("%-24s %8zu %5zu %5zu %8.3f %8.3f %8.3f %5zu %8.3f %6zu\n", std::filesystem::path(name).stem().c_str(),
                rays.size(), lights.size(), local.size(), ms[1] / ms[0], ms[2] / ms[0],
                answered(device, trees[2], rays), known.size(), ms[3] / ms[0], different);
    std::fflush(stdout);
    milliseconds[name] = {{"sah", ms[0]}, {"lights", ms[1]}, {"all_lights", ms[2]}, {"blend", ms[3]}};
    ratios[name] = {{"lights", ms[1] / ms[0]}, {"all_lights", ms[2] / ms[0]}, {"blend", ms[3] / ms[0]},
                    {"areas", lights.size()},  {"kept", local.size()},        {"known", known.size()},
                    {"different", different}};
}

int run(const Arguments& arguments, const std::vector<std::string>& scenes) {
    Device device(arguments.device);
    nlohmann::json milliseconds = nlohmann::json::object(), ratios = nlohmann::json::object();
    std::printf("%-24s %8s %5s %5s %8s %8s %8s %5s %8s %6s\n", "scene", "rays", "areas", "kept", "kept/", "all/",
                "answered", "known", "blend/", "differ");
    std::printf("%-24s %8s %5s %5s %8s %8s %8s %5s %8s %6s\n", "", "", "", "", "sah", "sah", "locally", "", "sah", "");
    for (const std::string& scene : scenes) measure(device, scene, arguments, milliseconds, ratios);
    benchmarks::save_report(arguments, device.info(), milliseconds, ratios);
    return 0;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    CLI::App app("Shadow rays towards a directional and a rectangular light, with influence areas and without");
    boxwood::benchmarks::Arguments arguments;
    std::vector<std::string> scenes{"terrain", "planks", "forest"};
    boxwood::benchmarks::add_arguments(app, arguments);
    app.add_option("scenes", scenes, "glTF files or procedural kinds (default: terrain, planks, forest)");
    CLI11_PARSE(app, argc, argv);
    return boxwood::benchmarks::guarded("boxwood-benchmark-lamps", [&] { return boxwood::run(arguments, scenes); });
}
