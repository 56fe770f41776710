// SPDX-License-Identifier: MIT
// What the benchmarks share: arguments, the report, the frame of main().
#pragma once

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "boxwood/device.hpp"
#include "io/atomic_file.hpp"

namespace boxwood::benchmarks {

struct Arguments {
    std::string device; ///< As Device takes it.
    std::filesystem::path report;
    int rounds = 9;
};

inline void add_arguments(CLI::App& app, Arguments& arguments) {
    app.add_option("--device", arguments.device, "index of a device or a part of its name");
    app.add_option("--rounds", arguments.rounds, "runs of each contender")->check(CLI::Range(1, 1000));
    app.add_option("--report", arguments.report, "JSON file to write");
}

/// Writes both tables with the device that they were measured on; nothing for an empty path. Throws InputError.
inline void save_report(const Arguments& arguments, const DeviceInfo& info, const nlohmann::json& milliseconds,
                        const nlohmann::json& ratios) {
    if (arguments.report.empty()) return;
    AtomicFile file(arguments.report);
    file.stream() << nlohmann::json{{"device",
                                     {{"platform", info.platform}, {"name", info.name}, {"driver", info.driver}}},
                                    {"rounds", arguments.rounds},
                                    {"milliseconds", milliseconds},
                                    {"ratios", ratios}}
                         .dump(2)
                  << '\n';
    file.commit();
}

/// What `run` returns; 1, and one line on standard error, for what it throws.
template <class Run>
int guarded(const char* program, const Run& run) {
    try {
        return run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", program, error.what());
        return 1;
    }
}

} // namespace boxwood::benchmarks
