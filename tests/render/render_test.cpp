// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/render.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

// Odd, so that a pixel lies in the middle, and small.
constexpr std::uint32_t width = 33, height = 21;

/// Two squares before a camera at the origin: instance 0 faces it from the left half of z = -3; instance 1, mirrored
/// and stretched, is tilted and covers a part of the right half. Miss around them.
Scene two_squares(float scale) {
    Scene scene;
    scene.meshes.push_back({"square", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    const glm::mat4 world = glm::scale(glm::mat4(1.0f), glm::vec3(scale));
    const glm::mat4 left = glm::translate(glm::mat4(1.0f), glm::vec3(-1.25f, 0, -3));
    glm::mat4 right = glm::translate(glm::mat4(1.0f), glm::vec3(1.25f, 0, -4));
    right = glm::scale(right, glm::vec3(1, 1, 0.25f)); // after the turn: what tells the inverse transpose apart
    right = glm::rotate(right, 0.75f, glm::vec3(0, 1, 0));
    right = glm::scale(right, glm::vec3(-1, 1, 1));
    scene.meshes.push_back(scene.meshes[0]);
    scene.materials.resize(2); // the first is not used
    scene.materials[1].base_color = {0.25f, 0.5f, 0.75f, 1.0f};
    scene.meshes[1].materials = {1, BOXWOOD_NONE};
    scene.instances.push_back({"left", 0, world * left});
    scene.instances.push_back({"right", 1, world * right});
    return scene;
}

Camera wide_camera() {
    Camera camera;
    camera.vertical_fov = 1.2f;
    return camera;
}

/// AOVs of the pixels' centres, which every integrator has.
std::vector<Aov> centre_aovs() {
    return {Aov::depth,    Aov::normal,    Aov::position, Aov::albedo,
            Aov::instance, Aov::primitive, Aov::material, Aov::cost};
}

RenderOptions options_of(Integrator integrator, const std::vector<Aov>& aovs, std::uint32_t samples = 1) {
    RenderOptions options;
    options.light.integrator = integrator;
    options.light.samples = samples;
    options.width = width;
    options.height = height;
    options.aovs = aovs;
    return options;
}

Image picture(const Scene& scene, const std::vector<Aov>& aovs, const BuildOptions& options = {}) {
    Device& device = test_device();
    return render(device, scene, build(device, scene, options), {}, wide_camera(),
                  options_of(Integrator::normals, aovs));
}

template <class T>
const std::vector<T>& plane(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return std::get<std::vector<T>>(channel.samples);
    throw std::runtime_error("no channel " + name);
}

bool contains(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return true;
    return false;
}

glm::vec3 vector_at(const Image& image, const std::string& layer, std::string_view parts, std::size_t i) {
    glm::vec3 v;
    for (int c = 0; c < 3; ++c) v[c] = plane<float>(image, layer + parts[static_cast<std::size_t>(c)])[i];
    return v;
}

/// The same channels with the same bits.
bool same_channels(const Image& a, const Image& b) {
    if (a.channels.size() != b.channels.size()) return false;
    for (std::size_t c = 0; c < a.channels.size(); ++c) {
        if (a.channels[c].name != b.channels[c].name) return false;
        const bool same = std::visit(
            [&](const auto& samples) {
                using Samples = std::decay_t<decltype(samples)>;
                const auto* other = std::get_if<Samples>(&b.channels[c].samples);
                return other && same_bits(samples, *other);
            },
            a.channels[c].samples);
        if (!same) return false;
    }
    return true;
}

struct Expected {
    double t = std::numeric_limits<double>::infinity();
    glm::dvec3 normal{0.0};
    std::uint32_t instance = BOXWOOD_NONE;
    std::uint32_t primitive = BOXWOOD_NONE;
    bool near_edge = false; ///< Where rounding may decide.
};

/// The square met by the ray from the origin along `direction`, in double, by intersecting its plane.
Expected intersect(const Scene& scene, const glm::dvec3& direction) {
    Expected best;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const glm::dmat4 inverse = glm::inverse(glm::dmat4(scene.instances[i].transform));
        const glm::dvec3 o(inverse * glm::dvec4(0, 0, 0, 1)), d(inverse * glm::dvec4(direction, 0));
        const double t = -o.z / d.z;
        const glm::dvec3 p = o + t * d;
        const double outside = std::max(std::abs(p.x), std::abs(p.y)) - 1.0;
        if (std::abs(outside) < 1e-4 || std::abs(p.x - p.y) < 1e-4) best.near_edge = true;
        if (outside > 0.0 || t <= 0.0 || t >= best.t) continue;
        best.t = t;
        best.instance = i;
        best.primitive = p.x > p.y ? 0 : 1;
        const glm::dvec3 n = glm::normalize(glm::dvec3(glm::transpose(inverse) * glm::dvec4(0, 0, 1, 0)));
        best.normal = glm::dot(n, direction) > 0.0 ? -n : n;
    }
    return best;
}

glm::dvec3 pixel_direction(std::uint32_t x, std::uint32_t y) {
    const double tangent = std::tan(0.5 * double(1.2f));
    return glm::normalize(glm::dvec3((2.0 * (x + 0.5) / width - 1.0) * tangent * width / height,
                                     (1.0 - 2.0 * (y + 0.5) / height) * tangent, -1.0));
}

} // namespace

