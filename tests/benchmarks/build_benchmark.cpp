// SPDX-License-Identifier: MIT
// boxwood-benchmark-build: what it costs to build many small meshes instead of one large one, all in the same launches.
// Alternating runs in one process, medians.
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/build.hpp"
#include "boxwood/procedural.hpp"
#include "common/median.hpp"

namespace boxwood {
namespace {

/// The first `count` triangles of the seed's random scene as a mesh of their own.
Mesh random_mesh(std::uint64_t count, std::uint64_t seed) {
    return std::move(make_procedural("random", {.triangles = count, .seed = seed}).meshes.at(0));
}

/// `meshes` meshes of `triangles` random triangles each, placed once.
Scene make_scene(std::uint32_t meshes, std::uint64_t triangles) {
    Scene scene;
    for (std::uint32_t i = 0; i < meshes; ++i) {
        scene.meshes.push_back(random_mesh(triangles, i + 1));
        scene.instances.push_back({.name = "", .mesh = i});
    }
    return scene;
}

/// Build from the uploaded triangles on, wall clock, in milliseconds.
double build_ms(Device& device, const Scene& scene) {
    BuildReport report;
    build(device, scene, {.levels = Levels::two}, &report);
    return report.total_ms - report.upload_ms;
}

int run(int argc, char** argv) {
    CLI::App app("Times builds of many small meshes beside one large one.");
    benchmarks::Arguments arguments;
    benchmarks::add_arguments(app, arguments);
    CLI11_PARSE(app, argc, argv);

    Device device(arguments.device);
    const Scene many = make_scene(1000, 100), one = make_scene(1, 100'000);
    std::vector<double> many_ms, one_ms;
    for (int round = -1; round < arguments.rounds; ++round) {
        const double first = build_ms(device, many), second = build_ms(device, one);
        if (round < 0) continue; // warms
        many_ms.push_back(first);
        one_ms.push_back(second);
    }
    std::printf("device: %s\n", device.info().name.c_str());
    std::printf("1,000 meshes of 100 triangles  %8.2f ms\n", median(many_ms));
    std::printf("1 mesh of 100,000 triangles    %8.2f ms\n", median(one_ms));
    std::printf("ratio                          %8.2f\n", median(many_ms) / median(one_ms));
    benchmarks::save_report(arguments, device.info(), {{"many", median(many_ms)}, {"one", median(one_ms)}},
                            {{"many_against_one", median(many_ms) / median(one_ms)}});
    return 0;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-build", [&] { return boxwood::run(argc, argv); });
}
