// SPDX-License-Identifier: MIT
// boxwood: the command line tool. Finds the command and turns every error into one line and an exit code.
#include <iostream>
#include <new>

#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/standard_output.hpp"
#include "common/excerpt.hpp"

namespace boxwood::cli {

namespace {

enum ExitCode { done = 0, failed = 1, usage = 2, bad_input = 3, no_device = 4, interrupted = 130 };

/// One line on standard error. Messages of several lines, such as listings, are joined.
ExitCode fail(ExitCode code, const std::string& message) {
    constexpr std::size_t longest = 8000; // room for two paths
    std::cerr << "boxwood: " << excerpt(message, longest) << '\n';
    return code;
}

/// A compiler's log is long; its first error says most.
std::string first_error(const ProgramError& error) {
    std::size_t start = error.log.find("error");
    if (start == std::string::npos) start = 0;
    const std::string line = error.log.substr(start, error.log.find('\n', start) - start);
    return error.file + ": does not compile for " + error.device + ": " + line;
}

/// The one place where errors become exit codes.
template <class Work>
ExitCode guarded(const Work& work) {
    try {
        work();
        return done;
    } catch (const Interrupted& error) {
        return fail(interrupted, error.what());
    } catch (const NoDevice& error) {
        return fail(no_device, error.what());
    } catch (const UsageError& error) {
        return fail(usage, error.what());
    } catch (const InputError& error) {
        return fail(bad_input, error.what());
    } catch (const CapacityError& error) {
        return fail(failed, std::string(error.what()) +
                                "; use a smaller scene or resolution, fewer areas, or another --device");
    } catch (const ProgramError& error) {
        return fail(failed, first_error(error));
    } catch (const std::bad_alloc&) {
        return fail(failed, "out of host memory; use a smaller scene or resolution");
    } catch (const std::exception& error) {
        return fail(failed, error.what());
    }
}

/// --help and --version end here too, with code 0 and their text on standard output.
ExitCode fail_parse(const CLI::App& tool, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return static_cast<ExitCode>(tool.exit(error));
    const auto parsed = tool.get_subcommands();
    if (const auto words = tool.remaining(); parsed.empty() && !words.empty() && !words.front().starts_with('-'))
        return fail(usage, "there is no command \"" + words.front() + "\" (see boxwood --help)");
    std::string command;
    for (auto within = parsed; !within.empty(); within = within.front()->get_subcommands())
        command += ' ' + within.front()->get_name();
    return fail(usage, std::string(error.what()) + " (see boxwood" + command + " --help)");
}

int run_command(int argc, char** argv) {
    CLI::App tool("Bounding-box trees built and traced by OpenCL kernels.", "boxwood");
    tool.set_version_flag("--version", std::string("boxwood ") + BOXWOOD_VERSION);
    tool.require_subcommand(1);
    tool.footer("boxwood COMMAND --help explains a command.\n"
                "Exit codes: 0 done, 1 failed, 2 usage, 3 bad input, 4 no usable device,\n"
                "130 interrupted (render: the picture so far and a checkpoint are written).");
    const Command commands[] = {add_devices(tool), add_scene(tool), add_build(tool), add_info(tool),  add_quality(tool),
                                add_analyze(tool), add_study(tool), add_trace(tool), add_render(tool)};
    try {
        tool.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return fail_parse(tool, error);
    }
    for (const Command& command : commands)
        if (command.app->parsed()) return guarded(command.run);
    return usage;
}

int run(int argc, char** argv) {
    StandardOutput output;
    const int code = run_command(argc, argv);
    const std::string failure = output.finish();
    return code == done && !failure.empty() ? fail(failed, failure) : code;
}

} // namespace

} // namespace boxwood::cli

int main(int argc, char** argv) { return boxwood::cli::run(argc, argv); }
