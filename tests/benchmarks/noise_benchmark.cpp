// SPDX-License-Identifier: MIT
// boxwood-benchmark-noise: how far pictures of few samples are from one of many, by sampler, hemisphere and strategy,
// over samples and over time; and what share of the time each stage has.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/rays.hpp"
#include "render/path_picture.hpp"
#include "render/path_scenes.hpp"

namespace boxwood {
namespace {

using nlohmann::json;

struct Contender {
    const char* name;
    SamplerKind sampler = SamplerKind::sobol;
    Hemisphere hemisphere = Hemisphere::cosine;
    Strategy strategy = Strategy::mis;
};

constexpr Contender contenders[] = {
    {"sobol, cosine, mis"},
    {"stratified", SamplerKind::stratified},
    {"random", SamplerKind::random},
    {"uniform", SamplerKind::sobol, Hemisphere::uniform},
    {"lights", SamplerKind::sobol, Hemisphere::cosine, Strategy::lights},
    {"bsdf", SamplerKind::sobol, Hemisphere::cosine, Strategy::bsdf},
};

struct Study {
    std::string name;
    Scene scene;
    Environment around;
    Camera camera;
};

struct Settings {
    std::uint32_t across = 64;
    std::uint32_t most_samples = 64;
    std::uint32_t reference_samples = 2048;
    std::uint32_t depth = 5;
    std::string interior;
    std::vector<std::string> scenes; ///< Empty: all.
    bool default_only = false;
    bool stages_only = false;
    int rounds = 1;
};

struct Point {
    std::uint32_t samples;
    double error; ///< See relative_error.
    double ms;    ///< Device time of the light, primary rays included.
};

/// log(error) as a line over log(x), by least squares.
struct Line {
    double slope = 0.0, at_one = 0.0;

    double at(double x) const { return std::exp(at_one + slope * std::log(x)); }
};

template <class Coordinate>
Line fit(const std::vector<Point>& points, const Coordinate& coordinate) {
    double n = double(points.size()), x = 0, y = 0, xx = 0, xy = 0;
    for (const Point& p : points) {
        const double a = std::log(coordinate(p)), b = std::log(p.error);
        x += a, y += b, xx += a * a, xy += a * b;
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x);
    return {slope, (y - slope * x) / n};
}

LightOptions options_of(const Contender& contender, std::uint32_t samples, std::uint32_t depth, std::uint64_t seed) {
    LightOptions options;
    options.sampler = contender.sampler;
    options.hemisphere = contender.hemisphere;
    options.strategy = contender.strategy;
    options.samples = samples;
    options.depth = depth;
    options.seed = seed;
    // Beams narrow with the number of samples: filtered textures would be others for each.
    options.filter = TextureFilter::nearest;
    return options;
}

glm::vec3 eye(const Camera& camera) { return glm::vec3(camera.to_world[3]); }

/// From a quarter of the length of the scene's box along its longer side, at a third of its height.
Camera inside_view(const Scene& scene) {
    glm::dvec3 low(1e30), high(-1e30);
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions) {
            const glm::dvec3 world(glm::dmat4(instance.transform) * glm::dvec4(p, 1.0));
            low = glm::min(low, world);
            high = glm::max(high, world);
        }
    const glm::dvec3 size = high - low;
    const glm::dvec3 along = size.x > size.z ? glm::dvec3(size.x, 0, 0) : glm::dvec3(0, 0, size.z);
    const glm::dvec3 from = low + glm::dvec3(0.5, 0.33, 0.5) * size - 0.25 * along;
    return {"inside", look_at(from, from + along), true, 1.0f};
}

/// A floor under a square lamp of two triangles, and nothing else.
Scene lamp_over_floor() {
    Scene scene;
    test::add_floor(scene, test::matt(glm::vec3(0.6f)));
    test::add_quad(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, test::lamp(glm::vec3(4.0f)));
    return scene;
}

/// The same far off on a wide floor, with a sun.
Scene lamp_and_sun() {
    Scene scene;
    test::add_quad(scene, {-100, 0, 100}, {200, 0, 0}, {0, 0, -200}, test::matt(glm::vec3(0.6f)));
    test::add_quad(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, test::lamp(glm::vec3(4.0f)));
    Light sun{"sun", LightKind::directional, glm::vec3(0.5f)};
    sun.direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f));
    scene.lights = {sun};
    return scene;
}

