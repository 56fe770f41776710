// SPDX-License-Identifier: MIT
// Planes of a G-buffer against double precision.
#include <doctest/doctest.h>
#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/gbuffer.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"
#include "render/appearance_scenes.hpp"
#include "render/gbuffer_oracle.hpp"
#include "scene/picture.hpp"
#include "support.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// All planes of a picture, on the host.
struct Planes {
    std::vector<float> positions, geometric_normals, shading_normals, albedos, depths, uv_derivatives;
    std::vector<std::uint32_t> materials, instances, primitives;
};

/// A scene with its primary hits.
struct Shot {
    Scene scene;
    Camera camera;
    std::uint32_t width, height;
    Geometry geometry;
    Appearance appearance;
    Buffer<CameraRecord> record;
    Buffer<Ray> rays;
    Buffer<Hit> hits;

    std::size_t pixels() const { return std::size_t{width} * height; }
};

Shot shoot(Scene scene, const Camera& camera, std::uint32_t width, std::uint32_t height) {
    Device& device = test_device();
    Shot shot{std::move(scene), camera, width, height, {}, {}, {}, {}, {}};
    std::vector<std::string> warnings;
    shot.geometry = upload(device, shot.scene);
    shot.appearance = upload_appearance(device, shot.scene, shading_requirements(shot.scene), warnings);
    CHECK(warnings.empty());
    shot.record = upload_camera(device, camera, width, height);
    shot.rays = make_buffer<Ray>(device, shot.pixels(), "rays");
    shot.hits = make_buffer<Hit>(device, shot.pixels(), "hits");
    primary_rays(device, camera, width, height, shot.rays);
    closest_hit(device, build(device, shot.scene), shot.rays, shot.hits);
    return shot;
}

/// The planes whose bits are set, in the order of GBuffer; every one guarded.
Planes planes_of(const Shot& shot, unsigned bits, TextureFilter filter) {
    Device& device = test_device();
    const std::size_t n = shot.pixels();
    const auto size = [&](unsigned bit, std::size_t components) { return bits & bit ? components * n : 0; };
    const Guarded<float> positions(device, size(1, 3)), geometric(device, size(2, 3)), shading(device, size(4, 3)),
        albedos(device, size(8, 3)), depths(device, size(16, 1)), derivatives(device, size(32, 4));
    const Guarded<std::uint32_t> materials(device, size(64, 1)), instances(device, size(128, 1)),
        primitives(device, size(256, 1));
    g_buffer(device, shot.geometry, shot.appearance, shot.record, shot.rays, shot.hits, filter, 1,
             {positions.view(), geometric.view(), shading.view(), albedos.view(), depths.view(), derivatives.view(),
              materials.view(), instances.view(), primitives.view()});
    CHECK((positions.intact() && geometric.intact() && shading.intact() && albedos.intact() && depths.intact()));
    CHECK((derivatives.intact() && materials.intact() && instances.intact() && primitives.intact()));
    return {positions.values(),   geometric.values(), shading.values(),   albedos.values(),   depths.values(),
            derivatives.values(), materials.values(), instances.values(), primitives.values()};
}

/// Meshes with all attributes, placed turned, mirrored and sheared, of materials with a picture of 4 x 4 for colour, of
/// which one also bends normals by the same everywhere.
Scene rich_scene(Random& random) {
    Scene scene = instanced_scene(random, 3, small_sizes() ? 3 : 9, small_sizes() ? 20 : 80);
    const auto unit_vector = [&] {
        return glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1f, 1)));
    };
    for (Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            mesh.normals.push_back(unit_vector());
            const glm::vec3 tangent = glm::normalize(glm::cross(mesh.normals[i], unit_vector()));
            // One handedness for a triangle, which is three vertices.
            mesh.tangents.emplace_back(tangent, i / 3 % 2 == 0 ? 1.0f : -1.0f);
            for (auto& uvs : mesh.uvs) uvs.emplace_back(random.uniform(-2, 3), random.uniform(-2, 3));
            mesh.colors.emplace_back(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1), 1.0f);
        }
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.materials.push_back(random.below(2));
    }
    std::vector<std::uint8_t> rgba(4 * texture_size * texture_size), bump(16);
    for (std::uint8_t& byte : rgba) byte = static_cast<std::uint8_t>(random.below(256));
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t c = 0; c < 4; ++c) bump[4 * i + c] = bump_texel[c];
    scene.images.push_back({"colour", encode_png("colour", {texture_size, texture_size}, 4, rgba)});
    scene.images.push_back({"bump", encode_png("bump", {2, 2}, 4, bump)});
    scene.textures = {{0, Wrap::repeat, Wrap::mirror}, {1}};
    Material plain, bumpy;
    plain.base_color = {0.9f, 0.8f, 0.7f, 1.0f};
    plain.base_color_texture = {0, 1, glm::mat3(2.0f, 0.5f, 0, -0.25f, 1, 0, 0.125f, 0.25f, 1)};
    bumpy.base_color_texture = {0, 0};
    bumpy.normal_texture = {1, 0};
    bumpy.normal_scale = 0.8f;
    scene.materials = {plain, bumpy};
    return scene;
}

