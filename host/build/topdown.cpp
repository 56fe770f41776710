// SPDX-License-Identifier: MIT
#include "build/topdown.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boxwood/error.hpp"
#include "boxwood/scan.hpp"
#include "build/trees.hpp"
#include "runtime/launch.hpp"
#include "shared/topdown.h"

namespace boxwood {

namespace {

/// Primitives above which a node is split by whole launches, which is also how long their chunks are: short enough for
/// the work-items there are, and for the caches of a CPU.
std::uint32_t chunk_size_for(const Device& device, std::uint64_t primitives) {
    // Every level has launches to wait for: fewer are better as long as there is a subtree for every other work-item.
    const std::uint64_t length = cut(device, std::max<std::uint64_t>(primitives, 1)).length;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(2 * length, 64, 4096));
}

Thresholds thresholds_of(const TopDownOptions& options) {
    return {options.max_leaf_cost,
            options.max_leaf_area,
            options.max_leaf_hit_probability,
            options.max_leaf_primitives,
            options.max_levels,
            options.max_non_fallback_levels,
            options.split_plane_quality,
            options.acceptable_children,
            options.excellent_children,
            {0, 0, 0}};
}

// Macros of cl/build/record.h, bins.h and split.h: few programs depend on the strategy.

Defines record_defines(bool own_centres) { return {{"OWN_CENTRES", own_centres ? "1" : "0"}}; }

Defines bin_defines(const TopDownOptions& options, Defines defines) {
    defines.insert({{"BINS", std::to_string(options.bins)},
                    {"BIN_BOX", options.bin_box ? "1" : "0"},
                    {"PRIMITIVES_PER_BIN", std::to_string(options.primitives_per_bin) + "u"}});
    return defines;
}

Defines split_defines(const TopDownOptions& options, Defines defines) {
    defines.insert({{"BLOCK_SIZE", std::to_string(options.block_size)},
                    {"MEASURE", options.measure},
                    {"COST", options.cost},
                    {"AXES", options.axes},
                    {"STOP", options.stop},
                    {"FALLBACK_MEASURE", options.fallback_measure},
                    {"FALLBACK_AXES", options.fallback_axes}});
    return defines;
}

void require(bool right, const char* option, const char* what) {
    if (!right) throw InputError("topdown", option, what);
}

/// An OpenCL function's name, and nothing else that would end up in the compiler's options.
bool is_name(const std::string& text) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    return !text.empty() && letter(text[0]) &&
           std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

/// The state of one build.
class TopDownBuild {
public:
    TopDownBuild(Device& device, BufferView<const float> centres, BufferView<const Aabb> tree_bounds,
                 BufferView<const InfluenceRecord> areas, BufferView<const std::uint32_t> area_starts,
                 const TopDownOptions& options, Topology& topology, Buffer<std::uint32_t>& marks);

    void write_records(BufferView<const Aabb> boxes);
    void emit_roots();
    void split_levels();
    void build_subtrees();
    void sum_marks(TopDownTree& tree);

private:
    KernelRef root_kernel(const char* name) const { return {"build/topdown_roots.cl", name, record_defines_}; }
    KernelRef level_kernel(const char* name) const { return {"build/topdown_levels.cl", name, bin_defines_}; }
    /// Scans what was counted of `count` nodes, takes the sums over, and returns how many small nodes there are.
    std::uint32_t count_next(std::uint32_t count);
    void split_level(std::uint32_t parity);