std::vector<Study> studies(const Settings& settings) {
    std::vector<Study> all;
    all.push_back({"lamp", lamp_over_floor(), {}, test::camera_above(2.0f, 1.5f)});
    all.push_back({"lamp and sun", lamp_and_sun(), {}, test::camera_above(4.0f, 1.5f)});
    Scene wood = make_procedural("forest");
    const Camera into_the_wood = wood.cameras.at(0);
    all.push_back({"wood", std::move(wood), default_sky(), into_the_wood});
    Scene cornell = test::cornell_scene();
    const Camera camera = cornell.cameras.at(0);
    all.push_back({"cornell", std::move(cornell), {}, camera});
    Scene open;
    test::add_floor(open, test::matt(glm::vec3(0.6f)));
    open.materials.push_back(test::metal({0.9f, 0.7f, 0.4f}, 0.3f));
    open.meshes.push_back(test::sphere_mesh(32, true));
    open.meshes.back().materials.assign(open.meshes.back().triangles.size(), 1);
    open.instances.push_back({"ball", 1, glm::translate(glm::mat4(1.0f), {0, 1, 0})});
    all.push_back({"sky", std::move(open), default_sky(), {"camera", look_at({0, 2, 5}, {0, 0.8, 0}), true, 0.7f}});
    if (!settings.interior.empty()) {
        Scene interior = load_gltf(settings.interior);
        const Camera view = interior.cameras.empty() ? inside_view(interior) : interior.cameras[0];
        all.push_back({"interior by day", interior, default_sky(), view});
        Light bulb;
        bulb.position = default_light(interior);
        bulb.intensity = glm::vec3(3.0f * glm::dot(bulb.position - eye(view), bulb.position - eye(view)));
        if (interior.lights.empty()) interior.lights.push_back(bulb);
        all.push_back({"interior", std::move(interior), default_sky(), view});
    }
    if (!settings.scenes.empty())
        std::erase_if(all, [&](const Study& study) {
            return std::find(settings.scenes.begin(), settings.scenes.end(), study.name) == settings.scenes.end();
        });
    return all;
}

/// Root of the mean square of the difference over pixels and channels, over the mean of the reference.
double relative_error(const test::Picture& picture, const test::Picture& reference) {
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < picture.direct.size(); ++i) {
        square += std::pow(picture.light(i) - reference.light(i), 2.0);
        sum += reference.light(i);
    }
    const double n = double(picture.direct.size());
    return std::sqrt(square / n) / (sum / n);
}

std::vector<Point> measure(Device& device, const test::LitScene& lit, const Study& study, const Contender& contender,
                           const Settings& settings, const test::Picture& reference) {
    const test::Frame frame{settings.across, settings.across};
    std::vector<Point> points;
    take_picture(device, lit, study.camera, frame, options_of(contender, 1, settings.depth, 1)); // compiles
    for (std::uint32_t samples = 1; samples <= settings.most_samples; samples *= 2) {
        // As many samples in all, so that rare bright ones are in each error as often.
        const std::uint32_t pictures = std::max(2 * settings.most_samples / samples, 2u);
        double square = 0.0;
        device.take_profile();
        for (std::uint32_t i = 0; i < pictures; ++i) {
            const LightOptions options = options_of(contender, samples, settings.depth, 100 * samples + i);
            square += std::pow(relative_error(take_picture(device, lit, study.camera, frame, options), reference), 2.0);
        }
        points.push_back({samples, std::sqrt(square / pictures), device.take_profile().total_ms() / pictures});
    }
    return points;
}

/// The share of each stage in a picture of more pixels.
json stage_shares(Device& device, const test::LitScene& lit, const Study& study, const Settings& settings) {
    const test::Frame frame{8 * settings.across, 8 * settings.across};
    const LightOptions options = options_of(contenders[0], 2, settings.depth, 7);
    take_picture(device, lit, study.camera, frame, options);
    device.take_profile();
    for (int round = 0; round < settings.rounds; ++round) take_picture(device, lit, study.camera, frame, options);
    const Profile profile = device.take_profile();
    json shares;
    std::printf("  %.3g Mpaths/s;",
                settings.rounds * 1e-3 * frame.width * frame.height * options.samples / profile.total_ms());
    double traced = 0.0;
    for (const PassTime& pass : profile.passes) {
        const bool trace = pass.label == "closest hit" || pass.label == "any hit";
        if (trace) traced += pass.ms;
        const std::string name = pass.stage.empty() ? pass.label : pass.stage + ": " + pass.label;
        shares[name] = pass.ms / profile.total_ms();
        std::printf(" %s %.1f %%,", name.c_str(), 100 * pass.ms / profile.total_ms());
    }
    std::printf(" traced %.1f %%\n", 100 * traced / profile.total_ms());
    shares["traced"] = traced / profile.total_ms();
    return shares;
}

