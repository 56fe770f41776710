// SPDX-License-Identifier: MIT
// boxwood render as a user runs it: options of light, checkpoints, interruption.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "boxwood/gltf.hpp"
#include "boxwood/image.hpp"
#include "cli/tool.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("cli");

namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

void make_scenes(const Tool& tool) {
    tool.succeed("scene cornell -o room.glb");
    tool.succeed("scene forest --instances 20 -o forest.glb");
}

/// Shell code that ends the tool, which takes the shell's place, once its first checkpoint is there; given up after a
/// while.
const std::string end_after_checkpoint =
    "(for i in $(seq 3000); do [ -e x.exr.resume ] && break; sleep 0.02; done; kill -TERM $$) &";

// Small: what is tested is not the light. Many samples: it must not end before it is ended.
const std::string picture =
    "render room.glb -o x.exr --resolution 12x8 --spp 400 --depth 2 --quiet --aov variance,samples ";

} // namespace

TEST_CASE("render: options of light that are wrong are code 2 and say what is right") {
    const Tool tool;
    make_scenes(tool);
    const std::string render = "render room.glb -o x.exr ";
    check_failure(tool.run(render + "--integrator bdpt"), 2, "path, direct, ambient, ao, normals, cost");
    check_failure(tool.run(render + "--integrator bdpt"), 2, "boxwood: --integrator: bdpt: unknown word");
    check_failure(tool.run(render + "--primary tubes"), 2, "rays, raster");
    check_failure(tool.run(render + "--sampler halton"), 2, "sobol, stratified, random");
    check_failure(tool.run(render + "--strategy luck"), 2, "mis, lights, bsdf");
    check_failure(tool.run(render + "--hemisphere flat"), 2, "cosine, uniform");
    check_failure(tool.run(render + "--filter box"), 2, "anisotropic, trilinear, nearest");
    check_failure(tool.run(render + "--spp 0"), 2, "--spp");
    check_failure(tool.run(render + "--depth 65"), 2, "--depth");
    check_failure(tool.run(render + "--exposure bright"), 2, "--exposure");
    for (const std::string integrator : {"ao", "normals", "cost"})
        check_failure(tool.run(render + "--exposure 1 --integrator " + integrator), 2, "--exposure");
    for (const std::string integrator : {"path", "direct", "normals", "cost"})
        check_failure(tool.run(render + "--ao-distance 1 --integrator " + integrator), 2, "--ao-distance");
    check_failure(tool.run(render + "--ao-distance 0"), 2, "--ao-distance");
    check_failure(tool.run(render + "--checkpoint -1"), 2, "--checkpoint");
    for (const std::string word : {"nan", "inf", "-inf"})
        for (const std::string option : {"--exposure ", "--checkpoint ", "--ao-distance "})
            check_failure(tool.run(render + option + word), 2, option.substr(0, option.size() - 1));
    check_failure(tool.run(render + "--ao-distance 1e-60"), 2, "--ao-distance");
    check_failure(tool.run(render + "--seed -1"), 2, "--seed");
    check_failure(tool.run(render + "--integrator normals --aov indirect"), 2, "normals");
    for (const std::string light : {"dawn", "1,2", "1,2,3,4", "1,-1,1", "1,nan,1", "1,2e18,1", "sky.png"}) {
        CAPTURE(light);
        check_failure(tool.run(render + "--environment " + light), 2, "R,G,B");
    }
    check_failure(tool.run(render + "--environment dawn.exr"), 3, "dawn.exr");
    check_failure(tool.run(render + "--eye 1,2,3"), 2, "--target");
    check_failure(tool.run(render + "--eye 1,2 --target 0,0,0"), 2, "--eye");
    check_failure(tool.run(render + "--eye 1,2,3 --target 0,0,0 --camera 0"), 2, "--camera");
    check_failure(tool.run(render + "--resume"), 3, "x.exr.resume");
    check_failure(tool.run(render + "--resolution 65536x65536"), 1, "pixels of a picture");
    CHECK(tool.files() == Names{"forest.glb", "room.glb"});
}