    Device& device_;
    BufferView<const float> centres_;
    BufferView<const Aabb> tree_bounds_;
    BufferView<const InfluenceRecord> areas_;
    BufferView<const std::uint32_t> area_starts_;
    Topology& topology_;
    BufferView<std::uint32_t> marks_;
    Defines record_defines_, bin_defines_, split_defines_;
    std::string source_;
    std::uint32_t count_, trees_;
    std::uint32_t chunk_size_; ///< Also what a node must have more primitives than to be large.
    std::uint32_t slots_;
    Buffer<Thresholds> thresholds_;
    Buffer<cl_float8> records_[2];
    Buffer<LargeNode> nodes_[2]; ///< Of this level, and of the next.
    Buffer<std::uint32_t> first_chunks_[2];
    Buffer<SmallNode> small_nodes_;
    Buffer<std::uint64_t> kinds_; ///< Large nodes in the upper half, small ones in the lower.
    Buffer<std::uint32_t> chunks_;
    std::uint32_t node_count_ = 0, chunk_count_ = 0, small_count_ = 0;
    Buffer<cl_float8> chunk_bins_, chunk_bounds_, node_bins_;
    Buffer<std::uint32_t> chunk_counts_, node_counts_;
};

/// Most large nodes and chunks that a level can have.
struct LevelSize {
    std::uint64_t nodes, chunks;
};

LevelSize largest_level(std::uint64_t primitives, std::uint32_t chunk_size) {
    const std::uint64_t nodes = primitives / (chunk_size + 1);
    return {nodes, primitives / chunk_size + nodes};
}

TopDownBuild::TopDownBuild(Device& device, BufferView<const float> centres, BufferView<const Aabb> tree_bounds,
                           BufferView<const InfluenceRecord> areas, BufferView<const std::uint32_t> area_starts,
                           const TopDownOptions& options, Topology& topology, Buffer<std::uint32_t>& marks)
    : device_(device), centres_(centres), tree_bounds_(tree_bounds), areas_(areas), area_starts_(area_starts),
      topology_(topology), marks_(marks), record_defines_(record_defines(centres.size() > 0)),
      bin_defines_(bin_defines(options, record_defines_)), split_defines_(split_defines(options, bin_defines_)),
      source_(options.source), count_(static_cast<std::uint32_t>(topology.order.size())),
      trees_(static_cast<std::uint32_t>(topology.trees())), chunk_size_(chunk_size_for(device, count_)),
      slots_(3 * options.bins) {
    thresholds_ = upload(device, std::vector<Thresholds>{thresholds_of(options)}, "thresholds");
    const LevelSize most = largest_level(count_, chunk_size_);
    for (const int side : {0, 1}) {
        records_[side] = make_scratch<cl_float8>(device, count_, "records of primitives");
        nodes_[side] = make_scratch<LargeNode>(device, most.nodes, "large nodes");
        first_chunks_[side] = make_scratch<std::uint32_t>(device, most.nodes, "chunks of large nodes");
    }
    small_nodes_ = make_scratch<SmallNode>(device, count_ / 2, "small nodes");
    kinds_ = make_scratch<std::uint64_t>(device, std::max<std::uint64_t>(most.nodes, trees_), "kinds of nodes");
    chunks_ = make_scratch<std::uint32_t>(device, kinds_.size(), "chunks of nodes");
    chunk_bins_ = make_scratch<cl_float8>(device, most.chunks * slots_, "bins of chunks");
    chunk_counts_ = make_scratch<std::uint32_t>(device, most.chunks * slots_, "counts of chunks");
    chunk_bounds_ = make_scratch<cl_float8>(device, most.chunks * 2, "bounds of chunks");
    node_bins_ = make_scratch<cl_float8>(device, most.nodes * slots_, "bins of nodes");
    node_counts_ = make_scratch<std::uint32_t>(device, most.nodes * slots_, "counts of nodes");
}

void TopDownBuild::write_records(BufferView<const Aabb> boxes) {
    const Slices slices = cut(device_, count_);
    launch(device_, root_kernel("topdown_records"), "records", slices.slices, boxes, records_[0], count_,
           slices.length);
}

std::uint32_t TopDownBuild::count_next(std::uint32_t count) {
    inclusive_scan(device_, kinds_.prefix(count), Operator::sum, kinds_.prefix(count));
    inclusive_scan(device_, chunks_.prefix(count), Operator::sum, chunks_.prefix(count));
    const std::uint64_t kinds = download_element(device_, kinds_, count - 1);
    chunk_count_ = download_element(device_, chunks_, count - 1);
    node_count_ = static_cast<std::uint32_t>(kinds >> 32);
    return static_cast<std::uint32_t>(kinds);
}

/// The roots of the trees, as the nodes of the first level.
void TopDownBuild::emit_roots() {
    launch(device_, root_kernel("topdown_seed"), "roots", trees_, topology_.offsets, kinds_, chunks_, topology_.order,
           topology_.children, topology_.parents, topology_.far_ends, count_, trees_, chunk_size_);
    small_count_ = count_next(trees_);
    launch(device_, root_kernel("topdown_emit_roots"), "roots", trees_, topology_.offsets, kinds_, chunks_, nodes_[0],
           first_chunks_[0], small_nodes_, trees_, chunk_size_);
    launch(device_, root_kernel("topdown_measure"), "roots", chunk_count_, nodes_[0], first_chunks_[0], records_[0],
           centres_, chunk_bounds_, node_count_, chunk_count_, chunk_size_);
    launch(device_, root_kernel("topdown_roots"), "roots", node_count_, nodes_[0], chunk_bounds_, node_count_,
           chunk_size_);
}

void TopDownBuild::split_level(std::uint32_t parity) {
    const std::uint32_t nodes = node_count_, chunks = chunk_count_;
    Buffer<LargeNode>&level = nodes_[parity], &next = nodes_[1 - parity];
    const Buffer<std::uint32_t>& firsts = first_chunks_[parity];
    Buffer<cl_float8>&from = records_[parity], &to = records_[1 - parity];
    launch(device_, level_kernel("topdown_bin"), "bin", chunks, level, firsts, from, centres_, chunk_bins_,
           chunk_counts_, nodes, chunks, chunk_size_);
    const Slices slots = cut(device_, std::size_t{nodes} * slots_);
    launch(device_, level_kernel("topdown_merge"), "merge", slots.slices, level, chunk_bins_, chunk_counts_, node_bins_,
           node_counts_, nodes * slots_, slots.length, chunk_size_);
    launch(device_, {"build/topdown_choose.cl", "topdown_choose", split_defines_, source_}, "choose", nodes, level,
           node_bins_, node_counts_, tree_bounds_, areas_, area_starts_, thresholds_, kinds_, chunks_, topology_.order,
           topology_.children, topology_.parents, topology_.far_ends, marks_, count_, nodes, chunk_size_);
    launch(device_, level_kernel("topdown_scatter"), "scatter", chunks, level, firsts, from, centres_, chunk_counts_,
           to, chunk_bounds_, nodes, chunks, chunk_size_);
    const std::uint32_t small_nodes = count_next(nodes);
    launch(device_, level_kernel("topdown_emit"), "emit", nodes, level, node_bins_, to, chunk_bounds_, kinds_, chunks_,
           next, first_chunks_[1 - parity], small_nodes_, topology_.order, nodes, small_count_,
           std::uint32_t{parity ? NODE_OTHER : 0u}, chunk_size_);
    small_count_ += small_nodes;
}

/// Level by level while there are large nodes.
void TopDownBuild::split_levels() {
    for (std::uint32_t parity = 0; node_count_ > 0; parity = 1 - parity) split_level(parity);
}

void TopDownBuild::build_subtrees() {
    // Short slices: how long a subtree takes shows only when it is built.
    const std::uint32_t most = 16 * device_.tuning().work_items;
    const std::uint32_t length = small_count_ == 0 ? 1 : (small_count_ - 1) / most + 1;
    const std::uint32_t slices = small_count_ == 0 ? 0 : (small_count_ - 1) / length + 1;
    launch(device_, {"build/topdown_subtrees.cl", "topdown_subtrees", split_defines_, source_}, "subtrees", slices,
           small_nodes_, records_[0], records_[1], centres_, tree_bounds_, areas_, area_starts_, thresholds_,
           topology_.order, topology_.children, topology_.parents, topology_.far_ends, marks_, count_, small_count_,
           length);
}

void TopDownBuild::sum_marks(TopDownTree& tree) {
    const Slices slices = cut(device_, count_);
    Buffer<std::uint32_t> sums = make_scratch<std::uint32_t>(device_, 3 * slices.slices, "sums of marks");
    launch(device_, root_kernel("topdown_sum_marks"), "sum marks", slices.slices, marks_, sums, count_, slices.length);
    const std::vector<std::uint32_t> found = download(device_, sums);
    for (std::size_t i = 0; i < found.size(); i += 3) {
        tree.splits += found[i];
        tree.axes_tried += found[i + 1];
        tree.fallbacks += found[i + 2];
    }
}

} // namespace