TEST_CASE("render: every channel holds what its pixel's ray meets") {
    const Scene scene = two_squares(1.0f);
    for (const Levels levels : {Levels::one, Levels::two}) {
        for (const Bounds bounds : {Bounds::aabb, Bounds::obb_points}) {
            const Image image = picture(scene, centre_aovs(), {.levels = levels, .bounds = {.kind = bounds}});
            CHECK(image.channels.size() == 3 + 1 + 3 + 3 + 3 + 1 + 1 + 1 + 2);
            std::size_t seen[3] = {};
            for (std::uint32_t i = 0; i < width * height; ++i) {
                CAPTURE(i);
                const Expected expected = intersect(scene, pixel_direction(i % width, i / width));
                if (expected.near_edge) continue;
                const std::uint32_t instance = plane<std::uint32_t>(image, "instance.id")[i];
                REQUIRE(instance == expected.instance);
                ++seen[std::min(instance, 2u)];
                CHECK(plane<std::uint32_t>(image, "primitive.id")[i] == expected.primitive);
                const glm::dvec3 normal(plane<float>(image, "normal.X")[i], plane<float>(image, "normal.Y")[i],
                                        plane<float>(image, "normal.Z")[i]);
                CHECK(glm::length(normal - expected.normal) < 1e-5);
                const float depth = plane<float>(image, "depth.Z")[i];
                const glm::vec3 albedo = vector_at(image, "albedo.", "RGB", i);
                const glm::vec3 position = vector_at(image, "position.", "XYZ", i);
                const std::uint32_t material = plane<std::uint32_t>(image, "material.id")[i];
                const glm::vec3 shown = vector_at(image, "", "RGB", i);
                if (instance == BOXWOOD_NONE) {
                    CHECK(depth == std::numeric_limits<float>::infinity());
                    CHECK(material == BOXWOOD_NONE);
                    CHECK((albedo == glm::vec3(0.0f) && position == glm::vec3(0.0f) && shown == glm::vec3(0.0f)));
                } else {
                    CHECK(std::abs(depth - expected.t) < 1e-5 * expected.t);
                    CHECK(plane<std::uint32_t>(image, "cost.primitives")[i] >= 1);
                    const glm::dvec3 point = expected.t * pixel_direction(i % width, i / width);
                    CHECK(glm::length(glm::dvec3(position) - point) < 1e-5 * expected.t);
                    const bool plain = instance == 0 || expected.primitive == 1;
                    CHECK(material == (plain ? 2 : 1)); // the plain one comes after those of the scene
                    CHECK(albedo == (plain ? glm::vec3(plain_material().base_color) : glm::vec3(0.25f, 0.5f, 0.75f)));
                    CHECK(glm::length(glm::dvec3(shown) - (0.5 + 0.5 * expected.normal)) < 1e-5);
                }
            }
            // Enough of each kind to mean something.
            for (const std::size_t count : seen) CHECK(count > 30);
        }
    }
}

