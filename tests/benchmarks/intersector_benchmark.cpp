// SPDX-License-Identifier: MIT
// boxwood-benchmark-intersector: what the watertight ray-triangle test costs beside that of Moller and Trumbore, and
// what it is worth: rays per second on the scenes given, and against exact arithmetic the hits that are missed, those
// that are none, and the error of t.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/build.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"
#include "oracles/closed_meshes.hpp"
#include "oracles/exact_ray.hpp"
#include "oracles/generator.hpp"
#include "race.hpp"

namespace boxwood::benchmarks {
namespace {

using test::Corners;
using test::Generator;

constexpr Intersector both[] = {Intersector::watertight, Intersector::moeller_trumbore};

/// Rays of one sort and the triangles that they meet.
struct Case {
    std::string name;
    Scene scene;
    std::vector<Ray> rays;
};

Scene scene_of(Mesh mesh) {
    Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"", 0, glm::mat4(1.0f)});
    return scene;
}

Ray ray_to(const glm::vec3& origin, const glm::vec3& target) {
    const glm::vec3 d = target - origin;
    return {{origin.x, origin.y, origin.z}, 0.0f, {d.x, d.y, d.z}, std::numeric_limits<float>::infinity()};
}

Case random_case(std::size_t rays) {
    Generator random(1);
    Mesh mesh;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const glm::vec3 middle = glm::vec3(random.cube());
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(middle + 0.3f * glm::vec3(random.cube()));
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    Case one{"random rays", scene_of(std::move(mesh)), {}};
    for (std::size_t i = 0; i < rays; ++i)
        one.rays.push_back(ray_to(3.0f * glm::vec3(random.cube()), glm::vec3(random.cube())));
    return one;
}

/// Needles of length 2 in all directions, and rays at points of them that graze them at down to 1e-3.
Case sliver_case(const std::string& name, float width, std::size_t rays) {
    Generator random(2);
    Mesh mesh;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const glm::vec3 middle = glm::vec3(random.cube()), along = glm::normalize(glm::vec3(random.cube()));
        const glm::vec3 across = width * glm::normalize(glm::cross(along, glm::vec3(random.cube())));
        for (const glm::vec3& p : {middle - along, middle + along, middle + across}) mesh.positions.push_back(p);
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    Case one{name, {}, {}};
    for (std::size_t i = 0; i < rays; ++i) {
        const glm::vec3* p = &mesh.positions[3 * (i % 100)];
        const float u = random.uniform(0.1f, 0.4f), v = random.uniform(0.1f, 0.4f);
        const glm::vec3 target = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
        const glm::vec3 normal = glm::normalize(glm::cross(p[1] - p[0], (p[2] - p[0]) / width));
        const float lean = std::pow(10.0f, random.uniform(-3.0f, 0.0f));
        const glm::vec3 from = glm::normalize(lean * normal + glm::normalize(p[1] - p[0]));
        one.rays.push_back(ray_to(target + random.uniform(1.0f, 3.0f) * from, target));
    }
    one.scene = scene_of(std::move(mesh));
    return one;
}

Case closed_case(const std::string& name, test::Aim aim, std::size_t rays) {
    const test::ClosedScene closed = test::make_closed({"", 8, 16});
    return {name, closed.scene, test::rays_from_inside(closed, aim, rays, 3)};
}

struct Errors {
    std::size_t missed = 0, false_hits = 0, hits = 0;
    double median = 0.0, most = 0.0; ///< Of t, in units in its last place.
};

double ulps(float t, __float128 exact) {
    const float unit = std::nextafter(std::fabs(t), std::numeric_limits<float>::infinity()) - std::fabs(t);
    return std::fabs(static_cast<double>((t - exact) / unit));
}

Errors compare(const Case& one, const std::vector<Hit>& hits) {
    std::vector<Corners> triangles;
    const Mesh& mesh = one.scene.meshes[0];
    for (const glm::uvec3& t : mesh.triangles)
        triangles.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
    Errors errors;
    std::vector<double> off;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const test::ExactHit exact = test::exact_hit(one.rays[i], triangles);
        errors.hits += exact.t >= 0;
        if (hits[i].primitive == BOXWOOD_NONE) {
            errors.missed += exact.t >= 0;
            continue;
        }
        const test::ExactIntersection hit = test::exact_intersection(one.rays[i], triangles[hits[i].primitive]);
        errors.false_hits += !hit.inside;
        if (hit.inside) off.push_back(ulps(hits[i].t, hit.t));
    }
    if (off.empty()) return errors;
    std::sort(off.begin(), off.end());
    errors.median = off[off.size() / 2];
    errors.most = off.back();
    return errors;
}