void check(const TopDownOptions& options) {
    const auto not_negative = [](float value) { return value >= 0.0f; };
    require(options.bins >= 2 && options.bins <= 64, "bins", "are not from 2 to 64");
    require(options.primitives_per_bin >= 1 && options.primitives_per_bin <= 1000, "primitives_per_bin",
            "is not from 1 to 1000");
    require(options.block_size == 1 || options.block_size == 4, "block_size", "is neither 1 nor 4");
    require(options.max_levels >= 1 && options.max_levels <= 1000, "max_levels", "is not from 1 to 1000");
    require(not_negative(options.max_leaf_cost), "max_leaf_cost", "is negative");
    require(not_negative(options.max_leaf_area), "max_leaf_area", "is negative");
    require(not_negative(options.max_leaf_hit_probability), "max_leaf_hit_probability", "is negative");
    require(options.split_plane_quality >= 0.0f && options.split_plane_quality <= 1.0f, "split_plane_quality",
            "is not in [0, 1]");
    require(not_negative(options.acceptable_children), "acceptable_children", "is negative");
    require(not_negative(options.excellent_children), "excellent_children", "is negative");
    for (const auto& [option, text] : {std::pair{"measure", &options.measure},
                                       {"cost", &options.cost},
                                       {"axes", &options.axes},
                                       {"stop", &options.stop},
                                       {"fallback_measure", &options.fallback_measure},
                                       {"fallback_axes", &options.fallback_axes}})
        require(is_name(*text), option, "is not the name of a function");
}