Camera inside_camera(bool perspective) {
    Camera camera;
    camera.perspective = perspective;
    camera.half_height = 1.5f;
    camera.vertical_fov = 1.1f;
    camera.to_world = glm::translate(glm::mat4(1.0f), {0.1f, 0.2f, 2.0f});
    return camera;
}

double off(const std::vector<float>& plane, std::size_t pixel, const glm::dvec3& expected) {
    double most = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double d = std::fabs(plane[3 * pixel + c] - expected[c]);
        if (!(d <= most)) most = d;
    }
    return most;
}

} // namespace

TEST_CASE("gbuffer: planes are what double precision makes of the hits") {
    Random random(320);
    const std::uint32_t width = small_sizes() ? 16 : 96, height = small_sizes() ? 10 : 64;
    for (const bool perspective : {true, false}) {
        const Shot shot = shoot(rich_scene(random), inside_camera(perspective), width, height);
        const Planes planes = planes_of(shot, 511, TextureFilter::nearest);
        const std::vector<Ray> rays = download(test_device(), shot.rays);
        const std::vector<Hit> hits = download(test_device(), shot.hits);
        const CameraRecord camera = download_element(test_device(), shot.record, 0);
        const Picture picture = decode_picture(shot.scene.images[0]);
        std::size_t checked = 0, bent = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            REQUIRE(planes.instances[i] == hits[i].instance);
            REQUIRE(planes.primitives[i] == hits[i].primitive);
            REQUIRE(planes.depths[i] == hits[i].t);
            if (hits[i].primitive == BOXWOOD_NONE) {
                REQUIRE(planes.materials[i] == BOXWOOD_NONE);
                const glm::dvec3 zero(0.0);
                REQUIRE(off(planes.positions, i, zero) + off(planes.geometric_normals, i, zero) == 0.0);
                REQUIRE(off(planes.shading_normals, i, zero) + off(planes.albedos, i, zero) == 0.0);
                for (int c = 0; c < 4; ++c) REQUIRE(planes.uv_derivatives[4 * i + c] == 0.0f);
                continue;
            }
            const PixelOracle oracle(shot.scene, rays[i], hits[i]);
            REQUIRE(planes.materials[i] == oracle.mesh.materials[hits[i].primitive]);
            // Some 8 roundings of what meets in each number, times what the triangle, its place and the ray make of
            // them.
            constexpr double rounding = 8 * 0x1p-24;
            double growth = 0.0, magnitude = 0.0;
            REQUIRE(off(planes.positions, i, oracle.position()) <= rounding * oracle.magnitude());
            REQUIRE(off(planes.geometric_normals, i, oracle.normal) <= rounding * oracle.slant());
            // Normals away from the eye are bent back; those across the triangle may turn either way.
            const glm::dvec3 shading = oracle.shading_normal(growth);
            if (-glm::dot(shading, dvec(rays[i].direction)) > 0.01) {
                ++bent;
                REQUIRE(off(planes.shading_normals, i, shading) <= rounding * growth);
            }
            const glm::dvec2 texel = oracle.texel(magnitude), within = glm::abs(texel - glm::round(texel));
            if (std::min(within.x, within.y) > rounding * magnitude)
                REQUIRE(off(planes.albedos, i, oracle.albedo(picture, texel)) <= rounding); // of factors up to 1
            const glm::dvec4 change = derivatives(oracle, camera, rays[i], magnitude);
            const double facing = -glm::dot(oracle.normal, dvec(rays[i].direction));
            double wrong = 0.0;
            for (int c = 0; c < 4; ++c)
                wrong = std::max(wrong, std::fabs(change[c] - planes.uv_derivatives[4 * i + c]));
            REQUIRE(wrong <= rounding * magnitude * oracle.slant() / facing);
            ++checked;
        }
        if (small_sizes()) continue; // too few to ask for
        CHECK(checked > hits.size() / 16);
        CHECK(bent > checked / 8);
    }
}