json run_study(Device& device, const Study& study, const Settings& settings) {
    const test::LitScene lit(device, study.scene, study.around);
    std::printf("%s\n", study.name.c_str());
    json report{{"stages", stage_shares(device, lit, study, settings)}};
    if (settings.stages_only) return report;
    const test::Picture reference =
        take_picture(device, lit, study.camera, {settings.across, settings.across},
                     options_of(contenders[0], settings.reference_samples, settings.depth, 1'000'003));
    std::printf("  %-20s %8s %14s %14s %8s\n", "", "slope", "at 16 samples", "at equal time", "ms");
    std::optional<double> equal_ms;
    for (const Contender& contender : contenders) {
        if (settings.default_only && &contender != contenders) break;
        const std::vector<Point> points = measure(device, lit, study, contender, settings, reference);
        const Line by_samples = fit(points, [](const Point& p) { return double(p.samples); });
        const Line by_time = fit(points, [](const Point& p) { return p.ms; });
        json rows = json::array();
        double ms = 0.0;
        for (const Point& p : points) {
            rows.push_back({{"samples", p.samples}, {"error", p.error}, {"ms", p.ms}});
            if (p.samples == 16) ms = p.ms;
        }
        if (!equal_ms) equal_ms = ms;
        std::printf("  %-20s %8.3f %14.5f %14.5f %8.1f\n", contender.name, by_samples.slope, by_samples.at(16),
                    by_time.at(*equal_ms), ms);
        report["contenders"][contender.name] = {{"points", rows},
                                                {"slope", by_samples.slope},
                                                {"error_at_16_samples", by_samples.at(16)},
                                                {"error_at_equal_time", by_time.at(*equal_ms)}};
    }
    return report;
}

int run(int argc, char** argv) {
    CLI::App app("Measures the noise of light against samples and time.");
    Settings settings;
    std::string wanted;
    std::filesystem::path file;
    app.add_option("--device", wanted, "index of a device or a part of its name");
    app.add_option("--report", file, "JSON file to write");
    app.add_option("--interior", settings.interior,
                   "a glTF scene to add, under the default sky and, when it has no lights, so with a point light");
    app.add_option("--scenes", settings.scenes,
                   "of lamp, lamp and sun, wood, cornell, sky, interior by day, interior (default: all)")
        ->delimiter(',');
    app.add_flag("--default-only", settings.default_only, "sobol, cosine, mis alone");
    app.add_option("--across", settings.across, "pixels across a picture")->check(CLI::Range(1, 4096));
    app.add_option("--samples", settings.most_samples, "most samples of a pixel")->check(CLI::Range(16, 1 << 16));
    app.add_option("--reference", settings.reference_samples, "samples of the reference")
        ->check(CLI::Range(1, 1 << 20));
    app.add_option("--depth", settings.depth, "bounces")->check(CLI::Range(0, 64));
    app.add_flag("--stages", settings.stages_only, "the shares of the stages alone");
    app.add_option("--rounds", settings.rounds, "pictures over which the stages are timed")->check(CLI::Range(1, 1000));
    CLI11_PARSE(app, argc, argv);

    Device device(wanted);
    std::printf("device: %s; %u x %u pixels, depth %u\n", device.info().name.c_str(), settings.across, settings.across,
                settings.depth);
    json report{{"device", device.info().name}, {"across", settings.across}, {"depth", settings.depth}};
    for (const Study& study : studies(settings)) report["scenes"][study.name] = run_study(device, study, settings);
    if (file.empty()) return 0;
    AtomicFile out(file);
    out.stream() << report.dump(2) << '\n';
    out.commit();
    return 0;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-noise", [&] { return boxwood::run(argc, argv); });
}
