// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/tool.hpp"
#include "support.hpp"

using namespace boxwood::test;
using Json = nlohmann::json;

TEST_SUITE_BEGIN("cli");

namespace {

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("cli: help on the tool and every command, with an example") {
    const Tool tool;
    const Run all = tool.succeed("--help");
    CHECK(tool.succeed("--version").out.starts_with("boxwood "));
    for (const std::string command : {"devices", "scene", "build", "info", "quality", "trace", "render"}) {
        CAPTURE(command);
        CHECK(all.out.find(command) != std::string::npos);
        const Run help = tool.succeed(command + " --help");
        CHECK(help.out.find("Example:\n  boxwood " + command) != std::string::npos);
        CHECK(help.err.empty());
    }
    CHECK(tool.succeed("devices").out.starts_with("* 0"));
}

TEST_CASE("cli: wrong usage is code 2 and one line that says what is right") {
    const Tool tool;
    make_forest(tool);
    check_failure(tool.run(""), 2, "--help");
    check_failure(tool.run("polish x.glb"), 2, "polish");
    check_failure(tool.run("build"), 2, "SCENE");
    check_failure(tool.run("build forest.glb"), 2, "--output");
    check_failure(tool.run("build forest.glb -o x.bxw --frobnicate"), 2, "--frobnicate");
    check_failure(tool.run("build forest.glb -o x.tree"), 2, ".bxw");
    check_failure(tool.run("build forest.glb -o x.bxw --layout wide4"), 2, "wide8");
    check_failure(tool.run("build forest.glb -o x.bxw --levels three"), 2, "auto");
    check_failure(tool.run("build forest.glb -o x.bxw --morton 31"), 2, "63");
    check_failure(tool.run("build forest.glb -o x.bxw --bounds obb"), 2,
                  "{aabb,obb-points,obb-boxes,obb-quaternion,obb-cascade,obb-moments,obb-refined}");
    check_failure(tool.run("build forest.glb -o x.bxw --extents tight"), 2, "corners");
    check_failure(tool.run("build forest.glb -o x.bxw --measure length"), 2, "area");
    for (const std::string command : {"build forest.glb -o x.bxw", "trace forest.glb", "render forest.glb -o x.exr"})
        check_failure(tool.run(command + " --layout wide8 --bounds obb-points"), 2, "--layout binary");
    check_failure(tool.run("scene teapot -o x.glb"), 2, "menger");
    check_failure(tool.run("scene sphere -o x.gltf"), 2, ".glb");
    check_failure(tool.run("scene sphere -o x.glb --triangles -5"), 2, "--triangles");
    check_failure(tool.run("render forest.glb -o x.png"), 2, ".exr");
    check_failure(tool.run("render forest.glb -o x.exr --aov beauty"), 2, "normal");
    check_failure(tool.run("trace forest.glb --rays cosmic"), 2, "diffuse");
    for (const std::string size :
         {"640", "640x", "x480", "0x5", "640x480x3", "-1x5", "1e3x5", "99999999999x1", "\"\""}) {
        CAPTURE(size);
        check_failure(tool.run("render forest.glb -o x.exr --resolution " + size), 2, "WIDTHxHEIGHT");
    }
    CHECK(tool.files() == Names{"forest.glb"});
}

TEST_CASE("cli: bad input is code 3, names the file, and leaves nothing behind") {
    const Tool tool;
    make_forest(tool);
    tool.succeed("build forest.glb -o forest.bxw");
    tool.write("empty.glb", "");
    tool.write("text.gltf", "not a scene");
    tool.write("cut.glb", tool.contents("forest.glb").substr(0, 3000));
    tool.write("cut.bxw", tool.contents("forest.bxw").substr(0, 3000));
    std::string flipped = tool.contents("forest.bxw");
    flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 4);
    tool.write("flipped.bxw", flipped);
    tool.write("draco.gltf", R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"]})");
    const Names before = tool.files();
    for (const std::string file : {"empty.glb", "text.gltf", "cut.glb", "cut.bxw", "flipped.bxw", "missing.glb", "."}) {
        CAPTURE(file);
        check_failure(tool.run("info " + file), 3, file);
        check_failure(tool.run("build " + file + " -o x.bxw --report x.json"), 3, file);
        check_failure(tool.run("trace " + file + " --report x.json"), 3, file);
        check_failure(tool.run("render " + file + " -o x.exr --report x.json"), 3, file);
    }
    check_failure(tool.run("info draco.gltf"), 3, "KHR_draco_mesh_compression");
    check_failure(tool.run("render forest.glb -o x.exr --camera Gina"), 3, "0 \"");
    check_failure(tool.run("trace forest.bxw --camera 7"), 3, "0 \"");
    const std::string render = "render forest.glb -o x.exr --resolution 4x4 ";
    check_failure(tool.run(render + "--eye 0,1,2"), 2, "--target");
    check_failure(tool.run(render + "--eye 0,1 --target 0,0,0"), 2, "\"0,1\" is not a point");
    check_failure(tool.run(render + "--eye 0,1,nan --target 0,0,0"), 2, "nan");
    check_failure(tool.run(render + "--eye 0,1,2 --target 0,1,2"), 2, "same point");
    // In float the first is 0 and the last is pi.
    for (const std::string angle : {"1e-300", "0", "nan", "180", "179.9999999999"}) {
        CAPTURE(angle);
        check_failure(tool.run(render + "--fov " + angle), 2, "180");
    }
    CHECK(tool.files() == before);
}