TEST_CASE("render: two files that are one are refused before any work") {
    const Tool tool;
    make_scenes(tool);
    const std::string room = tool.contents("room.glb");
    const std::vector<float> ones(8, 1.0f);
    save_exr(tool.file("light.exr"), {4, 2, {{"R", ones}, {"G", ones}, {"B", ones}}});
    const std::string light = tool.contents("light.exr");
    std::filesystem::create_symlink(tool.file("light.exr"), tool.file("link.exr"));
    const Names before = tool.files();
    const std::string render = "render room.glb --resolution 4x4 --spp 1 ";
    check_failure(tool.run(render + "-o x.exr --report x.exr"), 2, "--output and --report");
    check_failure(tool.run(render + "-o x.exr --report ./x.png"), 2, "the preview and --report");
    check_failure(tool.run(render + "-o x.exr --report '" + tool.file("x.exr.resume").string() + "'"), 2,
                  "the checkpoint and --report");
    check_failure(tool.run(render + "-o x.exr --report room.glb"), 2, "the scene and --report");
    check_failure(tool.run(render + "-o light.exr --environment light.exr"), 2, "--environment and --output");
    check_failure(tool.run(render + "-o light.exr --environment link.exr"), 2, "--environment and --output");
    check_failure(tool.run(render + "-o x.exr --environment light.exr --report light.exr"), 2,
                  "--environment and --report");
    CHECK(tool.contents("room.glb") == room);
    CHECK(tool.contents("light.exr") == light);
    CHECK(tool.files() == before);
    tool.succeed(render + "-o x.exr --environment sky --report sky"); // a word is no file
}

TEST_CASE("render: every integrator makes its picture, the same bytes each time, and names no folder") {
    const Tool tool;
    make_scenes(tool);
    for (const std::string integrator : {"path", "direct", "ambient", "ao", "normals", "cost"}) {
        CAPTURE(integrator);
        const std::string rest = " --resolution 24x16 --spp 2 --aov all --integrator " + integrator;
        tool.succeed("render forest.glb -o a.exr --report a.json" + rest);
        tool.succeed("render '" + tool.file("forest.glb").string() + "' -o b.exr" + rest);
        CHECK(tool.contents("a.exr") == tool.contents("b.exr"));
        CHECK(tool.contents("a.png") == tool.contents("b.png"));
        CHECK(tool.contents("a.exr").find(tool.folder().string()) == std::string::npos);
        CHECK(tool.contents("a.exr").find("forest") != std::string::npos);
        const Json report = Json::parse(tool.contents("a.json"));
        CHECK(report["options"]["integrator"] == integrator);
        CHECK(report["render"]["rejected_samples"] == 0);
        const int depth = integrator == "direct" ? 1 : integrator == "ambient" ? 2 : 6;
        CHECK(report["options"]["depth"] == depth); // the one that is used, here and in the header: type, size, value
        const std::string attribute = std::string("depth\0int\0\4\0\0\0", 14) + static_cast<char>(depth);
        CHECK(tool.contents("a.exr").find(attribute) != std::string::npos);
    }
}

TEST_CASE("render: the sky lights a scene only when nothing else does, and is named in the summary") {
    const Tool tool;
    tool.succeed("scene sphere -o sphere.glb");
    const std::string render = "render sphere.glb -o x.exr --resolution 16x16 --spp 2 ";
    CHECK(tool.succeed(render).out.find("environment sky (nothing else lights the scene)") != std::string::npos);
    const std::string sky = tool.contents("x.png");
    CHECK(tool.succeed(render + "--environment sky").out.find("environment sky;") != std::string::npos);
    CHECK(tool.contents("x.png") == sky);
    CHECK(tool.succeed(render + "--environment none").out.find("environment none") != std::string::npos);
    CHECK(tool.contents("x.png") != sky);

    CHECK(tool.succeed(render + "--environment-rotation 90 --report x.json").out.find("environment sky") !=
          std::string::npos);
    CHECK(tool.contents("x.png") != sky);
    CHECK(Json::parse(tool.contents("x.json"))["options"]["environment_rotation"] == 90);
    for (const std::string same : {"--environment none", "--environment 1,1,1", "--integrator cost"})
        check_failure(tool.run(render + "--environment-rotation 90 " + same), 2, "--environment-rotation");
    check_failure(tool.run(render + "--environment-rotation 361"), 2, "--environment-rotation");

    // A sign on the sphere lights nothing, a lamp in a room does.
    Scene scene = load_gltf(tool.file("sphere.glb"));
    Material sign;
    sign.emission = glm::vec3(1.0f);
    scene.materials = {sign, Material{}};
    scene.meshes[0].materials.assign(scene.meshes[0].triangles.size(), 1);
    for (std::size_t i = 0; i < 50; ++i) scene.meshes[0].materials[i] = 0;
    save_glb(tool.file("sign.glb"), scene);
    CHECK(tool.succeed("render sign.glb -o x.exr --resolution 16x16 --spp 2").out.find("environment sky (") !=
          std::string::npos);
    tool.succeed("scene cornell -o room.glb");
    CHECK(tool.succeed("render room.glb -o x.exr --resolution 16x16 --spp 2").out.find("environment none") !=
          std::string::npos);

    // One radiance, and a picture that has it everywhere.
    const std::vector<float> ones(8, 1.0f), halves(8, 0.5f);
    save_exr(tool.file("light.exr"), {4, 2, {{"R", ones}, {"G", halves}, {"B", halves}}});
    CHECK(tool.succeed(render + "--environment 1,0.5,0.5").out.find("environment constant") != std::string::npos);
    tool.succeed(render + "--environment light.exr --report x.json");
    CHECK(Json::parse(tool.contents("x.json"))["options"]["environment"] == "light.exr");
}

