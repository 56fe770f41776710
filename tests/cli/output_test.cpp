// SPDX-License-Identifier: MIT
// What the tool prints and writes when that fails.
#include <doctest/doctest.h>

#include <string>

#include "cli/tool.hpp"

using namespace boxwood::test;

TEST_SUITE_BEGIN("cli");

namespace {

using Names = std::vector<std::string>;

void make_tree(const Tool& tool) {
    make_forest(tool);
    tool.succeed("build forest.glb -o forest.bxw");
}

} // namespace

TEST_CASE("output: what is printed and does not arrive is an error, for every command") {
    const Tool tool;
    make_tree(tool);
    for (const std::string command :
         {"--version", "--help", "devices", "devices --help", "render --help", "scene sphere -o s.glb",
          "build forest.glb -o a.bxw", "build forest.glb -o a.bxw --quiet --profile", "info forest.bxw",
          "info forest.bxw --json", "analyze forest.bxw", "trace forest.bxw --resolution 8x8",
          "quality forest.glb --bounds aabb --resolution 8x8", "render forest.bxw -o a.exr --resolution 8x8 --spp 2"}) {
        CAPTURE(command);
        check_failure(tool.run(command + " >/dev/full"), 1,
                      "standard output cannot be written: No space left on device");
        check_failure(tool.run(command + " >&-"), 1, "standard output cannot be written: Bad file descriptor");
    }
}

TEST_CASE(
    "output: closed standard descriptors are no fault where nothing is printed, and no file gets what is printed") {
    const Tool tool;
    make_tree(tool);
    const std::string forest = tool.contents("forest.bxw");
    tool.succeed("build forest.glb -o quiet.bxw --quiet >&-");
    tool.succeed("build forest.glb -o closed.bxw --quiet <&- >&- 2>&-");
    CHECK(tool.run("build forest.glb -o loud.bxw --profile <&- >&- 2>&-").code == 1);
    for (const std::string file : {"quiet.bxw", "closed.bxw", "loud.bxw"}) CHECK(tool.contents(file) == forest);
    CHECK(tool.files() == Names{"closed.bxw", "forest.bxw", "forest.glb", "loud.bxw", "quiet.bxw"});
    // What fails for another reason says that one.
    check_failure(tool.run("info missing.glb >/dev/full"), 3, "missing.glb");
    check_failure(tool.run("info >&-"), 2, "--help");
}

TEST_CASE("output: a temporary that a killed run left is removed by the next one") {
    const Tool tool;
    const std::string scene = "scene random --triangles 100000 -o x.glb";
    CHECK(tool.run(scene, "ulimit -c 0; ulimit -f 1000;").code > 128);
    CHECK(tool.files().size() == 1);
    CHECK(tool.files() != Names{"x.glb"});
    tool.succeed(scene);
    CHECK(tool.files() == Names{"x.glb"});
}

TEST_SUITE_END();
