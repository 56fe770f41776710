// SPDX-License-Identifier: MIT
// Runs the built tool as a user does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace boxwood::test {

/// What a run of the tool gave.
struct Run {
    int code = -1; ///< Exit code, or 128 + signal.
    std::string out;
    std::string err;
};

/// Checks a failure as the tool promises it: this code, one line that starts with the tool's name and holds `word`,
/// nothing on standard output.
void check_failure(const Run& run, int code, const std::string& word);

/// A folder of its own for one test, removed in the end; commands run in it.
class Tool {
public:
    Tool();
    ~Tool();
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;

    /// Runs `boxwood ARGUMENTS` by the shell. `before` is shell code put in front, such as a limit or a variable.
    Run run(const std::string& arguments, const std::string& before = "") const;
    /// The same, with a check that it succeeds.
    Run succeed(const std::string& arguments) const;

    const std::filesystem::path& folder() const { return folder_; }
    std::filesystem::path file(const std::string& name) const { return folder_ / name; }
    /// Names in the folder, sorted.
    std::vector<std::string> files() const;
    std::string contents(const std::string& name) const;
    void write(const std::string& name, const std::string& bytes) const;

private:
    std::filesystem::path folder_;
};

/// forest.glb, the smallest scene with several instances.
void make_forest(const Tool& tool);

} // namespace boxwood::test