TEST_CASE("gbuffer: green of a normal texture is up in its picture, with tangents of the file or made ones") {
    Material bumpy;
    bumpy.normal_texture.texture = 0;
    Scene scene = one_square(bumpy);
    scene.textures = {{0}};
    scene.images = {image("bump", {1, 1}, {128, 200, 220, 255})};
    for (glm::vec2& uv : scene.meshes[0].uvs[0]) uv.y = 1.0f - uv.y; // the picture's upper edge is the square's
    Camera camera;
    camera.to_world[3] = glm::vec4(0.5f, 0.5f, 2.0f, 1.0f);
    const glm::dvec3 expected = glm::normalize(2.0 * glm::dvec3(128, 200, 220) / 255.0 - 1.0);
    for (const bool made : {true, false}) {
        CAPTURE(made);
        if (!made) scene.meshes[0].tangents.assign(4, {1, 0, 0, 1}); // as exporters write them for such coordinates
        const Planes planes = planes_of(shoot(scene, camera, 1, 1), 4, TextureFilter::nearest);
        CHECK(glm::length(glm::dvec3(glm::make_vec3(planes.shading_normals.data())) - expected) < 1e-6);
    }
}

TEST_CASE("gbuffer: a plane is the same alone, and costs nothing when it is not asked for") {
    Random random(321);
    const Shot shot = shoot(rich_scene(random), inside_camera(true), 20, 11);
    const Planes all = planes_of(shot, 511, TextureFilter::anisotropic);
    for (unsigned bit = 0; bit < 9; ++bit) {
        const Planes one = planes_of(shot, 1u << bit, TextureFilter::anisotropic);
        const std::vector<std::vector<float>> floats = {
            one.positions, one.geometric_normals, one.shading_normals, one.albedos, one.depths, one.uv_derivatives};
        const std::vector<std::vector<float>> expected = {
            all.positions, all.geometric_normals, all.shading_normals, all.albedos, all.depths, all.uv_derivatives};
        for (unsigned k = 0; k < 6; ++k) CHECK(same_bits(floats[k], k == bit ? expected[k] : std::vector<float>{}));
        CHECK(one.materials == (bit == 6 ? all.materials : std::vector<std::uint32_t>{}));
        CHECK(one.instances == (bit == 7 ? all.instances : std::vector<std::uint32_t>{}));
        CHECK(one.primitives == (bit == 8 ? all.primitives : std::vector<std::uint32_t>{}));
    }
    planes_of(shot, 0, TextureFilter::anisotropic);
}

TEST_CASE("gbuffer: planes of another size are refused") {
    Random random(322);
    Device& device = test_device();
    const Shot shot = shoot(rich_scene(random), inside_camera(true), 4, 3);
    Buffer<float> plane = make_buffer<float>(device, 12, "plane");
    GBuffer planes;
    planes.positions = plane; // a third of what it takes
    const auto run = [&](std::uint32_t samples) {
        g_buffer(device, shot.geometry, shot.appearance, shot.record, shot.rays, shot.hits, TextureFilter::nearest,
                 samples, planes);
    };
    CHECK_THROWS_AS(run(1), InputError);
    planes.positions = {};
    planes.depths = plane;
    CHECK_NOTHROW(run(1));
    CHECK_THROWS_AS(run(0), InputError);
}

TEST_CASE("gbuffer: no pixels are nothing to do; the geometry of another scene is refused") {
    Random random(323);
    Device& device = test_device();
    const Shot shot = shoot(rich_scene(random), inside_camera(true), 4, 3);
    Buffer<float> plane = make_buffer<float>(device, 12, "plane");
    fill(device, plane.view(), 7.0f);
    GBuffer planes;
    CHECK_NOTHROW(g_buffer(device, shot.geometry, shot.appearance, shot.record, shot.rays.prefix(0),
                           shot.hits.prefix(0), TextureFilter::nearest, 1, planes));
    planes.depths = plane;
    CHECK_THROWS_AS(g_buffer(device, shot.geometry, shot.appearance, shot.record, shot.rays.prefix(0),
                             shot.hits.prefix(0), TextureFilter::nearest, 1, planes),
                    InputError); // twelve depths of no pixels
    REQUIRE(shot.appearance.triangle_materials.size() > 0);
    const Geometry other = upload(device, make_procedural("random", {5, 0, 1}));
    CHECK_THROWS_AS(
        g_buffer(device, other, shot.appearance, shot.record, shot.rays, shot.hits, TextureFilter::nearest, 1, planes),
        InputError);
    CHECK(download(device, plane) == std::vector<float>(12, 7.0f));
}

TEST_SUITE_END();
