// SPDX-License-Identifier: MIT
#include "boxwood/render.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include <glm/gtc/constants.hpp>

#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "render/aovs.hpp"
#include "render/checkpoint.hpp"
#include "render/environment.hpp"
#include "render/film.hpp"
#include "render/integrators.hpp"
#include "render/jitter.hpp"
#include "scene/validate_camera.hpp"

namespace boxwood {

namespace {

void check_range(const char* option, std::uint64_t value, std::uint64_t least, std::uint64_t most) {
    if (value < least || value > most)
        throw InputError("render", option,
                         std::to_string(value) + " is out of range: " + std::to_string(least) + " to " +
                             std::to_string(most));
}

void check_options(const RenderOptions& options) {
    check_range("width", options.width, 1, 1u << 23);
    check_range("height", options.height, 1, 1u << 23);
    check_range("samples", options.light.samples, 1, 1u << 20);
    check_range("depth", options.light.depth, 0, 64);
    check_range("batch", options.batch, 1, ~0u);
    if (!(options.ao_distance >= 0.0f && std::isfinite(options.ao_distance)))
        throw InputError("render", "ao_distance", std::to_string(options.ao_distance) + " is not a distance");
    for (const Aov aov : options.aovs)
        if (!has(options.light.integrator, aov))
            throw InputError("render", "aovs",
                             "the integrator " + std::string(name(options.light.integrator)) + " has no channels \"" +
                                 std::string(name(aov)) + "\"");
}

/// Adds three planes as "R", "G", "B" of a layer.
void add_color(const std::string& layer, const std::vector<float>* planes, Image& image) {
    for (int c = 0; c < 3; ++c) image.channels.push_back({layer + "RGB"[c], planes[c]});
}

/// What is seen: the sum of the parts of the light.
std::vector<std::vector<float>> beauty_of(FilmParts parts, const std::vector<std::vector<float>>& means) {
    std::vector<std::vector<float>> planes(means.begin(), means.begin() + 3);
    for (std::uint32_t k = 3; k < 3 * parts.lights; ++k)
        for (std::size_t i = 0; i < planes[0].size(); ++i) planes[k % 3][i] += means[k][i];
    return planes;
}

void add_light_channel(Aov aov, FilmParts parts, const std::vector<float>& film,
                       const std::vector<std::vector<float>>& means, Image& image) {
    if (aov == Aov::direct) add_color("direct.", &means[0], image);
    if (aov == Aov::indirect) add_color("indirect.", &means[3], image);
    if (aov == Aov::ambient) add_color("ambient.", &means[6], image);
    if (aov == Aov::ao) image.channels.push_back({"ao.A", means.back()});
    if (aov == Aov::variance) image.channels.push_back({"variance.Y", film_variance(parts, means[0].size(), film)});
    if (aov == Aov::samples) image.channels.push_back({"samples.N", film_samples(parts, means[0].size(), film)});
}

/// "none", "constant R,G,B", "picture WxH" or "picture WxH turned by RADIANS".
std::string describe(const Environment& environment) {
    char text[64];
    if (environment.width > 0) {
        const std::string size = std::to_string(environment.width) + "x" + std::to_string(environment.height);
        if (environment.rotation == 0.0f) return "picture " + size;
        std::snprintf(text, sizeof text, " turned by %.9g", double{environment.rotation});
        return "picture " + size + text;
    }
    if (environment.radiance == glm::vec3(0.0f)) return "none";
    std::snprintf(text, sizeof text, "constant %.9g,%.9g,%.9g", double{environment.radiance.x},
                  double{environment.radiance.y}, double{environment.radiance.z});
    return text;
}

std::string describe(const Tree& tree) {
    std::string words;
    for (const std::string_view word : {name(tree.layout()), name(tree.levels()), name(tree.bounds())})
        words += (words.empty() ? "" : ", ") + std::string(word);
    return words;
}

void add_attributes(const RenderOptions& options, const Camera& camera, const std::string& environment,
                    std::uint32_t samples, Image& image) {
    const LightOptions& light = options.light;
    auto& attributes = image.attributes;
    attributes["boxwood"] = std::string(BOXWOOD_VERSION);
    attributes["integrator"] = std::string(name(light.integrator));
    attributes["primary"] = std::string(name(light.primary));
    attributes["sampler"] = std::string(name(light.sampler));
    attributes["strategy"] = std::string(name(light.strategy));
    attributes["hemisphere"] = std::string(name(light.hemisphere));
    attributes["intersector"] = std::string(name(light.trace.intersector));
    attributes["filter"] = std::string(name(light.filter));
    attributes["seed"] = std::to_string(light.seed); // 64 bits
    attributes["samples"] = static_cast<std::int32_t>(samples);
    attributes["plannedSamples"] = static_cast<std::int32_t>(light.samples); // which places them
    attributes["depth"] = static_cast<std::int32_t>(light.depth);
    if (has(light.integrator, Aov::ao)) attributes["aoDistance"] = options.ao_distance;
    attributes["environment"] = environment;
    attributes["camera"] = camera.name;
    attributes["worldToCamera"] = glm::mat4(glm::inverse(glm::dmat4(camera.to_world)));
    if (camera.perspective)
        attributes["verticalFieldOfView"] = static_cast<float>(double{camera.vertical_fov} * 180.0 / glm::pi<double>());
    else
        attributes["halfHeight"] = camera.half_height;
}

} // namespace

struct Render::State {
    Device& device;
    const Scene& scene;
    const Tree& tree;
    Camera camera;
    RenderOptions options;
    FilmParts parts;
    std::vector<Aov> aovs;
    Buffer<float> film;
    std::uint32_t samples = 0;
    std::uint32_t ahead = 0; ///< Pixels, from the first, that have one sample more.
    Geometry geometry;
    std::vector<std::string> warnings;
    Appearance appearance;
    EnvironmentMap environment;
    std::string environment_words;
    AmbientLight ambient;                 ///< Of Integrator::ambient only.
    std::optional<Rasteriser> rasteriser; ///< Of Primary::raster only.
    mutable std::optional<std::uint64_t> fingerprint;

