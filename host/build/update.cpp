// SPDX-License-Identifier: MIT
#include "boxwood/update.hpp"

#include <span>
#include <string>
#include <utility>

#include "boxwood/error.hpp"
#include "build/options.hpp"
#include "build/pipeline.hpp"
#include "scene/transform.hpp"

namespace boxwood {

/// Of the parts of the build only what updates read is kept: positions and triangles, and of the bottom level the
/// topology and the boxes of whole meshes.
struct AnimatedTree::State {
    Device& device;
    Scene scene;
    BuildOptions options;  ///< As they were given: how many levels a rebuild takes is for the scene to say.
    BuildOptions resolved; ///< As the tree was built.
    Tree tree;
    BuildParts parts;
    std::vector<MeshBounds> mesh_bounds;

    void check_mesh(const char* call, std::uint32_t mesh) const;
    void check_two_levels(const char* call) const;
    void place(std::vector<glm::mat4>& transforms);
    Buffer<float> changed_positions(std::uint32_t mesh, const std::vector<glm::vec3>& positions) const;
    Tree fit(Buffer<float>& positions);
};

namespace {

std::string element(const char* array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

/// Releases what no update reads.
void keep_for_updates(BuildParts& parts) {
    parts.geometry.meshes = {};
    parts.geometry.instances = {};
    parts.bottom.volumes = {};
    parts.bottom.boxes = {};
    parts.top = {};
}

void swap_transforms(Scene& scene, std::vector<glm::mat4>& transforms) {
    for (std::size_t i = 0; i < transforms.size(); ++i) std::swap(scene.instances[i].transform, transforms[i]);
}

void check_placement(const char* call, const std::string& where, const glm::mat4& transform, const MeshBounds& bounds) {
    const std::string_view fault = placement_fault(transform, bounds);
    if (!fault.empty()) throw InputError(call, where, std::string(fault));
}

MeshBounds checked_bounds(const std::vector<glm::vec3>& positions, const Mesh& mesh) {
    if (positions.size() != mesh.positions.size())
        throw InputError("refit", "positions",
                         "are " + std::to_string(positions.size()) + ", but the mesh has " +
                             std::to_string(mesh.positions.size()) + " vertices");
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (!in_range(positions[i]))
            throw InputError("refit", element("positions", i), "is not finite or out of range");
    return mesh_bounds(positions);
}

} // namespace

void AnimatedTree::State::check_mesh(const char* call, std::uint32_t mesh) const {
    if (mesh >= scene.meshes.size())
        throw InputError(call, "mesh " + std::to_string(mesh),
                         "is out of range; the scene has " + std::to_string(scene.meshes.size()));
}

void AnimatedTree::State::check_two_levels(const char* call) const {
    if (!tree.empty() && tree.levels() != Levels::two)
        throw InputError(call, "levels", "are one; instances move under a tree of two, so build with levels two");
}

/// Exchanges the transforms of all instances with `transforms`, as many, and builds the top level anew.
void AnimatedTree::State::place(std::vector<glm::mat4>& transforms) {
    if (transforms.empty()) return;
    swap_transforms(scene, transforms);
    TreeArrays next = start_tree(resolved, scene_sphere(scene));
    try {
        build_top_level(device, scene, resolved, parts, next);
        device.finish();
    } catch (...) {
        swap_transforms(scene, transforms);
        keep_for_updates(parts);
        throw;
    }
    keep_for_updates(parts);
    next.bottom = std::move(tree.arrays().bottom);
    tree = Tree(std::move(next));
}

/// The positions on the device with those of `mesh` replaced, wherever the tree has them: once for two levels, for one
/// as flatten() places every instance of it.
Buffer<float> AnimatedTree::State::changed_positions(std::uint32_t mesh,
                                                     const std::vector<glm::vec3>& positions) const {
    const Buffer<float>& old = parts.geometry.positions;
    Buffer<float> changed = make_buffer<float>(device, old.size(), "positions");
    copy(device, old, changed);
    const auto overwrite = [&](std::size_t first, const std::vector<glm::vec3>& with) {
        const std::span<const float> scalars(reinterpret_cast<const float*>(with.data()), 3 * with.size());
        write(device, scalars, changed.view(), 3 * first);
    };
    std::size_t first = 0;
    if (tree.levels() == Levels::two) {
        for (std::uint32_t m = 0; m < mesh; ++m) first += scene.meshes[m].positions.size();
        overwrite(first, positions);
        return changed;
    }
    for (const Instance& instance : scene.instances) {
        if (instance.mesh == mesh) {
            std::vector<glm::vec3> placed;
            placed.reserve(positions.size());
            append_transformed(positions, instance.transform, placed);
            overwrite(first, placed);
        }
        first += scene.meshes[instance.mesh].positions.size();
    }
    return changed;
}

/// The tree over the same topology with the triangles of `scene` at `positions`, which are exchanged with those in
/// `parts`.
Tree AnimatedTree::State::fit(Buffer<float>& positions) {
    Buffer<Aabb> tree_bounds;
    Buffer<Obb> mesh_boxes;
    const auto exchange = [&] {
        std::swap(parts.geometry.positions, positions);
        std::swap(parts.bottom.tree_bounds, tree_bounds);
        std::swap(parts.mesh_boxes, mesh_boxes);
    };
    TreeArrays next = start_tree(resolved, scene_sphere(scene));
    exchange();
    try {
        refit_bottom_level(device, parts);
        finish_tree(device, scene, resolved, parts, next);
    } catch (...) {
        exchange();
        keep_for_updates(parts);
        throw;
    }
    keep_for_updates(parts);
    next.first_triangles = std::move(tree.arrays().first_triangles);
    return Tree(std::move(next));
}

AnimatedTree::AnimatedTree(Device& device, Scene scene, const BuildOptions& options)
    : state_(new State{device, std::move(scene), options, {}, {}, {}, {}}) {
    if (!options.areas.empty())
        throw InputError("animated tree", "areas", "are not kept while triangles move; build without influence areas");
    for (const Mesh& mesh : state_->scene.meshes) state_->mesh_bounds.push_back(mesh_bounds(mesh.positions));
    rebuild();
}

AnimatedTree::~AnimatedTree() = default;
AnimatedTree::AnimatedTree(AnimatedTree&&) noexcept = default;
AnimatedTree& AnimatedTree::operator=(AnimatedTree&&) noexcept = default;

const Scene& AnimatedTree::scene() const { return state_->scene; }
const Tree& AnimatedTree::tree() const { return state_->tree; }

void AnimatedTree::move_instances(const std::vector<glm::mat4>& transforms) {
    const Scene& scene = state_->scene;
    state_->check_two_levels("move_instances");
    if (transforms.size() != scene.instances.size())
        throw InputError("move_instances", "transforms",
                         "are " + std::to_string(transforms.size()) + ", but the scene has " +
                             std::to_string(scene.instances.size()) + " instances");
    for (std::size_t i = 0; i < transforms.size(); ++i)
        check_placement("move_instances", element("transforms", i), transforms[i],
                        state_->mesh_bounds[scene.instances[i].mesh]);
    std::vector<glm::mat4> exchanged = transforms;
    state_->place(exchanged);
}

void AnimatedTree::deform(std::uint32_t mesh, const glm::mat4& map) {
    const Scene& scene = state_->scene;
    state_->check_two_levels("deform");
    state_->check_mesh("deform", mesh);
    if (const std::string_view fault = transform_fault(map); !fault.empty())
        throw InputError("deform", "map", std::string(fault));
    std::vector<glm::mat4> transforms;
    transforms.reserve(scene.instances.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        transforms.push_back(instance.transform);
        if (instance.mesh != mesh) continue;
        transforms.back() = glm::mat4(glm::dmat4(instance.transform) * glm::dmat4(map));
        check_placement("deform", element("instances", i) + ".transform", transforms.back(), state_->mesh_bounds[mesh]);
    }
    state_->place(transforms);
}

void AnimatedTree::refit(std::uint32_t mesh, const std::vector<glm::vec3>& positions) {
    State& state = *state_;
    state.check_mesh("refit", mesh);
    const MeshBounds bounds = checked_bounds(positions, state.scene.meshes[mesh]);
    for (std::size_t i = 0; i < state.scene.instances.size(); ++i)
        if (state.scene.instances[i].mesh == mesh)
            check_placement("refit", element("instances", i) + ".transform", state.scene.instances[i].transform,
                            bounds);
    std::vector<glm::vec3> exchanged = positions;
    std::swap(state.scene.meshes[mesh].positions, exchanged);
    if (!state.tree.empty()) {
        try {
            Buffer<float> changed = state.changed_positions(mesh, positions);
            state.tree = state.fit(changed);
        } catch (...) {
            std::swap(state.scene.meshes[mesh].positions, exchanged);
            throw;
        }
    }
    state.mesh_bounds[mesh] = bounds;
}

void AnimatedTree::rebuild() {
    State& state = *state_;
    BuildOptions resolved = resolve(state.scene, state.options);
    TreeArrays tree = start_tree(resolved, {});
    BuildParts parts;
    if (!state.scene.instances.empty()) {
        tree = build_tree(state.device, state.scene, resolved, parts);
        keep_for_updates(parts);
    }
    state.resolved = std::move(resolved);
    state.parts = std::move(parts);
    state.tree = Tree(std::move(tree));
}

} // namespace boxwood