void price_accuracy(Device& device, std::size_t rays, nlohmann::json& ratios) {
    std::printf("\n%-24s %-18s %9s %9s %9s %12s %12s\n", "against exact arithmetic", "", "hits", "missed", "false",
                "t off, ulps", "at most");
    const Case cases[] = {random_case(rays),
                          closed_case("at edges", test::Aim::edges, rays),
                          closed_case("at vertices", test::Aim::vertices, rays),
                          closed_case("axis-parallel", test::Aim::axes, rays),
                          sliver_case("slivers 1e4:1", 2e-4f, rays),
                          sliver_case("slivers 1e6:1", 2e-6f, rays)};
    for (const Case& one : cases) {
        const Tree tree = build(device, one.scene);
        const Buffer<Ray> queries = upload(device, one.rays, "rays");
        Buffer<Hit> hits = make_buffer<Hit>(device, one.rays.size(), "hits");
        for (const Intersector intersector : both) {
            closest_hit(device, tree, queries, hits, {.intersector = intersector});
            const Errors errors = compare(one, download(device, hits));
            const std::string word(name(intersector));
            std::printf("%-24s %-18s %9zu %9zu %9zu %12.2g %12.2g\n", one.name.c_str(), word.c_str(), errors.hits,
                        errors.missed, errors.false_hits, errors.median, errors.most);
            std::fflush(stdout);
            ratios[one.name][word] = {{"hits", errors.hits},
                                      {"missed", errors.missed},
                                      {"false", errors.false_hits},
                                      {"median_ulps", errors.median},
                                      {"most_ulps", errors.most}};
        }
    }
}

void price_speed(Device& device, const std::string& file, const Arguments& arguments, nlohmann::json& milliseconds,
                 nlohmann::json& ratios) {
    const Scene scene = file.empty() ? make_procedural("terrain") : load_gltf(file);
    const std::string title = file.empty() ? "terrain" : std::filesystem::path(file).stem().string();
    const Camera camera = scene.cameras.empty() ? default_camera(scene) : scene.cameras.front();
    constexpr std::uint32_t side = 1024;
    Buffer<Ray> rays = make_buffer<Ray>(device, side * side, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, side * side, "hits");
    primary_rays(device, camera, side, side, rays);
    for (const Layout layout : {Layout::wide8, Layout::binary}) {
        const Tree tree = build(device, scene, {.layout = layout, .builder = Builder::sah});
        std::vector<std::function<void()>> contenders;
        for (const Intersector intersector : both)
            contenders.emplace_back(
                [&, intersector] { closest_hit(device, tree, rays, hits, {.intersector = intersector}); });
        const std::vector<double> ms = race(device, contenders, arguments.rounds);
        const std::string layout_name(name(layout));
        std::printf("%-24s %-8s %12.2f %16.2f %9.3f\n", title.c_str(), layout_name.c_str(), side * side * 1e-3 / ms[0],
                    side * side * 1e-3 / ms[1], ms[0] / ms[1]);
        std::fflush(stdout);
        milliseconds[title][layout_name] = {{"watertight", ms[0]}, {"moeller-trumbore", ms[1]}};
        ratios[title][layout_name] = ms[0] / ms[1];
    }
}

int run(int argc, char** argv) {
    CLI::App app{"Prices the watertight ray-triangle test"};
    Arguments arguments;
    std::vector<std::string> files;
    std::size_t rays = 20000;
    add_arguments(app, arguments);
    app.add_option("scenes", files, "glTF files whose primary rays are timed; a terrain without any");
    app.add_option("--rays", rays, "of each sort that is compared with exact arithmetic")
        ->check(CLI::Range(1, 10000000));
    CLI11_PARSE(app, argc, argv);
    if (files.empty()) files.emplace_back();

    Device device(arguments.device);
    nlohmann::json milliseconds, ratios;
    std::printf("device: %s\n%-24s %-8s %12s %16s %9s\n", device.info().name.c_str(), "primary rays, Mray/s", "",
                "watertight", "moeller-trumbore", "time");
    for (const std::string& file : files) price_speed(device, file, arguments, milliseconds, ratios);
    price_accuracy(device, rays, ratios);
    save_report(arguments, device.info(), milliseconds, ratios);
    return 0;
}

} // namespace
} // namespace boxwood::benchmarks

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-intersector",
                                        [&] { return boxwood::benchmarks::run(argc, argv); });
}
