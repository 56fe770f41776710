// SPDX-License-Identifier: MIT
// Options that several commands share.
#include <algorithm>
#include <charconv>

#include <CLI/CLI.hpp>

#include "boxwood/device.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "io/atomic_file.hpp"

namespace boxwood::cli {

namespace {

/// The number that is all of `text`; 0 when it is none.
std::uint32_t to_number(std::string_view text) {
    std::uint32_t value = 0;
    const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc() && rest == text.data() + text.size() ? value : 0;
}

} // namespace

std::vector<std::string> bounds_words() {
    std::vector<std::string> words;
    for (const Bounds kind : all_bounds()) words.emplace_back(name(kind));
    return words;
}

Device open_device(const Common& common) {
    const InterruptsBlocked blocked;
    try {
        return Device(common.device);
    } catch (const DeviceError& error) {
        throw NoDevice(error.what());
    }
}

void add_common(CLI::App& command, Common& common) {
    command.add_option("--device", common.device,
                       "Index or part of the name of the OpenCL device (default: BOXWOOD_DEVICE, else the first)");
    command.add_flag("--quiet", common.quiet, "No progress and no summary; errors only");
    command.add_flag("--profile", common.profile, "Table of device times by stage and pass");
}

void add_example(CLI::App& command, const std::string& lines) { command.footer("Example:\n" + lines); }

bool BuildChoice::given() const {
    return std::any_of(declared.begin(), declared.end(), [](const CLI::Option* option) { return option->count() > 0; });
}

void BuildChoice::check() const {
    if (options.layout == Layout::wide8 && options.bounds.kind != Bounds::aabb)
        throw UsageError(
            "--layout wide8 holds axis-aligned boxes only: leave it out, or use --layout binary, with --bounds " +
            std::string(name(options.bounds.kind)));
    if (areas.empty()) throw UsageError("--areas names nothing: give a file, lights, probe or none");
    const bool has_areas = areas != "none";
    if (has_areas && options.levels == Levels::two)
        throw UsageError("--areas needs one level, as areas lie in world space: leave --levels two out");
    if (has_areas && options.bounds.kind != Bounds::aabb)
        throw UsageError("--areas needs axis-aligned boxes: leave --bounds " + std::string(name(options.bounds.kind)) +
                         " out");
    if (options.area_index != AreaIndexKind::automatic && (!has_areas || options.builder == Builder::blend))
        throw UsageError("--area-index is of use with local trees only, those of --areas without --builder blend");
    if (options.morton != MortonBits::bits30 && options.builder != Builder::lbvh)
        throw UsageError("--morton is of use with --builder lbvh only");
    if (!has_areas && needs_areas(options.builder))
        throw UsageError("--builder " + std::string(name(options.builder)) + " needs --areas");
    if (options.bounds.extents == Extents::corners && options.bounds.kind != Bounds::obb_moments)
        throw UsageError("--extents corners is of use with --bounds obb-moments only");
    if (options.bounds.measure == Measure::area && options.bounds.kind == Bounds::aabb)
        throw UsageError("--measure area chooses between oriented and axis-aligned boxes: add --bounds KIND");
}

CLI::Option* add_levels(CLI::App& command, BuildOptions& options) {
    return command
        .add_option_function<std::string>(
            "--levels", [&](const std::string& word) { options.levels = to_levels(word); },
            "One tree over everything, a tree per mesh under a tree over instances, or by need (default)")
        ->check(CLI::IsMember({"one", "two", "auto"}));
}

CLI::Option* add_extents(CLI::App& command, BuildOptions& options) {
    return command
        .add_option_function<std::string>(
            "--extents", [&](const std::string& word) { options.bounds.extents = to_extents(word); },
            "Extents of obb-moments from all vertices (exact, default) or from the children's corners")
        ->check(CLI::IsMember({"exact", "corners"}));
}

CLI::Option* add_measure(CLI::App& command, BuildOptions& options) {
    return command
        .add_option_function<std::string>(
            "--measure", [&](const std::string& word) { options.bounds.measure = to_measure(word); },
            "A node keeps its axis-aligned box unless the oriented one has less volume (default) or area")
        ->check(CLI::IsMember({"volume", "area"}));
}

CLI::Option* add_morton(CLI::App& command, BuildOptions& options) {
    return command
        .add_option_function<int>(
            "--morton", [&](int bits) { options.morton = bits == 63 ? MortonBits::bits63 : MortonBits::bits30; },
            "Bits of the Morton codes of lbvh (default: 30)")
        ->check(CLI::IsMember({30, 63}));
}

namespace {

CLI::Option* add_builder(CLI::App& command, BuildOptions& options) {
    return command
        .add_option_function<std::string>(
            "--builder", [&](const std::string& word) { options.builder = to_builder(word); },
            "Morton codes (lbvh, default): a fast build; surface area heuristic (sah): fast rays; halves in space "
            "(midpoint); projected area heuristic (pah): fast rays of influence areas; both by the areas' shares of "
            "the rays (blend): one tree for all")
        ->check(CLI::IsMember({"lbvh", "sah", "midpoint", "pah", "blend"}));
}

CLI::Option* add_area_index(CLI::App& command, BuildOptions& options) {
    return command
        .add_option_function<std::string>(
            "--area-index", [&](const std::string& word) { options.area_index = to_area_index(word); },
            "How the influence areas of a point are found (default: list for up to eight, else kd)")
        ->check(CLI::IsMember({"list", "octree", "kd"}));
}

} // namespace

void add_build_options(CLI::App& command, BuildChoice& choice) {
    BuildOptions& options = choice.options;
    choice.declared = {
        add_levels(command, options),
        command
            .add_option_function<std::string>(
                "--layout", [&](const std::string& word) { options.layout = to_layout(word); },
                "Nodes with two children or eight (default: wide8, but binary for oriented boxes)")
            ->check(CLI::IsMember({"binary", "wide8"})),
        command
            .add_option_function<std::string>(
                "--bounds", [&](const std::string& word) { options.bounds.kind = to_bounds(word); },
                "Volumes of the nodes: axis-aligned boxes (default), or a kind of oriented boxes")
            ->check(CLI::IsMember(bounds_words())),
        add_extents(command, options),
        add_measure(command, options),
        add_builder(command, options),
        add_morton(command, options),
        command
            .add_option("--areas", choice.areas,
                        "Influence areas with trees of their own for the rays that follow them, or with --builder "
                        "blend one tree that knows their rays: a JSON file; those of the scene's lights (lights) or "
                        "that a probe of 16 x 16 rays of its first camera finds (probe), as far as they are worth it; "
                        "or none (default)")
            ->type_name("FILE|lights|probe|none"),
        add_area_index(command, options),
    };
}

void add_resolution(CLI::App& command, Resolution& resolution) {
    command
        .add_option_function<std::string>(
            "--resolution",
            [&](const std::string& text) {
                const std::size_t cross = std::min(text.find('x'), text.size());
                const std::uint32_t width = to_number(text.substr(0, cross));
                const std::uint32_t height = cross < text.size() ? to_number(text.substr(cross + 1)) : 0;
                constexpr std::uint32_t most = 1u << 16;
                if (width == 0 || height == 0 || width > most || height > most)
                    throw CLI::ValidationError("--resolution", "\"" + text + "\" is not WIDTHxHEIGHT, such as " +
                                                                   "1280x720, each from 1 to " + std::to_string(most));
                resolution = {width, height};
            },
            "Pixels as WIDTHxHEIGHT (default: 1024x1024)")
        ->type_name("WxH");
}

void check_output(const std::filesystem::path& file, const std::string& extension) {
    if (file.empty()) return;
    if (!extension.empty() && file.extension() != extension)
        throw UsageError("\"" + file.string() + "\" must end in " + extension);
    const AtomicFile probe(file);
}

} // namespace boxwood::cli