TEST_CASE("render: costs are the statistics of the same rays") {
    Device& device = test_device();
    const Scene scene = two_squares(1.0f);
    for (const Bounds bounds : {Bounds::aabb, Bounds::obb_moments}) {
        const Tree tree = build(device, scene, {.bounds = {.kind = bounds}});
        const Image image = render(device, scene, tree, {}, wide_camera(), options_of(Integrator::cost, {Aov::cost}));
        const Buffer<Ray> rays = make_buffer<Ray>(device, width * height, "rays");
        const Buffer<Hit> hits = make_buffer<Hit>(device, width * height, "hits");
        const Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, width * height, "statistics");
        primary_rays(device, wide_camera(), width, height, rays);
        closest_hit(device, tree, rays, hits, statistics);
        const std::vector<RayStatistics> expected = download(device, statistics);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            CHECK(plane<std::uint32_t>(image, "cost.volumes")[i] == expected[i].volumes);
            CHECK(plane<std::uint32_t>(image, "cost.primitives")[i] == expected[i].primitives);
            CHECK(vector_at(image, "", "RGB", i) == glm::vec3(static_cast<float>(expected[i].volumes)));
        }
    }
}

TEST_CASE("render: only what is asked for is there, once, and the header says how it was made") {
    const Scene scene = two_squares(1.0f);
    const Image plain = picture(scene, {});
    CHECK(plain.channels.size() == 3);
    const Image repeated = picture(scene, {Aov::depth, Aov::depth});
    CHECK(repeated.channels.size() == 4);
    CHECK(contains(repeated, "depth.Z"));
    CHECK_FALSE(contains(repeated, "cost.volumes"));
    CHECK(std::get<std::string>(plain.attributes.at("integrator")) == "normals");
    CHECK(std::get<std::string>(plain.attributes.at("seed")) == "1");
    CHECK(std::get<std::int32_t>(plain.attributes.at("samples")) == 1);
    CHECK(std::get<float>(plain.attributes.at("verticalFieldOfView")) == doctest::Approx(1.2 * 180 / 3.14159265));
    CHECK(std::get<glm::mat4>(plain.attributes.at("worldToCamera")) == glm::mat4(1.0f));
}

TEST_CASE("render: an empty scene renders nothing, and no NaN") {
    const Image image = picture(Scene{}, centre_aovs());
    for (std::uint32_t i = 0; i < width * height; ++i) {
        REQUIRE(plane<std::uint32_t>(image, "instance.id")[i] == BOXWOOD_NONE);
        REQUIRE(plane<float>(image, "depth.Z")[i] == std::numeric_limits<float>::infinity());
        REQUIRE(plane<std::uint32_t>(image, "cost.volumes")[i] == 0);
        REQUIRE(plane<float>(image, "B")[i] == 0.0f);
    }
}

TEST_CASE("render: a scene scaled by a power of two gives the same picture, its distances scaled") {
    const Image image = picture(two_squares(1.0f), centre_aovs());
    for (const int k : {-30, 30}) {
        const float scale = std::ldexp(1.0f, k);
        const Image scaled = picture(two_squares(scale), centre_aovs());
        for (std::size_t c = 0; c < image.channels.size(); ++c) {
            const std::string& channel = image.channels[c].name;
            CAPTURE(channel);
            if (channel != "depth.Z" && !channel.starts_with("position")) {
                CHECK(scaled.channels[c].samples == image.channels[c].samples);
                continue;
            }
            const auto &values = plane<float>(image, channel), &scaled_values = plane<float>(scaled, channel);
            for (std::size_t i = 0; i < values.size(); ++i) CHECK(scaled_values[i] == scale * values[i]);
        }
    }
}

