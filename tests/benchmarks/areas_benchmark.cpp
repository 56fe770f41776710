// SPDX-License-Identifier: MIT
// boxwood-benchmark-areas: trees with an influence area beside the same without, in the configurations of the influence
// study: whether closest hits agree with brute force, the time of rays that follow the area, and of the rule that takes
// every hit in the local tree for the closest, which is wrong. In one process and in turns; with --report also written
// as JSON.
#include <cmath>
#include <cstdio>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/build.hpp"
#include "boxwood/trace.hpp"
#include "cli/study_scenes.hpp"
#include "oracles/brute_force.hpp"
#include "race.hpp"
#include "runtime/launch.hpp"
#include "scene/random.hpp"
#include "support.hpp"
#include "traverse/specialise.hpp"

namespace boxwood {

std::uint64_t test::test_seed() { return 20260101; } // the oracles ask for it

namespace {

struct Choice {
    std::filesystem::path scenes;
    std::filesystem::path areas;
    std::uint32_t rays = 100'000;
    bool brute_force = true;
    std::string builder = "sah";
};

/// A quarter each: in any direction from within the region, from its faces, along the area's lines from its faces, and
/// parallel to its edges from its faces, which never leave the face or leave it at an edge.
std::vector<Ray> hard_rays(const InfluenceRecord& area, std::uint32_t count) {
    const auto corner = corners(area);
    const auto mix = [](const glm::dvec3& a, const glm::dvec3& b, double t) { return a + t * (b - a); };
    const auto place = [&](const glm::dvec3& s) {
        const auto face = [&](int i) {
            return mix(mix(corner[i], corner[i + 1], s.x), mix(corner[i + 2], corner[i + 3], s.x), s.y);
        };
        return mix(face(0), face(4), s.z);
    };
    Random random(1);
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        glm::dvec3 share;
        for (int k = 0; k < 3; ++k) share[k] = double(random.uniform());
        const int axis = static_cast<int>(3.0 * double(random.uniform()));
        if (i % 4 != 0) share[axis] = double(random.uniform()) < 0.5 ? 0.0 : 1.0;
        glm::dvec3 direction;
        for (int k = 0; k < 3; ++k) direction[k] = double(random.uniform()) - 0.5;
        const glm::vec3 origin(place(share));
        if (i % 4 >= 2) {
            glm::dvec3 from = share, to = share;
            const int along = i % 4 == 2 ? 2 : (axis + 1) % 3;
            from[along] = 0.0;
            to[along] = 1.0;
            direction = (place(to) - place(from)) * (double(random.uniform()) < 0.5 ? 1.0 : -1.0);
        }
        const glm::vec3 d(direction);
        rays.push_back({{origin.x, origin.y, origin.z}, 0.0f, {d.x, d.y, d.z}, INFINITY});
    }
    return rays;
}

/// closest_hit by the rule that a hit in the local tree is always the closest.
void naive_closest_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits) {
    KernelRef kernel = traversal_kernel(tree, Query::closest, {});
    kernel.defines["EXIT_RULE"] = "0";
    const BufferView<const std::uint32_t> no_starts;
    const BufferView<RayStatistics> no_statistics;
    launch_traversal(device, kernel, "naive closest hit", tree, rays, no_starts, 0u, hits, no_statistics);
}

std::size_t count_different(const std::vector<Hit>& a, const std::vector<Hit>& b) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        different += a[i].t != b[i].t || a[i].primitive != b[i].primitive || a[i].instance != b[i].instance ||
                     a[i].u != b[i].u || a[i].v != b[i].v;
    return different;
}

struct Result {
    std::uint64_t triangles = 0, local_triangles = 0;
    std::size_t wrong = 0;       ///< Rays answered otherwise than by brute force, or by the tree without areas.
    std::size_t naive_wrong = 0; ///< Of as many, by the naive rule.
    double without_ms = 0.0, with_ms = 0.0, naive_ms = 0.0;
    double local_share = 0.0;                     ///< Of the area's rays, that the local tree answered.
    double without_tests = 0.0, with_tests = 0.0; ///< Volumes and primitives by one of those.
};