    State(Device& on, const Scene& of, const Tree& built, const Environment& around, const Camera& by,
          const RenderOptions& with)
        : device(on), scene(of), tree(built), camera(by), options(with), parts(film_parts(with.light.integrator)),
          aovs(without_repetition(with.aovs)), film(make_film(on, parts, std::size_t{with.width} * with.height)),
          geometry(upload(on, of)), appearance(upload_appearance(on, of, shading_requirements(of), warnings)),
          environment(upload_environment(on, around)), environment_words(describe(around)) {
        if (options.light.integrator == Integrator::ambient) ambient = make_ambient_light(on, appearance, around);
        if (options.light.primary == Primary::raster) rasteriser.emplace(on, scene, tree, geometry);
        if (options.light.integrator == Integrator::direct) options.light.depth = std::min(options.light.depth, 1u);
        if (options.ao_distance == 0.0f) options.ao_distance = default_ao_distance(scene);
    }

    std::uint32_t pixels() const { return options.width * options.height; }
    World world() const { return {tree, geometry, appearance, environment}; }
    std::uint64_t identity() const {
        if (!fingerprint) fingerprint = render_fingerprint(device, world(), camera, options);
        return *fingerprint;
    }
};

Render::Render(Device& device, const Scene& scene, const Tree& tree, const Environment& environment,
               const Camera& camera, const RenderOptions& options) {
    check_options(options);
    validate_camera(camera, "render", "camera.");
    check_film(device, options);
    validate(scene, "render");
    state_ = std::make_unique<State>(device, scene, tree, environment, camera, options);
}

Render::~Render() = default;
Render::Render(Render&&) noexcept = default;
Render& Render::operator=(Render&&) noexcept = default;

Render::State& Render::held() const {
    if (!state_) throw Error("render: a Render that was moved from has no picture");
    return *state_;
}

void Render::advance() {
    if (done()) return;
    State& state = held();
    const Stage stage(state.device, "render");
    const std::uint32_t pixels = state.pixels(), most = std::min(state.options.batch, pixels);
    const Buffer<CameraRecord> camera =
        upload_camera(state.device, state.camera, state.options.width, state.options.height,
                      camera_jitter(state.options.light, state.samples));
    const Scenery scenery{state.world(), state.ambient, state.rasteriser ? &*state.rasteriser : nullptr};
    SampleBuffers buffers = make_sample_buffers(state.device, state.parts, most);
    for (std::uint32_t count = 0; state.ahead < pixels; state.ahead += count) {
        count = std::min(most, pixels - state.ahead);
        const FilmSample sample =
            take_sample(state.device, scenery, state.options, state.samples, {camera, state.ahead, count}, buffers);
        add_sample(state.device, state.parts, sample, state.film);
    }
    state.ahead = 0;
    ++state.samples;
}

const std::vector<std::string>& Render::warnings() const { return held().warnings; }

std::uint32_t Render::samples() const { return held().samples; }

bool Render::done() const { return held().samples >= held().options.light.samples; }

Image Render::image() const {
    const State& state = held();
    Image image{state.options.width, state.options.height, {}};
    {
        const std::vector<float> film = download(state.device, state.film);
        const std::vector<std::vector<float>> means = film_means(state.parts, state.pixels(), film);
        add_color("", beauty_of(state.parts, means).data(), image);
        for (const Aov aov : state.aovs) add_light_channel(aov, state.parts, film, means, image);
    }
    add_centre_channels(state.device, state.scene, state.world(), state.camera, state.options, state.aovs, image);
    add_attributes(state.options, state.camera, state.environment_words, state.samples, image);
    const bool costs = state.options.light.integrator == Integrator::cost ||
                       std::find(state.aovs.begin(), state.aovs.end(), Aov::cost) != state.aovs.end();
    if (costs) image.attributes["tree"] = describe(state.tree);
    return image;
}

std::uint64_t Render::rejected_samples() const {
    const State& state = held();
    const std::vector<float> film = download(state.device, state.film);
    std::uint64_t kept = 0;
    for (const std::uint32_t count : film_samples(state.parts, state.pixels(), film)) kept += count;
    return std::uint64_t{state.pixels()} * state.samples + state.ahead - kept;
}

std::vector<std::byte> Render::state() const {
    const State& state = held();
    if (state.ahead != 0) throw Error("render: a sample was broken off; its pixels are no state to go on from");
    return encode_checkpoint({state.samples, download(state.device, state.film)}, state.identity());
}

void Render::restore(std::span<const std::byte> bytes, std::string_view file) {
    State& state = held();
    const Checkpoint checkpoint =
        decode_checkpoint(bytes, state.identity(), state.film.size(), state.options.light.samples, file);
    write(state.device, std::span<const float>(checkpoint.film), state.film.view());
    state.samples = checkpoint.samples;
    state.ahead = 0;
}

Image render(Device& device, const Scene& scene, const Tree& tree, const Environment& environment, const Camera& camera,
             const RenderOptions& options) {
    Render work(device, scene, tree, environment, camera, options);
    while (!work.done()) work.advance();
    return work.image();
}

} // namespace boxwood
