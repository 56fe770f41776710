// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "boxwood/error.hpp"
#include "runtime/kernel_text.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

TEST_CASE("kernel_text: includes are replaced once, and lines keep their numbers") {
    add_kernels({{"text_test/a.cl", "one\n#include \"text_test/b.h\"\n  #include \"text_test/c.h\"\nfour\n"},
                 {"text_test/b.h", "b1\n#include \"text_test/c.h\"\nb3\n"},
                 {"text_test/c.h", "c1\n"}});
    CHECK(resolve_kernel_text("text_test/a.cl") == "#line 1 \"text_test/a.cl\"\none\n"
                                                   "#line 1 \"text_test/b.h\"\nb1\n"
                                                   "#line 1 \"text_test/c.h\"\nc1\n"
                                                   "#line 3 \"text_test/b.h\"\nb3\n"
                                                   "#line 3 \"text_test/a.cl\"\n"
                                                   "#line 4 \"text_test/a.cl\"\nfour\n");
    const std::vector<std::string> files = kernel_files();
    for (const char* file : {"text_test/c.h", "build/lbvh.cl", "shared/node.h"})
        CHECK(std::find(files.begin(), files.end(), file) != files.end());
}

TEST_CASE("kernel_text: a text that a launch brings stands in for runtime/inserted.h, and may include files") {
    add_kernels({{"text_test/f.cl", "one\n#include \"runtime/inserted.h\"\nthree\n"}, {"text_test/g.h", "g1\n"}});
    CHECK(resolve_kernel_text("text_test/f.cl", "own\n#include \"text_test/g.h\"\n") ==
          "#line 1 \"text_test/f.cl\"\none\n"
          "#line 1 \"runtime/inserted.h\"\nown\n"
          "#line 1 \"text_test/g.h\"\ng1\n"
          "#line 3 \"runtime/inserted.h\"\n"
          "#line 3 \"text_test/f.cl\"\nthree\n");
    CHECK(resolve_kernel_text("text_test/f.cl").find("own") == std::string::npos);
}

TEST_CASE("kernel_text: BOXWOOD_KERNEL_DIR comes before what is embedded") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "boxwood_kernel_text_test";
    std::filesystem::create_directories(folder / "text_test");
    std::ofstream(folder / "text_test" / "d.cl") << "from disk\n";
    add_kernels({{"text_test/d.cl", "embedded\n"}, {"text_test/e.cl", "embedded\n"}});
    const char* set = std::getenv("BOXWOOD_KERNEL_DIR");
    const std::string before = set ? set : "";
    setenv("BOXWOOD_KERNEL_DIR", folder.c_str(), 1);
    const std::string from_disk = resolve_kernel_text("text_test/d.cl");
    const std::string embedded = resolve_kernel_text("text_test/e.cl");
    if (set)
        setenv("BOXWOOD_KERNEL_DIR", before.c_str(), 1);
    else
        unsetenv("BOXWOOD_KERNEL_DIR");
    std::filesystem::remove_all(folder);
    CHECK(from_disk == "#line 1 \"text_test/d.cl\"\nfrom disk\n");
    CHECK(embedded == "#line 1 \"text_test/e.cl\"\nembedded\n");
}

TEST_CASE("kernel_text: a file that is nowhere is refused by name") {
    CHECK_THROWS_WITH_AS(resolve_kernel_text("text_test/nowhere.cl"), doctest::Contains("text_test/nowhere.cl"),
                         ProgramError);
}
