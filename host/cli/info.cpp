// SPDX-License-Identifier: MIT
// boxwood info: what a scene or a .bxw file holds, and the boxes of its tree as lines.
#include <charconv>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "boxwood/analysis.hpp"
#include "boxwood/error.hpp"
#include "boxwood/influence.hpp"
#include "boxwood/requirements.hpp"
#include "cli/areas.hpp"
#include "cli/input.hpp"
#include "cli/report.hpp"
#include "common/excerpt.hpp"
#include "io/gltf_lines.hpp"
#include "metrics/tree_boxes.hpp"
#include "render/appearance_lights.hpp"
#include "scene/picture.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::filesystem::path file;
    bool json = false;
    std::filesystem::path boxes;
    DepthRange depths{0, 4};
    BuildChoice choice;
};

/// "3" or "0-5".
DepthRange to_depths(const std::string& text) {
    DepthRange depths;
    const char* const end = text.data() + text.size();
    auto read = std::from_chars(text.data(), end, depths.first);
    depths.last = depths.first;
    if (read.ec == std::errc() && read.ptr != end && *read.ptr == '-')
        read = std::from_chars(read.ptr + 1, end, depths.last);
    if (read.ec != std::errc() || read.ptr != end || depths.first > depths.last)
        throw CLI::ValidationError("--depth", "\"" + text + "\" is not a range of depths, such as 0-4");
    return depths;
}

/// The tree of a .bxw file as it is stored, that of a scene built; the latter alone needs a device.
void export_boxes(const Arguments& arguments, const Input& input) {
    std::optional<TreeImage> built;
    std::vector<InfluenceRecord> areas;
    if (!input.tree || arguments.choice.given()) {
        Device device = open_device(arguments.common);
        const Prepared prepared = prepare(device, input, arguments.choice, arguments.common.quiet);
        built = download(device, prepared.tree);
        areas = influence_records(prepared.options.areas);
    } else {
        areas = stored_areas(*input.tree);
    }
    Scene lines = box_lines(built ? *built : *input.tree, input.scene, arguments.depths);
    std::size_t boxes = 0;
    for (const Mesh& mesh : lines.meshes) boxes += mesh.positions.size() / 8;
    add_area_lines(areas, lines);
    save_glb_lines(arguments.boxes, lines);
    if (!arguments.common.quiet && !arguments.json)
        std::cout << "  boxes       " << grouped(boxes) << " at depths " << arguments.depths.first << " to "
                  << arguments.depths.last
                  << (areas.empty() ? "" : ", and " + grouped(areas.size()) + (areas.size() == 1 ? " area" : " areas"))
                  << " in " << arguments.boxes.string() << '\n';
}

Json cameras_report(const Scene& scene) {
    Json cameras = Json::array();
    for (const Camera& camera : scene.cameras)
        cameras.push_back({{"name", camera.name}, {"kind", camera.perspective ? "perspective" : "orthographic"}});
    return cameras;
}