TopDownBytes topdown_bytes(const Device& device, std::uint64_t primitives, std::uint32_t bins) {
    const LevelSize most = largest_level(primitives, chunk_size_for(device, primitives));
    const std::uint64_t records = sizeof(cl_float8) * primitives;
    const std::uint64_t bins_of_chunks = sizeof(cl_float8) * 3 * bins * most.chunks;
    const std::uint64_t slots = (sizeof(cl_float8) + 4) * 3 * bins * (most.chunks + most.nodes);
    const std::uint64_t nodes = (2 * (sizeof(LargeNode) + 4) + 12) * most.nodes + 2 * sizeof(cl_float8) * most.chunks;
    return {2 * records + slots + nodes + (sizeof(SmallNode) / 2 + 4) * primitives, std::max(records, bins_of_chunks)};
}

TopDownTree topdown_within(Device& device, BufferView<const Aabb> boxes, BufferView<const float> centres,
                           Buffer<std::uint32_t> offsets, BufferView<const Aabb> tree_bounds,
                           BufferView<const InfluenceRecord> areas, BufferView<const std::uint32_t> area_starts,
                           const TopDownOptions& options, bool leaves) {
    check(options);
    const std::size_t count = boxes.size();
    TopDownTree tree;
    tree.topology.offsets = std::move(offsets);
    tree.topology.order = make_scratch<std::uint32_t>(device, count, "sorted order");
    tree.topology.children = make_scratch<cl_uint2>(device, count, "children of nodes");
    tree.topology.parents = make_scratch<std::uint32_t>(device, 2 * count, "parents of nodes");
    tree.topology.far_ends = make_scratch<std::uint32_t>(device, count, "ranges of nodes");
    tree.leaves = make_scratch<std::uint32_t>(device, count, "leaves");
    if (count == 0) return tree;
    fill(device, tree.leaves, 0);
    Buffer<std::uint32_t> no_areas;
    if (area_starts.size() == 0) {
        no_areas = make_scratch<std::uint32_t>(device, tree.topology.offsets.size(), "areas of trees");
        fill(device, no_areas, 0);
        area_starts = no_areas;
    }
    TopDownBuild builder(device, centres, tree_bounds, areas, area_starts, options, tree.topology, tree.leaves);
    builder.write_records(boxes);
    builder.emit_roots();
    builder.split_levels();
    builder.build_subtrees();
    if (leaves) builder.sum_marks(tree);
    return tree;
}

TopDownTree topdown(Device& device, BufferView<const Aabb> boxes, BufferView<const float> centres,
                    Buffer<std::uint32_t> offsets, BufferView<const InfluenceRecord> areas,
                    BufferView<const std::uint32_t> area_starts, const TopDownOptions& options) {
    Buffer<Aabb> bounds;
    if (boxes.size() > 0) bounds = bounds_of_trees(device, boxes, offsets);
    return topdown_within(device, boxes, centres, std::move(offsets), bounds, areas, area_starts, options, true);
}

} // namespace boxwood