TEST_CASE("render: a warning about the environment names it once, and costs take one sample of their own accord") {
    const Tool tool;
    tool.succeed("scene sphere -o sphere.glb");
    std::vector<float> ones(8, 1.0f);
    ones[3] = -1.0f;
    save_exr(tool.file("light.exr"), {4, 2, {{"R", ones}, {"G", ones}, {"B", ones}}});
    const std::string render = "render sphere.glb -o x.exr --resolution 4x4 --report x.json ";
    CHECK(tool.succeed(render + "--spp 1 --environment light.exr").err ==
          "boxwood: warning: light.exr: 3 values that are no radiance are 0, or 2^60 where they are larger\n");
    CHECK(Json::parse(tool.contents("x.json"))["scene"]["warnings"].back() ==
          "light.exr: 3 values that are no radiance are 0, or 2^60 where they are larger");
    CHECK(tool.contents("x.exr").find("light.exr") != std::string::npos); // in the header
    for (const auto& [words, samples] :
         {std::pair{"--integrator cost", 1}, {"--integrator cost --spp 3", 3}, {"--integrator normals", 16}}) {
        tool.succeed(render + words);
        CHECK(Json::parse(tool.contents("x.json"))["options"]["spp"] == samples);
    }
}

TEST_CASE("render: an eye and a target are a camera") {
    const Tool tool;
    tool.succeed("scene sphere -o sphere.glb");
    // One pixel, whose middle looks at the target: on the unit sphere, or past it.
    const auto middle = [&](const std::string& target) {
        tool.succeed(
            "render sphere.glb -o x.exr --integrator normals --spp 1 --resolution 1x1 --eye 30,40,0 --target " +
            target);
        return tool.contents("x.png");
    };
    CHECK(middle("0,0,0") == middle("15,20,0")); // along the same line
    CHECK(middle("0,0,0") != middle("0,0,20"));
    // Straight down, also where what is left of x or z vanishes beside y.
    for (const std::string eye : {"0,5,0", "1e-300,5,0", "0,5,-1e-200", "1e-30,5,1e-30"}) {
        CAPTURE(eye);
        const std::string render = "render sphere.glb --integrator normals --spp 1 --resolution 8x8 --target 0,0,0 ";
        tool.succeed(render + "-o down.exr --eye " + eye);
    }
}

TEST_CASE("render: exposure changes the preview alone") {
    const Tool tool;
    make_scenes(tool);
    const std::string render = "render forest.glb --resolution 16x16 --spp 1 ";
    tool.succeed(render + "-o a.exr");
    tool.succeed(render + "-o b.exr --exposure 1.5");
    CHECK(tool.contents("a.exr") == tool.contents("b.exr"));
    CHECK(tool.contents("a.png") != tool.contents("b.png"));
}

TEST_CASE("render: a render that is ended leaves picture and checkpoint, and goes on to the same bytes") {
    const Tool tool;
    make_scenes(tool);
    tool.succeed(picture);
    const std::string unbroken = tool.contents("x.exr");
    std::filesystem::remove(tool.file("x.exr"));

    check_failure(tool.run(picture + "--checkpoint 0 --report x.json", end_after_checkpoint), 130, "--resume");
    CHECK(tool.files() == Names{"forest.glb", "room.glb", "x.exr", "x.exr.resume", "x.json", "x.png"});
    const Json report = Json::parse(tool.contents("x.json"));
    CHECK(report["render"]["interrupted"] == true);
    CHECK(report["render"]["samples"] >= 1);
    CHECK(report["render"]["samples"] < 400);
    CHECK(tool.contents("x.exr") != unbroken);

    tool.succeed(picture + "--resume --report y.json");
    CHECK(tool.contents("x.exr") == unbroken);
    CHECK(Json::parse(tool.contents("y.json"))["render"]["resumed_samples"] == report["render"]["samples"]);
    CHECK_FALSE(std::filesystem::exists(tool.file("x.exr.resume"))); // of no use any more
}

