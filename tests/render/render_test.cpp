// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "path_picture.hpp"
#include "path_scenes.hpp"
#include "render/two_squares.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

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

TEST_CASE("render: the Cornell box is as bright by the rasteriser as by rays") {
    Device& device = test_device();
    const Scene scene = cornell_scene();
    const Tree tree = build(device, scene);
    const std::uint32_t repeats = small_sizes() ? 3 : 10;
    const auto estimate_by = [&](Primary primary, std::uint64_t seed) {
        RenderOptions options = options_of(Integrator::path, {}, small_sizes() ? 2 : 32);
        options.light.primary = primary;
        options.light.depth = small_sizes() ? 2 : 6;
        if (small_sizes()) options.width = options.height = 4;
        double sum = 0.0, square = 0.0;
        for (std::uint32_t r = 0; r < repeats; ++r) {
            options.light.seed = seed + r;
            const Image image = render(device, scene, tree, {}, scene.cameras[0], options);
            double mean = 0.0;
            for (const char* channel : {"R", "G", "B"})
                for (const float value : plane<float>(image, channel))
                    mean += double{value} / (3.0 * options.width * options.height);
            sum += mean / repeats;
            square += mean * mean / repeats;
        }
        return Estimate{sum, std::sqrt(std::max(square - sum * sum, 0.0) / (repeats - 1)), repeats};
    };
    // Other seeds: two independent estimates.
    const Estimate rays = estimate_by(Primary::rays, test_seed());
    const Estimate raster = estimate_by(Primary::raster, test_seed() + 1000);
    CHECK(std::abs(rays.mean - raster.mean) < 3 * std::hypot(rays.error, raster.error));
    if (!small_sizes()) CHECK(rays.error < 0.0066 * rays.mean); // so that 2 % are seen
}

