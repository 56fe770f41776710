// SPDX-License-Identifier: MIT
// boxwood analyze: costs, overlap and shape of a tree, in all, by level and per node (thesis 5.2).
#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "boxwood/analysis.hpp"
#include "boxwood/influence.hpp"
#include "cli/areas.hpp"
#include "cli/progress.hpp"
#include "cli/report.hpp"
#include "cli/table.hpp"
#include "io/atomic_file.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::filesystem::path input;
    std::filesystem::path rays_of;
    std::filesystem::path nodes;
    std::filesystem::path report;
    BuildChoice choice;
};

/// One tree and what was found of it.
struct Analysed {
    AnalysisTree tree;
    bool by_areas = false; ///< Measured by the rays of areas too.
    std::vector<NodeMeasures> measures;
    Analysis analysis;
};

/// The first tree is measured by `areas`, local trees each by their own. Areas are in world space; the trees of meshes
/// below a top level, which are not, have no measures by areas.
std::vector<Analysed> analyse(const TreeImage& image, const Scene& scene, std::span<const InfluenceRecord> areas) {
    const std::vector<InfluenceRecord> own = stored_areas(image);
    std::vector<Analysed> result;
    for (AnalysisTree& tree : analysis_trees(image, scene)) {
        const std::size_t i = result.size();
        std::span<const InfluenceRecord> rays;
        if (i == 0)
            rays = areas;
        else if (i <= own.size())
            rays = std::span(own).subspan(i - 1, 1);
        std::vector<NodeMeasures> measures = measure_nodes(tree, rays);
        Analysis analysis = analysis_of(tree, measures);
        result.push_back({std::move(tree), !rays.empty(), std::move(measures), std::move(analysis)});
    }
    return result;
}

Json figures_report(const LevelFigures& figures, bool areas) {
    Json json = {{"nodes", figures.nodes}, {"leaves", figures.leaves}, {"sah", figures.sah}};
    if (!areas) return json;
    json["pah"] = figures.pah;
    json["pah_culled"] = figures.pah_culled;
    json["overlap"] = figures.overlap_ratio();
    json["overlap_culled"] = figures.overlap_ratio_culled();
    return json;
}

Json tree_report(const Analysed& each) {
    const Analysis& analysis = each.analysis;
    Json json = {{"name", each.tree.name}};
    json.update(figures_report(analysis.all, each.by_areas));
    json["primitives"] = analysis.primitives;
    json["depth"] = analysis.depth();
    json["leaves_by_size"] = analysis.leaves_by_size;
    if (each.by_areas)
        for (const std::uint32_t level : overlap_levels) {
            const LevelFigures figures = analysis.down_to(level);
            json["overlap_to_level"][level_word(level)] = {{"all", figures.overlap_ratio()},
                                                           {"culled", figures.overlap_ratio_culled()}};
        }
    for (const LevelFigures& level : analysis.levels) json["levels"].push_back(figures_report(level, each.by_areas));
    return json;
}

Json node_report(const AnalysisNode& node, const NodeMeasures& measures, bool areas) {
    Json json = {{"level", node.level},
                 {"parent", node.parent == BOXWOOD_NONE ? Json() : Json(node.parent)},
                 {"first_child", node.first_child},
                 {"children", node.children},
                 {"primitives", node.primitives},
                 {"min", node.box.min},
                 {"max", node.box.max},
                 {"surface", measures.surface}};
    if (!areas) return json;
    json["probability"] = measures.probability;
    json["probability_culled"] = measures.probability_culled;
    json["overlap"] = measures.smaller > 0.0 ? measures.overlap / measures.smaller : 0.0;
    json["overlap_culled"] = measures.smaller_culled > 0.0 ? measures.overlap_culled / measures.smaller_culled : 0.0;
    return json;
}

