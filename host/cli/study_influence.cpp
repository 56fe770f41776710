// SPDX-License-Identifier: MIT
#include "cli/study_influence.hpp"

#include "boxwood/costed_leaves.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/reduce.hpp"
#include "boxwood/volumes.hpp"
#include "layout/triangle_records.hpp"
#include "runtime/launch.hpp"
#include "traverse/ray_cost.hpp"

namespace boxwood::cli {

namespace {

/// Table 1 of the paper. Its builder makes leaves of nodes with fewer than 2 triangles.
TopDownOptions paper_options(const char* measure, const char* axes) {
    TopDownOptions options;
    options.measure = measure;
    options.axes = axes;
    options.bins = 40;
    options.bin_box = true;
    options.max_leaf_primitives = 1;
    options.max_levels = 100;
    options.max_non_fallback_levels = 100;
    options.split_plane_quality = 0.4f;
    options.acceptable_children = 1.3f;
    options.excellent_children = 0.9f;
    return options;
}

StudyBuilder paper_builder(const char* name, const char* measure, const char* axes) {
    return {name, paper_options(measure, axes), true, false, 1.0f};
}

/// All axes at every node, leaves of up to 2.
StudyBuilder all_axes_builder(const char* name, const char* measure, const char* cost, bool costed_leaves,
                              float share) {
    TopDownOptions options;
    options.measure = measure;
    options.cost = cost;
    options.axes = "all_axes";
    options.bins = 40;
    options.primitives_per_bin = 1;
    options.max_leaf_primitives = 2;
    return {name, options, false, costed_leaves, share};
}

/// Triangles on the device, with what builders split them by.
struct Primitives {
    Geometry geometry;
    Buffer<Aabb> boxes;
    Buffer<Aabb> bounds; ///< One: of all.
    Buffer<float> barycentres;
    SceneSphere sphere;

    std::uint32_t count() const { return static_cast<std::uint32_t>(boxes.size()); }
};

Buffer<float> barycentres_of(Device& device, const Mesh& mesh) {
    std::vector<float> centres;
    centres.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        glm::dvec3 sum(0.0);
        for (int corner = 0; corner < 3; ++corner) sum += glm::dvec3(mesh.positions[triangle[corner]]);
        for (int k = 0; k < 3; ++k) centres.push_back(static_cast<float>(sum[k] / 3.0));
    }
    return upload(device, centres, "barycentres");
}

Primitives upload_primitives(Device& device, const Mesh& mesh) {
    Scene scene;
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"", 0, glm::mat4(1.0f)});
    Primitives primitives{upload(device, scene), {}, {}, barycentres_of(device, mesh), scene_sphere(scene)};
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    primitives.boxes = make_buffer<Aabb>(device, count, "boxes of triangles");
    const Slices slices = cut(device, count);
    launch(device, {"bounds/primitive_bounds.cl", "triangle_bounds"}, "triangle boxes", slices.slices,
           primitives.geometry.positions, primitives.geometry.triangles, primitives.boxes, count, slices.length);
    primitives.bounds = make_buffer<Aabb>(device, 1, "bounds of triangles");
    reduce(device, primitives.boxes, Operator::sum, primitives.bounds);
    return primitives;
}

/// Means over the rays.
void follow_rays(Device& device, const MarkedTree& tree, const Buffer<Ray>& rays, TreeResult& result) {
    Buffer<RayVisits> visits = make_scratch<RayVisits>(device, rays.size(), "visits");
    Buffer<Hit> hits = make_scratch<Hit>(device, rays.size(), "hits");
    ray_visits(device, tree, rays, visits, hits);
    std::uint64_t nodes = 0, primitives = 0, nodes_to_hit = 0, primitives_to_hit = 0, hit = 0;
    for (const RayVisits& each : download(device, visits)) {
        nodes += each.nodes;
        primitives += each.primitives;
        nodes_to_hit += each.nodes_to_hit;
        primitives_to_hit += each.primitives_to_hit;
    }
    for (const Hit& each : download(device, hits)) hit += each.primitive != BOXWOOD_NONE ? 1 : 0;
    const auto count = static_cast<double>(rays.size());
    const auto cost = [&](std::uint64_t inner, std::uint64_t below) {
        return (2.0 * box_cost * static_cast<double>(inner) + primitive_cost * static_cast<double>(below)) / count;
    };
    result.cost = cost(nodes, primitives);
    result.cost_to_hit = cost(nodes_to_hit, primitives_to_hit);
    result.hits = static_cast<double>(hit) / count;
}