TEST_CASE("render: words and options are checked") {
    for (const Aov aov : all_aovs()) CHECK(to_aov(name(aov)) == aov);
    CHECK_THROWS_AS(to_aov("beauty"), InputError);
    Device& device = test_device();
    const Scene scene;
    const Tree tree = build(device, scene);
    const auto refused = [&](const auto& change) {
        RenderOptions options = options_of(Integrator::normals, {});
        change(options);
        try {
            Render(device, scene, tree, {}, Camera{}, options);
        } catch (const InputError& error) {
            return error.where;
        }
        return std::string("accepted");
    };
    CHECK(refused([](RenderOptions& options) { options.width = 0; }) == "width");
    CHECK(refused([](RenderOptions& options) { options.height = (1u << 23) + 1; }) == "height");
    CHECK(refused([](RenderOptions& options) { options.light.samples = 0; }) == "samples");
    CHECK(refused([](RenderOptions& options) { options.light.samples = (1u << 20) + 1; }) == "samples");
    CHECK(refused([](RenderOptions& options) { options.light.depth = 65; }) == "depth");
    CHECK(refused([](RenderOptions& options) { options.batch = 0; }) == "batch");
    CHECK(refused([](RenderOptions& options) { options.ao_distance = -1.0f; }) == "ao_distance");
    CHECK(refused([](RenderOptions& options) { options.ao_distance = std::nanf(""); }) == "ao_distance");
    CHECK(refused([](RenderOptions& options) { options.aovs = {Aov::indirect}; }) == "aovs");
    CHECK(refused([](RenderOptions&) {}) == "accepted");
    RenderOptions vast = options_of(Integrator::normals, {});
    vast.width = vast.height = 1u << 16;
    CHECK_THROWS_AS(Render(device, scene, tree, {}, Camera{}, vast), CapacityError);
}

TEST_CASE("render: the words of every option of light") {
    for (const char* word : {"path", "direct", "ambient", "ao", "normals", "cost"})
        CHECK(name(to_integrator(word)) == word);
    for (const char* word : {"rays", "raster"}) CHECK(name(to_primary(word)) == word);
    for (const char* word : {"sobol", "stratified", "random"}) CHECK(name(to_sampler(word)) == word);
    for (const char* word : {"mis", "lights", "bsdf"}) CHECK(name(to_strategy(word)) == word);
    for (const char* word : {"cosine", "uniform"}) CHECK(name(to_hemisphere(word)) == word);
    for (const char* word : {"anisotropic", "trilinear", "nearest"}) CHECK(name(to_filter(word)) == word);
    CHECK_THROWS_AS(to_integrator("bdpt"), InputError);
    CHECK(name(LightOptions{}.integrator) == "path");
}

namespace {

Environment white() {
    Environment environment;
    environment.radiance = glm::vec3(1.0f);
    return environment;
}

/// The pictures of an integrator on a small scene with every AOV it has.
struct Painter {
    Device& device = test_device();
    Scene scene = two_squares(1.0f);
    Tree tree = build(device, scene);
    RenderOptions options;

    Painter(Integrator integrator, std::uint32_t samples) : options(options_of(integrator, {}, samples)) {
        for (const Aov aov : all_aovs())
            if (has(integrator, aov)) options.aovs.push_back(aov);
    }
    Render start() { return Render(device, scene, tree, white(), wide_camera(), options); }
};

constexpr std::array some_integrators = {Integrator::path, Integrator::direct,  Integrator::ambient,
                                         Integrator::ao,   Integrator::normals, Integrator::cost};

} // namespace

TEST_CASE("render: batches of any size give the same bytes") {
    for (const Integrator integrator : some_integrators) {
        Painter painter(integrator, 3);
        const auto paint = [&painter] {
            Render work = painter.start();
            while (!work.done()) work.advance();
            CHECK(work.rejected_samples() == 0);
            return work.image();
        };
        const Image whole = paint();
        for (const std::uint32_t batch :
             {64u, 500u, width * height - 1}) { // two to eleven batches, the last one shorter
            painter.options.batch = batch;
            CHECK(same_channels(paint(), whole));
        }
    }
}