TEST_CASE("render: a signal that is ignored stays ignored, and the other one ends the render") {
    const Tool tool;
    make_scenes(tool);
    tool.succeed(picture);
    const std::string unbroken = tool.contents("x.exr");
    const std::string wait = "(for i in $(seq 3000); do [ -e x.exr.resume ] && break; sleep 0.02; done; kill ";
    const Run ignoring = tool.run(picture + "--checkpoint 0", "trap '' TERM; " + wait + "-TERM $$) &");
    CAPTURE(ignoring.err);
    CHECK(ignoring.code == 0);
    CHECK(ignoring.err.empty());
    CHECK(tool.contents("x.exr") == unbroken);
    check_failure(tool.run(picture + "--checkpoint 0", "trap '' TERM; " + wait + "-INT $$) &"), 130, "--resume");
}

TEST_CASE("render: a checkpoint that cannot be written costs no picture") {
    const Tool tool;
    make_scenes(tool);
    tool.succeed(picture);
    const std::string unbroken = tool.contents("x.exr");
    // A folder in the place of the file, once there is one: before that the tool refuses to begin.
    const std::string block = "(for i in $(seq 3000); do [ -e x.exr.resume ] && break; sleep 0.02; done; "
                              "until mkdir x.exr.resume 2>/dev/null; do rm -f x.exr.resume; done; ";
    const Run whole = tool.run(picture + "--checkpoint 0", block + ") &");
    CAPTURE(whole.err);
    CHECK(whole.code == 0);
    CHECK(whole.err.starts_with("boxwood: warning: no checkpoint was saved: "));
    CHECK(std::count(whole.err.begin(), whole.err.end(), '\n') == 1);
    CHECK(tool.contents("x.exr") == unbroken);
    CHECK(std::filesystem::remove(tool.file("x.exr.resume"))); // the folder is left alone

    for (const std::string name : {"x.exr", "x.png"}) std::filesystem::remove(tool.file(name));
    const Run ended = tool.run(picture + "--checkpoint 0", block + "kill -TERM $$) &");
    CAPTURE(ended.err);
    CHECK(ended.code == 130);
    CHECK(ended.err.find("but no checkpoint was saved") != std::string::npos);
    CHECK(ended.err.find("--resume") == std::string::npos);
    CHECK(tool.files() == Names{"forest.glb", "room.glb", "x.exr", "x.exr.resume", "x.png"});
}

TEST_CASE("render: a checkpoint that another render left is warned of and kept") {
    const Tool tool;
    make_scenes(tool);
    tool.write("x.exr.resume", "of another");
    const std::string render = "render room.glb -o x.exr --resolution 4x4 --spp 2 --depth 1 ";
    const Run run = tool.succeed(render);
    CHECK(run.err == "boxwood: warning: x.exr.resume is there: --resume goes on from it; this render starts anew\n");
    CHECK(tool.succeed(render + "--quiet").err.empty());
    CHECK(tool.contents("x.exr.resume") == "of another");
    tool.succeed(render + "--quiet --checkpoint 0"); // writes its own
    CHECK_FALSE(std::filesystem::exists(tool.file("x.exr.resume")));
    // Found before any work: the scene is not even read.
    check_failure(tool.run("render none.glb -o x.exr --resume"), 3, "x.exr.resume");
}

TEST_CASE("render: a checkpoint that is damaged or of another render is refused, and kept") {
    const Tool tool;
    make_scenes(tool);
    tool.run(picture + "--checkpoint 0", end_after_checkpoint);
    const std::string checkpoint = tool.contents("x.exr.resume");
    REQUIRE(checkpoint.size() > 100);
    const auto refused = [&](const std::string& arguments) {
        check_failure(tool.run(arguments + " --resume"), 3, "x.exr.resume");
    };
    refused(picture + "--seed 2");
    refused(picture + "--camera 0 --environment 1,1,1");
    refused(picture + "--fov 50");
    refused(picture + "--filter nearest");
    refused(picture + "--primary raster");
    refused("render forest.glb" + picture.substr(picture.find(" -o")));
    CHECK(tool.contents("x.exr.resume") == checkpoint);
    std::string damaged = checkpoint;
    damaged[damaged.size() / 2] ^= 1;
    for (const std::string& contents : {std::string(), std::string("#!/bin/sh"), checkpoint.substr(0, 60), damaged}) {
        tool.write("x.exr.resume", contents);
        refused(picture);
    }
}

TEST_SUITE_END();