/// {"trees": [{"name", "nodes": [...]}]}, a node a line.
void save_nodes(const std::filesystem::path& file, const std::vector<Analysed>& trees) {
    if (file.empty()) return;
    AtomicFile output(file);
    std::ostream& stream = output.stream();
    stream << "{\"trees\": [";
    for (std::size_t t = 0; t < trees.size(); ++t) {
        const Json name = trees[t].tree.name;
        stream << (t ? ",\n" : "\n") << "{\"name\": " << name.dump(-1, ' ', false, Json::error_handler_t::replace)
               << ", \"nodes\": [";
        for (std::size_t i = 0; i < trees[t].measures.size(); ++i)
            stream << (i ? ",\n" : "\n")
                   << node_report(trees[t].tree.nodes[i], trees[t].measures[i], trees[t].by_areas).dump();
        stream << "]}";
    }
    stream << "]}\n";
    output.commit();
}

void print_trees(const std::vector<Analysed>& trees) {
    constexpr std::size_t most = 12;
    Table table;
    table.add({"tree", "nodes", "leaves", "primitives", "depth", "SAH cost", "PAH cost", "PAH, culled"});
    for (std::size_t i = 0; i < std::min(most, trees.size()); ++i) {
        const Analysis& analysis = trees[i].analysis;
        const bool seen = trees[i].by_areas;
        table.add({trees[i].tree.name, grouped(analysis.all.nodes), grouped(analysis.all.leaves),
                   grouped(analysis.primitives), std::to_string(analysis.depth()), fixed(analysis.all.sah, 2),
                   seen ? fixed(analysis.all.pah, 2) : "-", seen ? fixed(analysis.all.pah_culled, 2) : "-"});
    }
    table.print("Trees: expected cost of a ray, " + fixed(box_cost, 1) + " per box and " + fixed(primitive_cost, 1) +
                " per primitive");
    if (trees.size() > most) std::cout << "and " << trees.size() - most << " more; --report has all\n";
}

void print_levels(const Analysed& tree) {
    constexpr std::size_t most = 24;
    const bool areas = tree.by_areas;
    const std::vector<LevelFigures>& levels = tree.analysis.levels;
    Table table;
    std::vector<std::string> head{"level", "nodes", "leaves", "SAH cost"};
    if (areas) head.insert(head.end(), {"PAH cost", "PAH, culled", "overlap, %", "culled, %"});
    table.add(std::move(head));
    const auto add = [&](const std::string& word, const LevelFigures& figures) {
        std::vector<std::string> row{word, grouped(figures.nodes), grouped(figures.leaves), fixed(figures.sah, 3)};
        if (areas)
            row.insert(row.end(),
                       {fixed(figures.pah, 3), fixed(figures.pah_culled, 3), fixed(100 * figures.overlap_ratio(), 1),
                        fixed(100 * figures.overlap_ratio_culled(), 1)});
        table.add(std::move(row));
    };
    for (std::size_t i = 0; i < std::min(most, levels.size()); ++i) add(std::to_string(i), levels[i]);
    LevelFigures rest;
    for (std::size_t i = most; i < levels.size(); ++i) rest += levels[i];
    if (levels.size() > most) add("below", rest);
    table.print("Levels of \"" + tree.tree.name + '"');
}

void print_overlap(const Analysis& analysis) {
    Table table;
    table.add({"down to level", "overlap, %", "culled, %"});
    for (const std::uint32_t level : overlap_levels) {
        const LevelFigures figures = analysis.down_to(level);
        table.add({level_word(level), fixed(100 * figures.overlap_ratio(), 1),
                   fixed(100 * figures.overlap_ratio_culled(), 1)});
    }
    table.print("Overlap of siblings' projections, of the smaller of each two");
}

/// Of the trees that hold the scene's triangles: with two levels those of all meshes together, else the first.
void print_leaves(const std::vector<Analysed>& trees, Levels levels) {
    std::vector<std::uint64_t> sizes;
    const std::size_t first = levels == Levels::two ? 1 : 0, end = levels == Levels::two ? trees.size() : 1;
    for (std::size_t i = first; i < end; ++i) {
        const std::vector<std::uint64_t>& of_tree = trees[i].analysis.leaves_by_size;
        sizes.resize(std::max(sizes.size(), of_tree.size()));
        for (std::size_t size = 0; size < of_tree.size(); ++size) sizes[size] += of_tree[size];
    }
    Table table;
    table.add({"triangles", "leaves"});
    for (std::size_t size = 0; size < sizes.size(); ++size)
        if (sizes[size]) table.add({std::to_string(size), grouped(sizes[size])});
    table.print("Sizes of leaves");
}

