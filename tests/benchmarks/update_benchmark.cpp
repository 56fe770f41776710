// SPDX-License-Identifier: MIT
// boxwood-benchmark-update: what it costs to follow an animated scene: moving instances, deforming a mesh and refitting
// one, beside building anew. In one process and in turns; medians and ratios are printed and, with --report, written as
// JSON.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/update.hpp"
#include "common/median.hpp"

namespace boxwood {
namespace {

using Clock = std::chrono::steady_clock;

struct Subject {
    const char* name;
    Scene scene;
    BuildOptions options;
};

/// Each under two levels, so that every update applies.
std::vector<Subject> subjects() {
    const Scene forest = make_procedural("forest", {.triangles = 100'000, .instances = 10'000}),
                sphere = make_procedural("sphere", {.triangles = 100'000});
    std::vector<Subject> all;
    for (const auto& [layout, bounds, forest_name, sphere_name] :
         {std::tuple{Layout::wide8, Bounds::aabb, "forest, wide8", "sphere, wide8"},
          std::tuple{Layout::binary, Bounds::aabb, "forest, binary", "sphere, binary"},
          std::tuple{Layout::binary, Bounds::obb_moments, "forest, obb-moments", "sphere, obb-moments"}}) {
        const BuildOptions options{.levels = Levels::two, .layout = layout, .bounds = {.kind = bounds}};
        all.push_back({forest_name, forest, options});
        all.push_back({sphere_name, sphere, options});
    }
    return all;
}

struct Update {
    const char* name;
    std::function<void()> run;
};

/// Milliseconds of each update, the median of `rounds` after one that is not timed.
nlohmann::json race(Device& device, const std::vector<Update>& updates, int rounds) {
    std::vector<std::vector<double>> times(updates.size());
    for (int round = -1; round < rounds; ++round) {
        for (std::size_t i = 0; i < updates.size(); ++i) {
            device.finish();
            const auto start = Clock::now();
            updates[i].run();
            device.finish();
            const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
            if (round >= 0) times[i].push_back(ms);
        }
        device.take_profile();
    }
    nlohmann::json medians;
    for (std::size_t i = 0; i < updates.size(); ++i) medians[updates[i].name] = median(times[i]);
    return medians;
}

nlohmann::json measure(Device& device, const Subject& subject, int rounds) {
    AnimatedTree animated(device, subject.scene, subject.options);
    std::vector<glm::mat4> transforms;
    for (const Instance& instance : subject.scene.instances) transforms.push_back(instance.transform);
    // Every run gives the device other numbers, which stay near the first.
    int frame = 0;
    const auto wave = [&] { return 0.01f * std::sin(static_cast<float>(++frame)); };
    const std::vector<glm::vec3>& rest = subject.scene.meshes[0].positions;
    return race(device,
                {{"move_instances",
                  [&] {
                      std::vector<glm::mat4> moved = transforms;
                      const float shift = wave();
                      for (glm::mat4& transform : moved) transform[3].x += shift;
                      animated.move_instances(moved);
                  }},
                 {"deform",
                  [&] {
                      glm::mat4 map(1.0f);
                      map[1][0] = wave();
                      animated.deform(0, map);
                  }},
                 {"refit",
                  [&] {
                      std::vector<glm::vec3> positions = rest;
                      const float scale = 1.0f + wave();
                      for (glm::vec3& p : positions) p *= scale;
                      animated.refit(0, positions);
                  }},
                 {"rebuild", [&] { animated.rebuild(); }}},
                rounds);
}

int run(int argc, char** argv) {
    CLI::App app("Times the updates of animated scenes beside a build.");
    benchmarks::Arguments arguments;
    benchmarks::add_arguments(app, arguments);
    CLI11_PARSE(app, argc, argv);

    Device device(arguments.device);
    const char* const names[] = {"move_instances", "deform", "refit", "rebuild"};
    std::printf("device: %s\nmilliseconds, medians of %d alternating runs, and the part of a rebuild's\n\n",
                device.info().name.c_str(), arguments.rounds);
    std::printf("%-22s", "");
    for (const char* name : names) std::printf("%20s", name);
    std::printf("\n");
    nlohmann::json milliseconds, ratios;
    for (const Subject& subject : subjects()) {
        const nlohmann::json medians = milliseconds[subject.name] = measure(device, subject, arguments.rounds);
        std::printf("%-22s", subject.name);
        for (const char* name : names) {
            const double ms = medians.at(name), ratio = ms / medians.at("rebuild").get<double>();
            ratios[subject.name][name] = ratio;
            std::printf("%12.2f (%5.2f)", ms, ratio);
        }
        std::printf("\n");
    }
    benchmarks::save_report(arguments, device.info(), milliseconds, ratios);
    return 0;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-update", [&] { return boxwood::run(argc, argv); });
}
