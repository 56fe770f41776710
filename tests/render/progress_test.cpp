// SPDX-License-Identifier: MIT
// Pictures that grow: batches, primary hits of either kind, states to go on from.
#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "boxwood/error.hpp"
#include "io/samples.hpp"
#include "render/two_squares.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

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
    Environment around = white();
    Camera camera = wide_camera();
    RenderOptions options;

    Painter(Integrator integrator, std::uint32_t samples) : options(options_of(integrator, {}, samples)) {
        for (const Aov aov : all_aovs())
            if (has(integrator, aov)) options.aovs.push_back(aov);
    }
    Render start() { return Render(device, scene, tree, around, camera, options); }
};

/// While it lives, a kernel file that does not compile.
class BrokenKernel {
public:
    explicit BrokenKernel(const std::string& file) {
        const std::filesystem::path target = folder_.path() / file;
        std::filesystem::create_directories(target.parent_path());
        write_bytes(target, "#error broken for a test\n");
        if (const char* set = std::getenv(variable)) before_ = set;
        ::setenv(variable, folder_.path().c_str(), 1);
    }
    ~BrokenKernel() {
        if (before_)
            ::setenv(variable, before_->c_str(), 1);
        else
            ::unsetenv(variable);
    }
    BrokenKernel(const BrokenKernel&) = delete;
    BrokenKernel& operator=(const BrokenKernel&) = delete;

private:
    static constexpr const char* variable = "BOXWOOD_KERNEL_DIR";
    TemporaryFolder folder_;
    std::optional<std::string> before_;
};

constexpr std::array some_integrators = {Integrator::path, Integrator::direct,  Integrator::ambient,
                                         Integrator::ao,   Integrator::normals, Integrator::cost};

} // namespace