/// Those that the tree was built with: of local trees as they are stored, so that a scene and its .bxw file agree; one
/// tree for all rays stores none.
std::vector<InfluenceRecord> areas_of(const TreeImage& image, const Prepared& prepared) {
    if (prepared.options.builder == Builder::blend) return influence_records(prepared.options.areas);
    return stored_areas(image);
}

void print_analysis(const Arguments& arguments, const Input& input, const Prepared& prepared,
                    const std::vector<Analysed>& trees) {
    std::cout << arguments.input.string() << ": " << grouped(input.scene.triangle_count()) << " triangles, "
              << name(prepared.tree.layout()) << ", " << name(prepared.tree.bounds()) << ", "
              << (prepared.tree.levels() == Levels::two ? "two levels" : "one level") << '\n';
    print_trees(trees);
    if (trees.empty()) return;
    print_levels(trees[0]);
    if (trees[0].by_areas) print_overlap(trees[0].analysis);
    print_leaves(trees, prepared.tree.levels());
}

void run(const Arguments& arguments) {
    arguments.choice.check();
    check_output(arguments.nodes, "");
    check_output(arguments.report, "");
    if (!arguments.nodes.empty() && arguments.nodes == arguments.report)
        throw UsageError("--nodes and --report must be two files");
    Progress progress(arguments.common.quiet, 4);
    progress.step("reading " + arguments.input.string());
    std::vector<InfluenceRecord> areas;
    if (!arguments.rays_of.empty())
        areas = influence_records(load_areas(arguments.rays_of), arguments.rays_of.string());
    const Input input = load_input(arguments.input, arguments.common.quiet);
    progress.step("building");
    Device device = open_device(arguments.common);
    const Prepared prepared = prepare(device, input, arguments.choice, arguments.common.quiet);
    progress.step("analysing");
    const TreeImage built = input.tree ? TreeImage{} : download(device, prepared.tree);
    const TreeImage& image = input.tree ? *input.tree : built;
    if (arguments.rays_of.empty()) areas = areas_of(image, prepared);
    const std::vector<Analysed> trees = analyse(image, input.scene, areas);
    progress.step("writing");
    Json report = base_report(device, input, prepared, {});
    add_areas(image, prepared, report);
    report["analysis"] = {{"areas", areas.size()}, {"trees", Json::array()}};
    for (const Analysed& each : trees) report["analysis"]["trees"].push_back(tree_report(each));
    save_report(arguments.report, report);
    save_nodes(arguments.nodes, trees);
    progress.clear();
    if (!arguments.common.quiet) {
        print_analysis(arguments, input, prepared, trees);
        std::cout << area_summary(image, prepared);
    }
    if (arguments.common.profile) print_profile(device, prepared);
}

} // namespace

Command add_analyze(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("analyze", "Costs, overlap and shape of a tree: in all, by level, per node");
    const auto arguments = std::make_shared<Arguments>();
    app->add_option("FILE", arguments->input, "glTF 2.0 scene, or .bxw file with its tree")->required()->type_name("");
    app->add_option("--rays-of", arguments->rays_of,
                    "Influence areas (JSON) to judge the tree by, beside isotropic rays (default: those that it was "
                    "built with; a .bxw file keeps those with local trees, which always go by their own)")
        ->type_name("FILE");
    app->add_option("--nodes", arguments->nodes, "JSON file to write with the figures of every node");
    app->add_option("--report", arguments->report, "JSON report to write");
    add_build_options(*app, arguments->choice);
    add_common(*app, arguments->common);
    add_example(*app, "  boxwood analyze forest.bxw --rays-of sun.json --report analysis.json");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