/// Of a picture; none when its head cannot be read.
std::optional<PictureSize> size_of(const EncodedImage& image) {
    try {
        return picture_size(image);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

Json images_report(const Scene& scene) {
    Json images = Json::array();
    for (const EncodedImage& image : scene.images) {
        const PictureSize size = size_of(image).value_or(PictureSize{});
        images.push_back({{"name", image.name}, {"width", size.width}, {"height", size.height}});
    }
    return images;
}

/// The options that a tree was built with, as far as requirements go; of a scene the defaults.
BuildOptions options_of(const Input& input) {
    BuildOptions options;
    if (!input.tree) return options;
    options.bounds.kind = input.tree->bounds;
    options.areas.resize(input.tree->areas.size());
    // What was asked for shows only where it is not what Levels::automatic takes.
    const bool two = input.tree->levels == Levels::two;
    if (requirements(input.scene, options).two_levels != two) options.levels = input.tree->levels;
    return options;
}

Json reasons_report(const Input& input) {
    Json list = Json::array();
    for (const Reason& reason : reasons(input.scene, options_of(input)))
        list.push_back({{"word", reason.word}, {"because", reason.because}});
    return list;
}

/// Triangles that are lights, each as often as its mesh is placed.
std::uint64_t emitting_triangles(const Scene& scene) {
    ShadingRequirements emission;
    emission.emission = true;
    return light_limit(scene, emission);
}

Json tree_report(const TreeImage& tree) {
    return {{"layout", name(tree.layout)},       {"levels", name(tree.levels)},
            {"bounds", name(tree.bounds)},       {"bottom_nodes", bottom_nodes(tree)},
            {"top_nodes", top_nodes(tree)},      {"leaves", tree.triangles.size() + tree.blocks.size()},
            {"bottom_depth", tree.bottom_depth}, {"top_depth", tree.top_depth},
            {"areas", tree.areas.size()}};
}

void print_scene(const Input& input) {
    const Scene& scene = input.scene;
    std::cout << input.file.string() << ": " << (input.tree ? ".bxw file" : "glTF scene") << ", "
              << grouped(std::filesystem::file_size(input.file)) << " bytes\n"
              << "  meshes      " << grouped(scene.meshes.size()) << '\n'
              << "  instances   " << grouped(scene.instances.size()) << '\n'
              << "  triangles   " << grouped(scene.triangle_count()) << " stored, "
              << grouped(scene.instanced_triangle_count()) << " as seen\n"
              << "  vertices    " << grouped(scene.vertex_count()) << '\n';
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        std::cout << "  camera " << i << "    \"" << excerpt(scene.cameras[i].name) << "\", "
                  << (scene.cameras[i].perspective ? "perspective" : "orthographic") << '\n';
    const ImportCounts& counts = scene.counts;
    if (counts.dropped_triangles || counts.dropped_instances || counts.skipped_points_and_lines)
        std::cout << "  left out    " << grouped(counts.dropped_triangles) << " triangles, "
                  << grouped(counts.dropped_instances) << " instances, " << grouped(counts.skipped_points_and_lines)
                  << " primitives of points or lines\n";
}

void print_materials(const Scene& scene) {
    std::cout << "  materials   " << grouped(scene.materials.size()) << '\n'
              << "  textures    " << grouped(scene.textures.size()) << '\n';
    constexpr std::size_t most_lines = 8;
    for (std::size_t i = 0; i < scene.images.size() && i < most_lines; ++i) {
        std::cout << "  image " << i << "     \"" << excerpt(scene.images[i].name) << "\", ";
        if (const auto size = size_of(scene.images[i]))
            std::cout << size->width << " x " << size->height << '\n';
        else
            std::cout << "cannot be read\n";
    }
    if (scene.images.size() > most_lines)
        std::cout << "  images      " << scene.images.size() - most_lines << " more\n";
    std::cout << "  lights      " << grouped(scene.lights.size()) << " punctual, " << grouped(emitting_triangles(scene))
              << " emitting triangles\n";
}

void print_reasons(const Input& input) {
    const char* head = "  requires    ";
    for (const Reason& reason : reasons(input.scene, options_of(input))) {
        std::cout << head << reason.word << ": " << reason.because << '\n';
        head = "              ";
    }
}

void print_tree(const TreeImage& tree) {
    std::cout << "  tree        " << name(tree.layout) << ", " << name(tree.bounds) << ", "
              << (tree.levels == Levels::two ? "two levels" : "one level") << '\n'
              << "  bottom      " << grouped(bottom_nodes(tree)) << " nodes, "
              << grouped(tree.triangles.size() + tree.blocks.size()) << " leaves, depth " << tree.bottom_depth << '\n';
    if (tree.levels == Levels::two)
        std::cout << "  top         " << grouped(top_nodes(tree)) << " nodes, " << grouped(tree.instances.size())
                  << " instances, depth " << tree.top_depth << '\n';
    if (!tree.areas.empty())
        std::cout << "  areas       " << grouped(tree.areas.size()) << " with local trees of "
                  << grouped(area_memory(tree).local_trees) << " bytes, found by " << name(tree.area_index.kind)
                  << '\n';
}

void run(const Arguments& arguments) {
    arguments.choice.check();
    check_output(arguments.boxes, ".glb");
    if (arguments.boxes.empty() && arguments.choice.given())
        throw UsageError("build options are of use with --boxes only");
    const Input input = load_input(arguments.file, arguments.common.quiet);
    if (arguments.json) {
        Json report = {{"boxwood", BOXWOOD_VERSION}, {"scene", scene_report(input)}};
        report["cameras"] = cameras_report(input.scene);
        report["images"] = images_report(input.scene);
        report["emitting_triangles"] = emitting_triangles(input.scene);
        report["requirements"] = reasons_report(input);
        if (input.tree) report["tree"] = tree_report(*input.tree);
        std::cout << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    } else if (!arguments.common.quiet) {
        print_scene(input);
        print_materials(input.scene);
        if (input.tree) print_tree(*input.tree);
        print_reasons(input);
    }
    if (!arguments.boxes.empty()) export_boxes(arguments, input);
}

} // namespace

Command add_info(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("info", "Check a scene or a .bxw file and say what it holds");
    const auto arguments = std::make_shared<Arguments>();
    app->add_option("FILE", arguments->file, "glTF 2.0 scene or .bxw file")->required()->type_name("");
    app->add_flag("--json", arguments->json, "As JSON, for scripts");
    CLI::Option* boxes = app->add_option(
        "--boxes", arguments->boxes,
        "Write the boxes of the tree's nodes, and its influence areas, as lines to this binary glTF file (.glb)");
    app->add_option_function<std::string>(
           "--depth", [arguments](const std::string& text) { arguments->depths = to_depths(text); },
           "Depths of the nodes for --boxes, the roots having 0 (default: 0-4)")
        ->type_name("A-B")
        ->needs(boxes);
    add_build_options(*app, arguments->choice);
    add_common(*app, arguments->common);
    add_example(*app, "  boxwood info forest.bxw --json\n"
                      "  boxwood info forest.glb --boxes boxes.glb --depth 0-6 --bounds obb-points");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
