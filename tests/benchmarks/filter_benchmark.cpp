// SPDX-License-Identifier: MIT
// boxwood-benchmark-filter: error and time of the texture filters (dissertation figure 8) against the mean of 256
// samples of each pixel, on a checkered plane up to the horizon and on the scenes given.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "benchmark.hpp"
#include "boxwood/build.hpp"
#include "boxwood/gbuffer.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/raster.hpp"
#include "boxwood/rays.hpp"
#include "common/median.hpp"
#include "render/camera.hpp"
#include "scene/picture.hpp"

namespace boxwood {
namespace {

struct Contender {
    const char* name;
    TextureFilter filter;
};

constexpr Contender contenders[] = {{"nearest", TextureFilter::nearest},
                                    {"trilinear, cone", TextureFilter::trilinear},
                                    {"anisotropic", TextureFilter::anisotropic}};

constexpr std::uint32_t reference_across = 16; // squared: samples of a pixel of the reference

struct Case {
    std::string name;
    Scene scene;
};

/// A plane of 200 x 200 units seen from 1.5 above it, its picture of 8 x 8 fields on each 2 x 2 units.
Case checkered_plane() {
    constexpr std::uint32_t across = 256, field = across / 8;
    std::vector<std::uint8_t> grey(across * across);
    for (std::uint32_t y = 0; y < across; ++y)
        for (std::uint32_t x = 0; x < across; ++x) grey[y * across + x] = (x / field + y / field) % 2 == 0 ? 30 : 230;
    Case made{"checkered plane", {}};
    Scene& scene = made.scene;
    scene.images.push_back({"checker", encode_png("checker", {across, across}, 1, grey)});
    scene.textures.push_back({0});
    Material material;
    material.base_color_texture.texture = 0;
    scene.materials.push_back(material);
    Mesh mesh{
        "plane", {{-100, 0, 100}, {100, 0, 100}, {100, 0, -100}, {-100, 0, -100}}, {{0, 1, 2}, {0, 2, 3}}, {0, 0}};
    mesh.uvs[0] = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"plane", 0, glm::mat4(1.0f)});
    Camera camera;
    // Turned, so that no column of fields runs along a column of pixels.
    camera.to_world = glm::rotate(glm::translate(glm::mat4(1.0f), {0.3f, 1.5f, 90.0f}), 0.35f, {0, 1, 0});
    camera.to_world = glm::rotate(camera.to_world, -0.25f, {1, 0, 0});
    scene.cameras.push_back(camera);
    return made;
}

/// A scene that is ready, and the picture to make of it.
class Studio {
public:
    Studio(Device& device, const Scene& scene, std::uint32_t size)
        : device_(device), camera_(scene.cameras.empty() ? default_camera(scene) : scene.cameras[0]), size_(size),
          tree_(build(device, scene)), geometry_(upload(device, scene)),
          appearance_(upload_appearance(device, scene, shading_requirements(scene), warnings_)),
          rasteriser_(device, scene, tree_, geometry_), rays_(make_buffer<Ray>(device, pixels(), "rays")),
          hits_(make_buffer<Hit>(device, pixels(), "hits")),
          albedo_(make_buffer<float>(device, 3 * pixels(), "albedo")) {}

    std::size_t pixels() const { return std::size_t{size_} * size_; }
    bool textured() const { return appearance_.requirements.textures; }
    std::vector<Hit> hits() const { return download(device_, hits_); }

    /// Base colours of one of `samples` samples; adds to `ms` the device time of reading them.
    std::vector<float> albedo(glm::vec2 jitter, TextureFilter filter, std::uint32_t samples, double& ms) {
        const Buffer<CameraRecord> record = upload_camera(device_, camera_, size_, size_, jitter);
        primary_rays(device_, record, 0, rays_);
        rasteriser_.draw(record, size_, size_, 0, rays_, hits_);
        device_.take_profile();
        GBuffer planes;
        planes.albedos = albedo_;
        g_buffer(device_, geometry_, appearance_, record, rays_, hits_, filter, samples, planes);
        std::vector<float> values = download(device_, albedo_);
        ms += device_.take_profile().total_ms();
        return values;
    }

private:
    Device& device_;
    Camera camera_;
    std::uint32_t size_;
    std::vector<std::string> warnings_;
    Tree tree_;
    Geometry geometry_;
    Appearance appearance_;
    Rasteriser rasteriser_;
    Buffer<Ray> rays_;
    Buffer<Hit> hits_;
    Buffer<float> albedo_;
};

using Picture64 = std::vector<double>;