TEST_CASE("render: costs are the statistics of the same rays") {
    Device& device = test_device();
    const Scene scene = two_squares(1.0f);
    for (const Bounds bounds : {Bounds::aabb, Bounds::obb_moments}) {
        const Tree tree = build(device, scene, {.bounds = {.kind = bounds}});
        const Image image = render(device, scene, tree, {}, wide_camera(), options_of(Integrator::cost, {Aov::cost}));
        Buffer<Ray> rays = make_buffer<Ray>(device, width * height, "rays");
        Buffer<Hit> hits = make_buffer<Hit>(device, width * height, "hits");
        Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, width * height, "statistics");
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

TEST_CASE("render: the header tells every option that decides about pixels") {
    Device& device = test_device();
    const Scene scene = two_squares(1.0f);
    const Tree tree = build(device, scene);
    const auto header = [&](const auto& change) {
        RenderOptions options = options_of(Integrator::ao, {}, 4);
        options.ao_distance = 1.5f;
        Environment around;
        Camera camera = wide_camera();
        change(options, around, camera);
        return Render(device, scene, tree, around, camera, options).image().attributes;
    };
    const auto plain = header([](RenderOptions&, Environment&, Camera&) {});
    CHECK(std::get<std::string>(plain.at("hemisphere")) == "cosine");
    CHECK(std::get<std::string>(plain.at("filter")) == "anisotropic");
    CHECK(std::get<std::string>(plain.at("environment")) == "none");
    CHECK(std::get<float>(plain.at("aoDistance")) == 1.5f);
    CHECK(std::get<std::int32_t>(plain.at("plannedSamples")) == 4);
    CHECK(std::get<std::int32_t>(plain.at("samples")) == 0);
    CHECK(std::get<std::int32_t>(plain.at("depth")) == 6);
    const auto differs = [&](const auto& change) { return header(change) != plain; };
    const auto light = [&](const auto& change) {
        return differs([&](RenderOptions& options, Environment&, Camera&) { change(options.light); });
    };
    CHECK(light([](LightOptions& l) { l.integrator = Integrator::path; }));
    CHECK(light([](LightOptions& l) { l.primary = Primary::raster; }));
    CHECK(light([](LightOptions& l) { l.sampler = SamplerKind::random; }));
    CHECK(light([](LightOptions& l) { l.strategy = Strategy::lights; }));
    CHECK(light([](LightOptions& l) { l.hemisphere = Hemisphere::uniform; }));
    CHECK(light([](LightOptions& l) { l.filter = TextureFilter::nearest; }));
    CHECK(light([](LightOptions& l) { l.samples = 5; }));
    CHECK(light([](LightOptions& l) { l.depth = 5; }));
    CHECK(light([](LightOptions& l) { l.seed = 1ull << 40; }));
    CHECK(differs([](RenderOptions& o, Environment&, Camera&) { o.ao_distance = 1.25f; }));
    CHECK(differs([](RenderOptions&, Environment& e, Camera&) { e.radiance.g = 0.5f; }));
    CHECK(differs([](RenderOptions&, Environment& e, Camera&) { e = {{}, 2, 1, {2, glm::vec3(1.0f)}}; }));
    CHECK(differs([](RenderOptions&, Environment&, Camera& c) { c.to_world[3].x = 1.0f; }));
    CHECK(differs([](RenderOptions&, Environment&, Camera& c) { c.vertical_fov = 1.25f; }));
    CHECK(differs([](RenderOptions&, Environment&, Camera& c) { c.perspective = false; }));
    const auto costs = header([](RenderOptions& o, Environment&, Camera&) { o.aovs = {Aov::cost}; });
    CHECK(std::get<std::string>(costs.at("tree")) == "wide8, one, aabb");
    CHECK(plain.find("tree") == plain.end());
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

TEST_CASE("render: a camera without a frame or a field of view is refused") {
    Device& device = test_device();
    const Scene scene;
    const Tree tree = build(device, scene);
    const auto refused = [&](const auto& change) {
        Camera camera;
        change(camera);
        CHECK_THROWS_AS(upload_camera(device, camera, 4, 4), InputError);
        try {
            Render(device, scene, tree, {}, camera, options_of(Integrator::normals, {}));
        } catch (const InputError& error) {
            return error.where;
        }
        return std::string("accepted");
    };
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    CHECK(refused([](Camera& camera) { camera.to_world[1] = {}; }) == "camera.to_world");
    CHECK(refused([&](Camera& camera) { camera.to_world[3][1] = nan; }) == "camera.to_world");
    for (const float angle : {0.0f, -1.0f, std::numbers::pi_v<float>, nan, infinity})
        CHECK(refused([&](Camera& camera) { camera.vertical_fov = angle; }) == "camera.vertical_fov");
    for (const float half : {0.0f, -1.0f, nan, infinity})
        CHECK(refused([&](Camera& camera) {
                  camera.perspective = false;
                  camera.half_height = half;
              }) == "camera.half_height");
}

TEST_CASE("render: a scene made by hand that breaks its promises is refused") {
    Device& device = test_device();
    const Scene scene = two_squares(1.0f);
    const Tree tree = build(device, scene);
    const auto refused = [&](const auto& change) {
        Scene broken = scene;
        change(broken);
        try {
            Render(device, broken, tree, {}, Camera{}, options_of(Integrator::path, {}));
        } catch (const InputError& error) {
            return error.where;
        }
        return std::string("accepted");
    };
    CHECK(refused([](Scene&) {}) == "accepted");
    CHECK(refused([](Scene& s) { s.meshes[1].materials[0] = 2; }).starts_with("meshes[1].materials"));
    CHECK(refused([](Scene& s) { s.meshes[1].materials.push_back(1); }).starts_with("meshes[1].materials"));
    CHECK(refused([](Scene& s) { s.meshes[0].colors.resize(3); }).starts_with("meshes[0].colors"));
    CHECK(refused([](Scene& s) { s.instances[0].mesh = 7; }) == "instances[0].mesh");
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

TEST_SUITE_END();