TreeResult study_tree(Device& device, const Primitives& primitives, InfluenceRecord area, const StudyBuilder& builder,
                      const Buffer<Ray>& rays) {
    area.share = builder.share;
    const Buffer<InfluenceRecord> areas = upload(device, std::vector{area}, "areas");
    const Buffer<std::uint32_t> starts = upload(device, std::vector<std::uint32_t>{0, 1}, "areas of trees");
    const BufferView<const float> middles; // of the boxes
    TopDownTree tree = topdown(device, primitives.boxes, builder.barycentres ? primitives.barycentres.view() : middles,
                               upload(device, std::vector<std::uint32_t>{0, primitives.count()}, "trees"), areas,
                               starts, builder.options);
    const Buffer<Aabb> volumes = aabb_volumes(device, tree.topology, primitives.boxes);
    if (builder.costed_leaves)
        tree.leaves = costed_leaves(device, tree.topology, volumes, primitives.bounds, areas, starts,
                                    static_cast<float>(box_cost), static_cast<float>(primitive_cost));
    TreeResult result;
    follow_rays(device,
                {tree.topology, volumes, tree.leaves, triangle_records(device, tree.topology, primitives.geometry, {}),
                 primitives.sphere},
                rays, result);
    const AnalysisTree nodes = analysis_tree(device, tree.topology, volumes, tree.leaves);
    area.share = 1.0f; // all rays that are followed
    result.analysis = analysis_of(nodes, measure_nodes(nodes, std::span(&area, 1)));
    result.splits = tree.splits;
    result.axes_tried = tree.axes_tried;
    result.fallbacks = tree.fallbacks;
    return result;
}

} // namespace

std::vector<StudyBuilder> study_builders() {
    return {paper_builder(study_base, "surface_measure", "longest_axes"),
            paper_builder("PAH+SPFH", "projected_measure", "facing_axes"),
            paper_builder("PAH+LSPH", "projected_measure", "longest_axes"),
            paper_builder("SAH+SPFH", "surface_measure", "facing_axes"),
            all_axes_builder("sah-axes", "surface_measure", "measured_cost", false, 0.0f),
            all_axes_builder("sah-best", "surface_measure", "overlap_cost", true, 0.0f),
            all_axes_builder("blend", "expected_measure", "overlap_cost", true, 0.9f)};
}

std::vector<StudyBuilder> parameter_cases() {
    const float thresholds[][3] = {
        {0.4f, 1.3f, 0.9f}, {0.1f, 1.3f, 0.9f}, {0.8f, 1.3f, 0.9f}, {0.4f, 1.1f, 0.7f}, {0.4f, 1.5f, 1.1f}};
    std::vector<StudyBuilder> cases;
    for (const auto& [quality, acceptable, excellent] : thresholds) {
        StudyBuilder builder = paper_builder("", "projected_measure", "facing_axes");
        builder.name = "case " + std::to_string(cases.size());
        builder.options.split_plane_quality = quality;
        builder.options.acceptable_children = acceptable;
        builder.options.excellent_children = excellent;
        cases.push_back(std::move(builder));
    }
    return cases;
}

ConfigurationResult study_configuration(Device& device, const Configuration& configuration, const Mesh& scene,
                                        std::span<const StudyBuilder> builders, const std::vector<Ray>& rays) {
    ConfigurationResult result;
    result.configuration = configuration;
    const Mesh local = local_mesh(device, scene, configuration.record);
    result.triangles = local.triangles.size();
    if (local.triangles.empty()) return result;
    const Primitives primitives = upload_primitives(device, local);
    const Buffer<Ray> device_rays = upload(device, rays, "rays");
    for (const StudyBuilder& builder : builders)
        result.trees[builder.name] = study_tree(device, primitives, configuration.record, builder, device_rays);
    return result;
}

} // namespace boxwood::cli