TEST_CASE("render: the rasteriser's primary hits give the picture of rays, in batches too") {
    for (const Integrator integrator : {Integrator::path, Integrator::normals}) {
        Painter painter(integrator, 4);
        const auto paint = [&painter] {
            Render work = painter.start();
            while (!work.done()) work.advance();
            return work.image();
        };
        const Image rays = paint();
        painter.options.light.primary = Primary::raster;
        const Image raster = paint();
        std::size_t differing = 0; // pixels with a sample on an edge within a rounding: a few at most
        for (std::size_t i = 0; i < width * height; ++i)
            if (vector_at(rays, "", "RGB", i) != vector_at(raster, "", "RGB", i)) ++differing;
        CHECK(differing <= 5);
        painter.options.batch = 100;
        CHECK(same_channels(paint(), raster));
    }
}

TEST_CASE("render: a picture grows to what render() gives, and goes on from a state bit by bit") {
    for (const Integrator integrator : some_integrators) {
        CAPTURE(name(integrator));
        Painter painter(integrator, 5);
        std::erase(painter.options.aovs, Aov::cost); // which the tree decides about
        const Image whole =
            render(painter.device, painter.scene, painter.tree, white(), wide_camera(), painter.options);
        Render work = painter.start();
        CHECK(work.samples() == 0);
        CHECK(plane<float>(work.image(), "R") == std::vector<float>(width * height, 0.0f));
        for (int i = 0; i < 2; ++i) work.advance();
        CHECK(std::get<std::int32_t>(work.image().attributes.at("samples")) == 2);
        const std::vector<std::byte> state = work.state();

        painter.tree = build(painter.device, painter.scene, {.layout = Layout::binary}); // answers do not depend on it
        painter.options.batch = 100;
        Render other = painter.start();
        other.restore(state, "test");
        CHECK(other.samples() == 2);
        while (!other.done()) other.advance();
        other.advance(); // nothing is left to do
        CHECK(other.samples() == 5);
        if (integrator != Integrator::cost) CHECK(same_channels(other.image(), whole));
    }
}

TEST_CASE("render: a state of something else, or a damaged one, is refused") {
    Painter painter(Integrator::normals, 4);
    Render work = painter.start();
    work.advance();
    const std::vector<std::byte> state = work.state();
    const auto refused = [&](Painter& other, std::vector<std::byte> bytes) {
        Render render = other.start();
        try {
            render.restore(bytes, "a.resume");
        } catch (const InputError& error) {
            CHECK(error.file == "a.resume");
            CHECK(render.samples() == 0);
            return true;
        }
        return false;
    };
    CHECK_FALSE(refused(painter, state));
    CHECK(refused(painter, {}));
    const std::size_t sizes[] = {1, 39, 40, 41, state.size() - 4, state.size() - 1};
    for (const std::size_t size : sizes) CHECK(refused(painter, {state.begin(), state.begin() + std::ptrdiff_t(size)}));
    std::vector<std::byte> longer = state;
    longer.resize(longer.size() + 4);
    CHECK(refused(painter, longer));
    for (std::size_t at = 0; at < 48; ++at) { // every byte of the header and the first of the film
        std::vector<std::byte> damaged = state;
        damaged[at] ^= std::byte{1};
        CHECK(refused(painter, damaged));
    }
    const auto differs = [&](const auto& change) {
        Painter other(Integrator::normals, 4);
        change(other);
        return refused(other, state);
    };
    CHECK_FALSE(differs([](Painter&) {}));
    CHECK(differs([](Painter& other) { other.options.light.seed = 2; }));
    CHECK(differs([](Painter& other) { other.options.light.samples = 8; }));
    CHECK(differs([](Painter& other) { other.options.width += 1; }));
    CHECK(differs([](Painter& other) { other.options.light.integrator = Integrator::cost; }));
    CHECK(differs([](Painter& other) { other.scene.meshes[0].positions[0].x -= 0.5f; }));
    CHECK(differs([](Painter& other) { other.scene.materials[1].base_color.x = 0.5f; }));
}

TEST_SUITE_END();