TEST_CASE("cli: an output that cannot be written is code 1, with the system's reason, before the work") {
    const Tool tool;
    make_forest(tool);
    for (const auto& [name, reason] : {std::pair{"nowhere/x", "the folder nowhere does not exist"},
                                       {"forest.glb/x", "Not a directory"},
                                       {"/proc/self/x", "cannot be created: "}}) {
        const std::string file = name;
        check_failure(tool.run("build forest.glb -o " + file + ".bxw"), 1, reason);
        check_failure(tool.run("build missing.glb -o " + file + ".bxw"), 1, reason); // before the scene is read
        check_failure(tool.run("build forest.glb -o x.bxw --report " + file + ".json"), 1, reason);
        check_failure(tool.run("trace forest.glb --report " + file + ".json"), 1, reason);
        check_failure(tool.run("quality forest.glb --report " + file + ".json"), 1, reason);
        check_failure(tool.run("analyze forest.glb --nodes " + file + ".json"), 1, reason);
        check_failure(tool.run("info forest.glb --boxes " + file + ".glb"), 1, reason);
        check_failure(tool.run("render forest.glb -o " + file + ".exr"), 1, reason);
        check_failure(tool.run("scene sphere -o " + file + ".glb"), 1, reason);
    }
    check_failure(tool.run("build forest.glb -o x.bxw --report ."), 1, "is a folder");
    check_failure(tool.run("build forest.glb -o x.bxw --report /dev/null"), 1, "not a regular file");
    CHECK(tool.files() == Names{"forest.glb"});
}

TEST_CASE("cli: no usable device is code 4") {
    const Tool tool;
    make_forest(tool);
    check_failure(tool.run("build forest.glb -o x.bxw --device abacus"), 4, "abacus");
    check_failure(tool.run("devices --device 99"), 4, "99");
    check_failure(tool.run("trace forest.glb", "BOXWOOD_DEVICE=abacus"), 4, "abacus");
    check_failure(tool.run("devices", "OCL_ICD_VENDORS=/nonexistent"), 4, "no OpenCL device");
    CHECK(tool.files() == Names{"forest.glb"});
}

TEST_CASE("cli: build options beside a stored tree are refused") {
    const Tool tool;
    make_forest(tool);
    tool.succeed("build forest.glb -o forest.bxw");
    check_failure(tool.run("trace forest.bxw --layout binary"), 2, "forest.bxw");
    check_failure(tool.run("render forest.bxw -o x.exr --levels one"), 2, "forest.bxw");
    check_failure(tool.run("trace forest.bxw --bounds aabb"), 2, "forest.bxw");
    CHECK(tool.files() == Names{"forest.bxw", "forest.glb"});
}

