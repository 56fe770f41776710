// SPDX-License-Identifier: MIT
#include "cli/tool.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace boxwood::test {

namespace {

namespace fs = std::filesystem;

/// The tool lies beside this program, in the build tree and where both are installed.
fs::path tool_path() {
    const fs::path path = fs::read_symlink("/proc/self/exe").parent_path() / "boxwood";
    if (!fs::exists(path)) throw std::runtime_error("no tool beside the tests: " + path.string());
    return path;
}

std::string slurp(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

} // namespace

void check_failure(const Run& run, int code, const std::string& word) {
    CAPTURE(run.err);
    CHECK(run.code == code);
    CHECK(run.err.starts_with("boxwood: "));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(run.err.ends_with('\n'));
    CHECK(run.err.find(word) != std::string::npos);
    CHECK(run.out.empty());
}

Tool::Tool() {
    static std::atomic<int> count = 0;
    folder_ = fs::temp_directory_path() / ("boxwood-cli-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    fs::create_directories(folder_);
}

Tool::~Tool() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    fs::remove(folder_.string() + ".out", ignored);
    fs::remove(folder_.string() + ".err", ignored);
}

Run Tool::run(const std::string& arguments, const std::string& before) const {
    const std::string out = folder_.string() + ".out", err = folder_.string() + ".err";
    const std::string command = "cd '" + folder_.string() + "' && { " + before + " exec '" + tool_path().string() +
                                "' " + arguments + "; } >'" + out + "' 2>'" + err + "' </dev/null";
    const int status = std::system(command.c_str());
    Run result{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(out), slurp(err)};
    return result;
}

Run Tool::succeed(const std::string& arguments) const {
    Run result = run(arguments);
    INFO(arguments);
    INFO(result.err);
    REQUIRE(result.code == 0);
    return result;
}

std::vector<std::string> Tool::files() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string Tool::contents(const std::string& name) const { return slurp(file(name)); }

void Tool::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
}

void make_forest(const Tool& tool) { tool.succeed("scene forest --instances 20 -o forest.glb"); }

} // namespace boxwood::test