/// The mean over across x across samples on a grid; `see` is told of each.
Picture64 mean_of(Studio& studio, TextureFilter filter, std::uint32_t across, double& ms,
                  const std::function<void(std::uint32_t, const std::vector<float>&)>& see = {}) {
    Picture64 mean(3 * studio.pixels(), 0.0);
    const auto place = [&](std::uint32_t i) {
        return (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(across) - 1.0f;
    };
    for (std::uint32_t i = 0; i < across * across; ++i) {
        const std::vector<float> one =
            studio.albedo({place(i % across), place(i / across)}, filter, across * across, ms);
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += one[k] / double(across * across);
        if (see) see(i, one);
    }
    return mean;
}

struct Reference {
    Picture64 mean;
    std::vector<bool> inside; ///< All samples of the pixel are on one triangle.
    double own_error = 0.0;   ///< From the difference of the halves of its samples, over the pixels inside.
};

double error_of(const Picture64& picture, const Picture64& reference, const std::vector<bool>& counted) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < counted.size(); ++i) {
        if (!counted[i]) continue;
        for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
            sum += (picture[k] - reference[k]) * (picture[k] - reference[k]);
        count += 3.0;
    }
    return count == 0.0 ? 0.0 : std::sqrt(sum / count);
}

Reference reference_of(Studio& studio) {
    Reference reference;
    reference.inside.assign(studio.pixels(), true);
    std::vector<Hit> first;
    Picture64 halves[2] = {Picture64(3 * studio.pixels(), 0.0), Picture64(3 * studio.pixels(), 0.0)};
    double ms = 0.0;
    reference.mean = mean_of(studio, TextureFilter::nearest, reference_across, ms,
                             [&](std::uint32_t i, const std::vector<float>& one) {
                                 const std::vector<Hit> hits = studio.hits();
                                 if (first.empty()) first = hits;
                                 for (std::size_t p = 0; p < hits.size(); ++p)
                                     if (hits[p].primitive == BOXWOOD_NONE || hits[p].primitive != first[p].primitive ||
                                         hits[p].instance != first[p].instance)
                                         reference.inside[p] = false;
                                 Picture64& half = halves[(i + i / reference_across) % 2];
                                 const double share = 2.0 / (reference_across * reference_across);
                                 for (std::size_t k = 0; k < one.size(); ++k) half[k] += one[k] * share;
                             });
    reference.own_error = 0.5 * error_of(halves[0], halves[1], reference.inside);
    return reference;
}

void study(Device& device, const Case& one, std::uint32_t size, int rounds, nlohmann::json& times,
           nlohmann::json& errors) {
    Studio studio(device, one.scene, size);
    const Reference reference = reference_of(studio);
    const std::vector<bool> all(studio.pixels(), true);
    const auto inside = std::count(reference.inside.begin(), reference.inside.end(), true);
    std::printf("%s%s: %.1f %% of the pixels within a triangle, where the reference is off by %.4f\n", one.name.c_str(),
                studio.textured() ? "" : " (no textures)", 100.0 * double(inside) / double(studio.pixels()),
                reference.own_error);
    std::printf("  %-16s %8s %12s %12s %12s\n", "filter", "samples", "rmse inside", "rmse of all", "ms a sample");
    for (const Contender& contender : contenders)
        for (const std::uint32_t across : {1u, 2u, 4u}) {
            Picture64 picture;
            std::vector<double> runs;
            for (int round = -1; round < rounds; ++round) {
                double ms = 0.0;
                picture = mean_of(studio, contender.filter, across, ms);
                if (round >= 0) runs.push_back(ms / (across * across)); // the first warms
            }
            const double within = error_of(picture, reference.mean, reference.inside);
            const double everywhere = error_of(picture, reference.mean, all);
            std::printf("  %-16s %8u %12.4f %12.4f %12.2f\n", contender.name, across * across, within, everywhere,
                        median(runs));
            const std::string samples = std::to_string(across * across);
            times[one.name][contender.name][samples] = median(runs);
            errors[one.name][contender.name][samples] = {{"inside", within}, {"all", everywhere}};
        }
    std::fflush(stdout);
}

int run(int argc, char** argv) {
    CLI::App app("Measures the texture filters: error against 256 nearest texels per pixel, and time.");
    benchmarks::Arguments arguments;
    std::vector<std::string> files;
    std::uint32_t size = 512;
    benchmarks::add_arguments(app, arguments);
    app.add_option("scenes", files, "glTF files beside the checkered plane");
    app.add_option("--size", size, "pixels across and down")->check(CLI::Range(1, 4096));
    CLI11_PARSE(app, argc, argv);

    Device device(arguments.device);
    std::printf("device: %s; %u x %u pixels\n", device.info().name.c_str(), size, size);
    std::vector<Case> cases{checkered_plane()};
    for (const std::string& file : files)
        cases.push_back({std::filesystem::path(file).stem().string(), load_gltf(file)});
    nlohmann::json times, errors;
    for (const Case& one : cases) study(device, one, size, arguments.rounds, times, errors);
    benchmarks::save_report(arguments, device.info(), times, errors);
    return 0;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-filter", [&] { return boxwood::run(argc, argv); });
}