Result measure(Device& device, const Mesh& mesh, const InfluenceArea& area, const InfluenceRecord& record,
               const Choice& choice, int rounds) {
    Scene scene;
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"", 0, glm::mat4(1.0f)});
    BuildOptions options;
    options.builder = choice.builder == "pah" ? Builder::sah : to_builder(choice.builder);
    const Tree without = build(device, scene, options);
    options.builder = to_builder(choice.builder);
    options.areas = {area};
    BuildReport report;
    const Tree with = build(device, scene, options, &report);

    Result result;
    result.triangles = mesh.triangles.size();
    result.local_triangles = report.areas[0].triangles;
    const std::vector<Ray> own = cli::area_rays(record, choice.rays, 7);
    std::vector<Ray> all = hard_rays(record, choice.rays / 2);
    all.insert(all.end(), own.begin(), own.begin() + choice.rays / 2);
    const auto hits_of = [&](const auto& query, const Tree& tree) {
        const Buffer<Ray> rays = upload(device, all, "rays");
        Buffer<Hit> hits = make_buffer<Hit>(device, all.size(), "hits");
        query(tree, rays, hits);
        return download(device, hits);
    };
    const auto exact = [&](const Tree& tree, const Buffer<Ray>& rays, Buffer<Hit>& hits) {
        closest_hit(device, tree, rays, hits);
    };
    const auto naive = [&](const Tree& tree, const Buffer<Ray>& rays, Buffer<Hit>& hits) {
        naive_closest_hit(device, tree, rays, hits);
    };
    const std::vector<Hit> expected =
        choice.brute_force ? test::BruteForce(scene, Levels::one).closest_hits(all) : hits_of(exact, without);
    result.wrong = count_different(hits_of(exact, with), expected);
    if (with.arrays().areas.size() > 0) result.naive_wrong = count_different(hits_of(naive, with), expected);

    const Buffer<Ray> rays = upload(device, own, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, own.size(), "hits");
    Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, own.size(), "statistics");
    const auto count = [&](const Tree& tree, double& tests) {
        closest_hit(device, tree, rays, hits, statistics);
        double local = 0.0;
        for (const RayStatistics& each : download(device, statistics)) {
            local += each.areas == 2;
            tests += (static_cast<double>(each.volumes) + each.primitives) / static_cast<double>(own.size());
        }
        return local / static_cast<double>(own.size());
    };
    count(without, result.without_tests);
    result.local_share = count(with, result.with_tests);
    const auto ms =
        benchmarks::race(device,
                         {[&] { exact(without, rays, hits); }, [&] { exact(with, rays, hits); },
                          [&] { with.arrays().areas.size() > 0 ? naive(with, rays, hits) : exact(with, rays, hits); }},
                         rounds);
    result.without_ms = ms[0];
    result.with_ms = ms[1];
    result.naive_ms = ms[2];
    return result;
}

int run(const benchmarks::Arguments& arguments, const Choice& choice) {
    Device device(arguments.device);
    const std::vector<cli::Configuration> configurations = cli::load_configurations(choice.areas);
    const std::vector<InfluenceArea> areas = load_areas(choice.areas);
    nlohmann::json milliseconds = nlohmann::json::object(), ratios = nlohmann::json::object();
    std::printf("%-28s %9s %9s %6s %6s %6s %9s %9s %9s %7s %7s %7s\n", "configuration", "triangles", "local", "wrong",
                "naive", "local", "without", "with", "naive", "with/", "exit", "tests");
    std::printf("%-28s %9s %9s %6s %6s %6s %9s %9s %9s %7s %7s %7s\n", "", "", "", "", "wrong", "share", "ms", "ms",
                "ms", "without", "rule", "with/");
    double log_with = 0.0, log_rule = 0.0, log_tests = 0.0;
    std::size_t wrong = 0, naive_wrong = 0, count = 0;
    for (std::size_t i = 0; i < configurations.size(); ++i) {
        const auto mesh = cli::load_study_scene(configurations[i].scene, choice.scenes, 1);
        if (!mesh) continue;
        const Result r = measure(device, *mesh, areas[i], configurations[i].record, choice, arguments.rounds);
        const double with = r.with_ms / r.without_ms, rule = r.with_ms / r.naive_ms,
                     tests = r.with_tests / r.without_tests;
        std::printf("%-28s %9llu %9llu %6zu %6zu %6.3f %9.3f %9.3f %9.3f %7.3f %7.3f %7.3f\n",
                    configurations[i].name().c_str(), static_cast<unsigned long long>(r.triangles),
                    static_cast<unsigned long long>(r.local_triangles), r.wrong, r.naive_wrong, r.local_share,
                    r.without_ms, r.with_ms, r.naive_ms, with, rule, tests);
        std::fflush(stdout);
        milliseconds[configurations[i].name()] = {
            {"without", r.without_ms}, {"with", r.with_ms}, {"naive", r.naive_ms}};
        ratios[configurations[i].name()] = {{"with_to_without", with},        {"exit_rule_to_naive", rule},
                                            {"tests_with_to_without", tests}, {"wrong", r.wrong},
                                            {"naive_wrong", r.naive_wrong},   {"rays", choice.rays},
                                            {"local_share", r.local_share}};
        log_with += std::log(with);
        log_rule += std::log(rule);
        log_tests += std::log(tests);
        wrong += r.wrong;
        naive_wrong += r.naive_wrong;
        ++count;
    }
    if (count > 0)
        std::printf(
            "%zu configurations of %u rays: %zu wrong, %zu by the naive rule; geometric means: with areas %.3f of "
            "the time and %.3f of the tests without, the exit rule %.3f of the time of the naive one\n",
            count, choice.rays, wrong, naive_wrong, std::exp(log_with / static_cast<double>(count)),
            std::exp(log_tests / static_cast<double>(count)), std::exp(log_rule / static_cast<double>(count)));
    benchmarks::save_report(arguments, device.info(), milliseconds, ratios);
    return wrong == 0 ? 0 : 1;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    CLI::App app("Trees with influence areas: agreement with brute force, and times");
    boxwood::benchmarks::Arguments arguments;
    boxwood::Choice choice;
    boxwood::benchmarks::add_arguments(app, arguments);
    app.add_option("--scenes", choice.scenes, "folder of pah_*.glb")->required();
    app.add_option("--areas", choice.areas, "list of areas with their scenes")->required();
    app.add_option("--rays", choice.rays, "rays of each configuration")->check(CLI::Range(4, 10000000));
    app.add_option("--builder", choice.builder, "lbvh, sah, midpoint or pah");
    app.add_flag("!--no-brute-force", choice.brute_force, "compare with the tree without areas instead");
    CLI11_PARSE(app, argc, argv);
    return boxwood::benchmarks::guarded("boxwood-benchmark-areas", [&] { return boxwood::run(arguments, choice); });
}
