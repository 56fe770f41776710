// SPDX-License-Identifier: MIT
// boxwood-benchmark-specialise: what it saves to make programs and buffers for what a scene requires: path tracing by
// the specialised programs beside the ones with everything on, two levels included. In one process and in turns;
// medians and ratios are printed and, with --report, written as JSON.
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/build.hpp"
#include "boxwood/bxw.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/rays.hpp"
#include "common/median.hpp"
#include "render/environment.hpp"
#include "render/integrators.hpp"

namespace boxwood {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t width = 512, height = 320;

struct Subject {
    std::string name;
    Scene scene;
};

std::vector<Subject> subjects(const std::vector<std::filesystem::path>& files) {
    std::vector<Subject> all;
    for (const char* kind : {"sphere", "cornell", "terrain", "forest"}) all.push_back({kind, make_procedural(kind)});
    for (const std::filesystem::path& file : files)
        all.push_back({file.stem().string(), is_bxw(file) ? load_bxw(file).scene : load_gltf(file)});
    return all;
}

ShadingRequirements everything() {
    ShadingRequirements all;
    all.transforms = all.materials = all.normals = all.tangents = all.colors = all.textures = true;
    all.uv_sets = 2;
    all.alpha = all.specular = all.emission = all.punctual = true;
    return all;
}

/// One scene ready for samples, by programs for `requirements`.
class Contender {
public:
    Contender(Device& device, const Subject& subject, const ShadingRequirements& requirements, Levels levels)
        : device_(device), tree_(build(device, subject.scene, {.levels = levels})),
          geometry_(upload(device, subject.scene)),
          appearance_(upload_appearance(device, subject.scene, requirements, warnings_)),
          environment_(upload_environment(device, around(subject.scene))),
          camera_(upload_camera(
              device, subject.scene.cameras.empty() ? default_camera(subject.scene) : subject.scene.cameras.front(),
              width, height)) {
        geometry_.transforms = requirements.transforms;
        options_.width = width;
        options_.height = height;
        parts_ = film_parts(options_.light.integrator);
        film_ = make_film(device, parts_, std::size_t{width} * height);
        buffers_ = make_sample_buffers(device, parts_, width * height);
    }

    /// Milliseconds of one sample of every pixel; each run takes the same one.
    double run() {
        device_.finish();
        const auto start = Clock::now();
        const World world{tree_, geometry_, appearance_, environment_};
        const FilmSample sample =
            take_sample(device_, {world, ambient_, nullptr}, options_, 0, {camera_, 0, width * height}, buffers_);
        add_sample(device_, parts_, sample, film_);
        device_.finish();
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }

    std::size_t shading_bytes() const {
        return appearance_.attributes.size() * sizeof(float) +
               appearance_.triangle_materials.size() * sizeof(std::uint32_t) +
               appearance_.materials.size() * sizeof(MaterialRecord) +
               appearance_.texels.size() * sizeof(std::uint32_t) + appearance_.lights.size() * sizeof(LightRecord);
    }
    double mean_light() const {
        double sum = 0.0;
        for (const auto& plane : film_means(parts_, width * height, download(device_, film_)))
            for (const float value : plane) sum += double{value};
        return sum / (3.0 * width * height);
    }

private:
    static Environment around(const Scene& scene) {
        const ShadingRequirements needs = shading_requirements(scene);
        return needs.emission || needs.punctual ? Environment{} : default_sky();
    }

    Device& device_;
    std::vector<std::string> warnings_;
    Tree tree_;
    Geometry geometry_;
    Appearance appearance_;
    EnvironmentMap environment_;
    AmbientLight ambient_;
    Buffer<CameraRecord> camera_;
    RenderOptions options_;
    FilmParts parts_;
    Buffer<float> film_;
    SampleBuffers buffers_;
};

/// Medians of the specialised and the general programs, in turns after one run each that is not timed.
nlohmann::json measure(Device& device, const Subject& subject, int rounds) {
    Contender special(device, subject, shading_requirements(subject.scene), Levels::automatic);
    Contender general(device, subject, everything(), Levels::two);
    std::vector<double> special_ms, general_ms;
    for (int round = -1; round < rounds; ++round) {
        const double a = special.run(), b = general.run();
        if (round < 0) continue;
        special_ms.push_back(a);
        general_ms.push_back(b);
    }
    return {{"specialised", median(special_ms)},
            {"everything", median(general_ms)},
            {"specialised_bytes", special.shading_bytes()},
            {"everything_bytes", general.shading_bytes()},
            {"specialised_mean", special.mean_light()},
            {"everything_mean", general.mean_light()}};
}

int run(int argc, char** argv) {
    CLI::App app("Times path tracing by programs made for the scene beside programs with everything on.");
    benchmarks::Arguments arguments;
    std::vector<std::filesystem::path> files;
    benchmarks::add_arguments(app, arguments);
    app.add_option("FILES", files, "more scenes: glTF or .bxw");
    CLI11_PARSE(app, argc, argv);

    Device device(arguments.device);
    std::printf(
        "device: %s\nmilliseconds of a sample of %u x %u pixels (path, depth 6), medians of %d alternating runs\n\n",
        device.info().name.c_str(), width, height, arguments.rounds);
    std::printf("%-28s%14s%14s%10s%22s\n", "", "specialised", "everything", "saves", "KiB read by shading");
    nlohmann::json milliseconds, ratios;
    for (const Subject& subject : subjects(files)) {
        const nlohmann::json result = milliseconds[subject.name] = measure(device, subject, arguments.rounds);
        const double special = result.at("specialised"), general = result.at("everything");
        ratios[subject.name] = special / general;
        std::printf("%-28s%14.2f%14.2f%9.0f%%%12zu of %zu\n", subject.name.c_str(), special, general,
                    100.0 * (1.0 - special / general), result.at("specialised_bytes").get<std::size_t>() / 1024,
                    result.at("everything_bytes").get<std::size_t>() / 1024);
    }
    benchmarks::save_report(arguments, device.info(), milliseconds, ratios);
    return 0;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-specialise", [&] { return boxwood::run(argc, argv); });
}