TEST_CASE("progress: batches of any size give the same bytes") {
    for (const Integrator integrator : some_integrators) {
        if (small_sizes() && integrator == Integrator::direct) continue; // path's programs
        Painter painter(integrator, small_sizes() ? 1 : 3);
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

TEST_CASE("progress: the rasteriser's primary hits give the picture of rays, in batches too") {
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

TEST_CASE("progress: a picture grows to what render() gives, and goes on from a state bit by bit") {
    for (const Integrator integrator : some_integrators) {
        CAPTURE(name(integrator));
        if (small_sizes() && integrator == Integrator::direct) continue;
        const std::uint32_t samples = small_sizes() ? 3 : 5;
        Painter painter(integrator, samples);
        std::erase(painter.options.aovs, Aov::cost); // which the tree decides about
        const Image whole =
            render(painter.device, painter.scene, painter.tree, white(), wide_camera(), painter.options);
        Render work = painter.start();
        CHECK(work.samples() == 0);
        CHECK(plane<float>(work.image(), "R") == std::vector<float>(width * height, 0.0f));
        for (int i = 0; i < 2; ++i) work.advance();
        CHECK(std::get<std::int32_t>(work.image().attributes.at("samples")) == 2);
        const std::vector<std::byte> state = work.state();

        if (integrator != Integrator::cost) // no answer of the others depends on the tree
            painter.tree = build(painter.device, painter.scene, {.layout = Layout::binary});
        painter.options.batch = 100;
        Render other = painter.start();
        other.restore(state, "test");
        CHECK(other.samples() == 2);
        while (!other.done()) other.advance();
        other.advance(); // nothing is left to do
        CHECK(other.samples() == samples);
        CHECK(same_channels(other.image(), whole));
    }
}

TEST_CASE("progress: a sample that is broken off is taken for the rest of the pixels, and no state") {
    // Paths that leave the picture's top rows all meet nothing, those of later batches not: only these need the program
    // that is broken for a while.
    Painter painter(Integrator::path, 3);
    painter.options.light.strategy = Strategy::bsdf;
    painter.options.batch = 2 * width;
    painter.options.aovs = {Aov::samples, Aov::variance};
    const Image whole = render(painter.device, painter.scene, painter.tree, white(), wide_camera(), painter.options);

    Device device(std::to_string(test_device().info().index)); // without any program yet
    const Tree tree = build(device, painter.scene);
    Render work(device, painter.scene, tree, white(), wide_camera(), painter.options);
    {
        const BrokenKernel broken("render/path_queue.cl");
        for (int i = 0; i < 2; ++i) CHECK_THROWS_AS(work.advance(), ProgramError);
        CHECK(work.samples() == 0);
        CHECK(work.rejected_samples() == 0);
        const std::vector<std::uint32_t> counts = plane<std::uint32_t>(work.image(), "samples.N");
        CHECK(counts.front() == 1); // or nothing would be tested
        CHECK(counts.back() == 0);
        CHECK_THROWS_AS(work.state(), Error);
    }
    while (!work.done()) work.advance();
    CHECK(work.rejected_samples() == 0);
    CHECK(same_channels(work.image(), whole));
}

TEST_CASE("progress: one that was moved from says so, and can be assigned to") {
    Painter painter(Integrator::normals, 2);
    Render work = painter.start();
    work.advance();
    Render other = std::move(work);
    CHECK(other.samples() == 1);
    CHECK_THROWS_AS(work.advance(), Error);
    CHECK_THROWS_AS(work.samples(), Error);
    CHECK_THROWS_AS(work.done(), Error);
    CHECK_THROWS_AS(work.warnings(), Error);
    CHECK_THROWS_AS(work.image(), Error);
    CHECK_THROWS_AS(work.rejected_samples(), Error);
    CHECK_THROWS_AS(work.state(), Error);
    CHECK_THROWS_AS(work.restore(other.state(), "test"), Error);
    work = std::move(other);
    CHECK(work.samples() == 1);
}

TEST_CASE("progress: a state of something else, or a damaged one, is refused") {
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
    CHECK(differs([](Painter& other) { other.options.light.depth = 5; }));
    CHECK(differs([](Painter& other) { other.options.light.primary = Primary::raster; }));
    CHECK(differs([](Painter& other) { other.options.light.sampler = SamplerKind::random; }));
    CHECK(differs([](Painter& other) { other.options.light.strategy = Strategy::bsdf; }));
    CHECK(differs([](Painter& other) { other.options.light.hemisphere = Hemisphere::uniform; }));
    CHECK(differs([](Painter& other) { other.options.light.filter = TextureFilter::nearest; }));
    CHECK(differs([](Painter& other) { other.options.ao_distance = 2.0f; }));
    CHECK(differs([](Painter& other) { other.options.width += 1; }));
    CHECK(differs([](Painter& other) { std::swap(other.options.width, other.options.height); }));
    CHECK(differs([](Painter& other) { other.around.radiance.b = 0.5f; }));
    CHECK(differs([](Painter& other) { other.around = {glm::vec3(0.0f), 1, 1, {glm::vec3(1.0f)}}; }));
    CHECK(differs([](Painter& other) { other.around.rotation = 1.0f; }));
    CHECK(differs([](Painter& other) { other.camera.to_world[3].z = 0.25f; }));
    CHECK(differs([](Painter& other) { other.camera.vertical_fov = 1.1f; }));
    CHECK(differs([](Painter& other) { other.camera.perspective = false; }));
    CHECK(differs([](Painter& other) { other.scene.lights.emplace_back(); }));
    CHECK(differs([](Painter& other) { other.scene.instances[1].transform[3].y = 0.5f; }));
    CHECK(differs([](Painter& other) { other.options.light.integrator = Integrator::cost; }));
    CHECK(differs([](Painter& other) { other.scene.meshes[0].positions[0].x -= 0.5f; }));
    CHECK(differs([](Painter& other) { other.scene.materials[1].base_color.x = 0.5f; }));
}

TEST_CASE("progress: a state of costs is refused with any other tree") {
    Painter painter(Integrator::cost, 4);
    Render work = painter.start();
    work.advance();
    const std::vector<std::byte> state = work.state();
    const auto refused = [&](const BuildOptions& options) {
        painter.tree = build(painter.device, painter.scene, options);
        Render other = painter.start();
        try {
            other.restore(state, "a.resume");
        } catch (const InputError&) {
            return true;
        }
        return false;
    };
    CHECK_FALSE(refused({}));
    CHECK(refused({.layout = Layout::binary}));
    CHECK(refused({.levels = Levels::two}));
    CHECK(refused({.layout = Layout::binary, .bounds = {.kind = Bounds::obb_moments}}));
}

TEST_SUITE_END();
