// SPDX-License-Identifier: MIT
// What the commands of the tool share. Each command is one file with one add_...() that declares its arguments and
// says what to run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"

// CLI/CLI.hpp, which takes as long to compile as all else, is included where options are declared.
namespace CLI {
class App;
class Option;
} // namespace CLI

namespace boxwood::cli {

/// Options that every command takes.
struct Common {
    std::string device;
    bool quiet = false;
    bool profile = false;
};

/// A command that was declared: run() when its words were given.
struct Command {
    CLI::App* app = nullptr;
    std::function<void()> run;
};

Command add_devices(CLI::App& tool);
Command add_scene(CLI::App& tool);
Command add_build(CLI::App& tool);
Command add_info(CLI::App& tool);
Command add_trace(CLI::App& tool);
Command add_render(CLI::App& tool);
Command add_quality(CLI::App& tool);
Command add_analyze(CLI::App& tool);
Command add_study(CLI::App& tool);

/// No device can be used: exit code 4, where another DeviceError is a failure of the work.
class NoDevice : public Error {
public:
    using Error::Error;
};

/// Arguments that do not go together, found when they are used: exit code 2.
class UsageError : public Error {
public:
    using Error::Error;
};

/// The user ended the work, and what there was of it is saved: exit code 130.
class Interrupted : public Error {
public:
    using Error::Error;
};

/// The device of --device. Throws NoDevice.
Device open_device(const Common& common);

void add_common(CLI::App& command, Common& common);

/// Adds "Example:" and the lines to the command's help.
void add_example(CLI::App& command, const std::string& lines);

/// Build options and whether any was given.
struct BuildChoice {
    BuildOptions options;
    std::string areas = "none"; ///< A file of influence areas, "lights", "probe" or "none".
    std::vector<const CLI::Option*> declared;

    bool given() const;
    /// Throws UsageError for options that do not go together. To be called before any work.
    void check() const;
};
void add_build_options(CLI::App& command, BuildChoice& choice);

/// Single build options, for commands that do not take all.
CLI::Option* add_levels(CLI::App& command, BuildOptions& options);
CLI::Option* add_extents(CLI::App& command, BuildOptions& options);
CLI::Option* add_measure(CLI::App& command, BuildOptions& options);
CLI::Option* add_morton(CLI::App& command, BuildOptions& options);

/// The kinds of volumes.
std::vector<std::string> bounds_words();

/// Size of a picture or of a grid of camera rays.
struct Resolution {
    std::uint32_t width = 1024;
    std::uint32_t height = 1024;
};
void add_resolution(CLI::App& command, Resolution& resolution);

/// Throws OutputError naming `file` unless it can be written, and UsageError unless it ends in `extension` (any when
/// empty). To be called before any work; nothing for an empty path.
void check_output(const std::filesystem::path& file, const std::string& extension);

} // namespace boxwood::cli
