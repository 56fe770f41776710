// SPDX-License-Identifier: MIT
// boxwood devices: what --device can name.
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "boxwood/device.hpp"
#include "cli/command.hpp"

namespace boxwood::cli {

namespace {

std::uint64_t mebibytes(std::uint64_t bytes) { return bytes >> 20; }

std::string arithmetic(const DeviceInfo& info) {
    std::string text = info.denormals ? "denormal numbers" : "no denormal numbers";
    text += info.correctly_rounded_divide_sqrt ? ", division and square root rounded correctly"
                                               : ", no promise to round division and square root correctly";
    if (!info.denormals || !info.correctly_rounded_divide_sqrt) text += ": last digits may differ from other devices'";
    return text;
}

void run(const Common& common) {
    const Device chosen = open_device(common);
    if (common.quiet) return;
    for (const DeviceInfo& info : list_devices()) {
        std::cout << (info.index == chosen.info().index ? "* " : "  ") << info.index << "  " << info.name << '\n'
                  << "       " << info.platform << ", driver " << info.driver << ", " << info.version
                  << (info.language.empty() ? ", cannot be used" : ", compiled as " + info.language) << '\n'
                  << "       " << (info.cpu ? "CPU" : "GPU or other") << ", " << info.compute_units
                  << " compute units, " << mebibytes(info.global_bytes) << " MiB, largest buffer "
                  << mebibytes(info.largest_buffer_bytes) << " MiB\n"
                  << "       " << arithmetic(info) << '\n';
    }
}

} // namespace

Command add_devices(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("devices", "List the OpenCL devices; * marks the one that would be used");
    const auto common = std::make_shared<Common>();
    add_common(*app, *common);
    add_example(*app, "  boxwood devices --device pocl");
    return {app, [common] { run(*common); }};
}

} // namespace boxwood::cli