TEST_CASE("cli: nothing but the summary is printed in a pipe, and nothing when quiet") {
    const Tool tool;
    make_forest(tool);
    const Run loud = tool.succeed("build forest.glb -o a.bxw");
    CHECK(loud.err.empty());
    CHECK(std::count(loud.out.begin(), loud.out.end(), '\n') == 1);
    for (const std::string command :
         {"scene sphere -o s.glb", "build forest.glb -o a.bxw", "trace a.bxw --resolution 8x8",
          "render a.bxw -o a.exr --resolution 8x8 --spp 2", "info a.bxw", "devices"}) {
        CAPTURE(command);
        const Run quiet = tool.succeed(command + " --quiet");
        CHECK(quiet.out.empty());
        CHECK(quiet.err.empty());
    }
    const Run profiled = tool.succeed("build forest.glb -o a.bxw --quiet --profile");
    for (const std::string word : {"stage", "morton", "radix sort", "top_level", "total"})
        CHECK(profiled.out.find(word) != std::string::npos);
}

TEST_CASE("cli: a process killed while it writes leaves no file under the final name") {
    const Tool tool;
    tool.succeed("scene random --triangles 100000 -o random.glb");
    const std::string old = "older contents";
    for (const std::string arguments : {"scene random --triangles 100000 -o x.glb", "build random.glb -o x.bxw",
                                        "render random.glb --integrator normals --spp 1 -o x.exr"}) {
        CAPTURE(arguments);
        const std::string output = arguments.substr(arguments.find("x."));
        // The system kills the process when a file passes 2 MiB. Every output here is larger, and no file that an
        // OpenCL compiler keeps in its cache is.
        const Run killed = tool.run(arguments, "ulimit -c 0; ulimit -f 4096;");
        // A device's compiler may take the first signal for itself, and the write then fails.
        CHECK((killed.code > 128 || (killed.code == 1 && !arguments.starts_with("scene"))));
        CHECK_FALSE(std::filesystem::exists(tool.file(output)));
        // With the signal ignored it is a failed write: an error, no file, and an older one untouched.
        tool.write(output, old);
        check_failure(tool.run(arguments, "trap '' XFSZ; ulimit -f 4096;"), 1,
                      output.substr(0, output.find(' ')) + ": cannot be written: File too large");
        CHECK(tool.contents(output) == old);
    }
}

TEST_CASE("cli: outputs replace older ones, and names may have spaces") {
    const Tool tool;
    make_forest(tool);
    tool.write("my tree.bxw", "older");
    tool.succeed("build forest.glb -o 'my tree.bxw'");
    CHECK(tool.succeed("info 'my tree.bxw'").out.find(".bxw file") != std::string::npos);
    CHECK(tool.files() == Names{"forest.glb", "my tree.bxw"});
}

TEST_CASE("cli: of names and words of any length in a file, messages show an excerpt") {
    const Tool tool;
    const std::string longest(100'000, 'n');
    Json scene = {{"asset", {{"version", "2.0"}}}, {"extensionsUsed", {longest}}};
    scene["cameras"] = {{{"type", "orthographic"},
                         {"name", longest},
                         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}};
    scene["nodes"] = {{{"camera", 0}, {"name", longest}}};
    scene["images"] = {{{"uri", longest}}};
    tool.write("names.gltf", scene.dump());
    const Run info = tool.succeed("info names.gltf");
    CHECK(info.out.size() < 2000);
    CHECK(info.out.find("(100000 bytes)") != std::string::npos);
    CHECK(info.err.size() < 2000);
    for (const char* wrong : {"trace names.gltf --camera none", "trace names.gltf --fov 30"}) {
        const Run run = tool.run(wrong);
        CHECK(run.code != 0);
        CHECK(run.err.size() < 3000);
        CHECK(run.err.find("(100000 bytes)") != std::string::npos);
    }
    scene["extensionsUsed"] = Json::array({"ACME_short"});
    scene["extensionsRequired"] = {longest};
    tool.write("required.gltf", scene.dump());
    const Run refused = tool.run("info required.gltf");
    check_failure(refused, 3, "which is not supported");
    CHECK(refused.err.size() < 1000);
}
