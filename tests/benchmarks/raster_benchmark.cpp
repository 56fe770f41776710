// SPDX-License-Identifier: MIT
// boxwood-benchmark-raster: primary hits by the rasteriser against primary rays, on the scenes given: whether the two
// are the same, and the time of each. Alternating runs, medians.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "common/median.hpp"
#include "render/both_hits.hpp"
#include "render/camera.hpp"

namespace boxwood {
namespace {

struct Case {
    std::string name;
    Scene scene;
};

/// Files, or all kinds of procedural scenes without any.
std::vector<Case> load(const std::vector<std::string>& files) {
    std::vector<Case> cases;
    for (const std::string& file : files)
        cases.push_back({std::filesystem::path(file).stem().string(), load_gltf(file)});
    if (files.empty())
        for (const ProceduralKind& kind : procedural_kinds()) cases.push_back({kind.name, make_procedural(kind.name)});
    return cases;
}

struct Times {
    std::vector<double> traced, drawn;
};

template <class Work>
double milliseconds(Device& device, const Work& work) {
    device.finish();
    const auto start = std::chrono::steady_clock::now();
    work();
    device.finish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Of the hits alone: rays are made for both.
Times time_both(Device& device, const Scene& scene, const Camera& camera, std::uint32_t size, int rounds) {
    const std::size_t pixels = std::size_t{size} * size;
    const Tree tree = build(device, scene);
    const Geometry geometry = upload(device, scene);
    const Rasteriser rasteriser(device, scene, tree, geometry);
    const Buffer<CameraRecord> record = upload_camera(device, camera, size, size);
    Buffer<Ray> rays = make_buffer<Ray>(device, pixels, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, pixels, "hits");
    primary_rays(device, record, 0, rays);
    Times times;
    for (int round = -1; round < rounds; ++round) {
        const double traced = milliseconds(device, [&] { closest_hit(device, tree, rays, hits); });
        const double drawn = milliseconds(device, [&] { rasteriser.draw(record, size, size, 0, rays, hits); });
        if (round < 0) continue; // the first warms
        times.traced.push_back(traced);
        times.drawn.push_back(drawn);
    }
    return times;
}

int run(int argc, char** argv) {
    CLI::App app("Compares the rasteriser with primary rays.");
    benchmarks::Arguments arguments;
    std::vector<std::string> files;
    std::uint32_t size = 1024;
    benchmarks::add_arguments(app, arguments);
    app.add_option("scenes", files, "glTF files; without any all procedural kinds");
    app.add_option("--size", size, "pixels across and down")->check(CLI::Range(1, 8192));
    CLI11_PARSE(app, argc, argv);

    Device device(arguments.device);
    nlohmann::json report, ratios;
    std::printf("device: %s; %u x %u pixels\n", device.info().name.c_str(), size, size);
    std::printf("%-36s %11s %8s %9s %9s %9s %7s\n", "", "triangles", "covered", "different", "rays ms", "raster ms",
                "ratio");
    bool good = true;
    for (const Case& one : load(files)) {
        const Camera camera = one.scene.cameras.empty() ? default_camera(one.scene) : one.scene.cameras[0];
        const test::BothHits both = test::both_hits(device, one.scene, BuildOptions{}, camera, size, size);
        const Times times = time_both(device, one.scene, camera, size, arguments.rounds);
        const double traced = median(times.traced), drawn = median(times.drawn);
        std::printf("%-36s %11llu %7.1f%% %9zu %9.1f %9.1f %7.2f\n", one.name.c_str(),
                    static_cast<unsigned long long>(one.scene.instanced_triangle_count()),
                    100.0 * static_cast<double>(both.hits()) / static_cast<double>(both.rays.size()), both.different(),
                    traced, drawn, traced / drawn);
        std::fflush(stdout);
        report[one.name] = {{"rays", traced}, {"raster", drawn}};
        ratios[one.name] = {{"pixels that differ", both.different()}, {"rays over raster", traced / drawn}};
        good = good && both.different() == 0;
    }
    benchmarks::save_report(arguments, device.info(), report, ratios);
    return good ? 0 : 1;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-raster", [&] { return boxwood::run(argc, argv); });
}
