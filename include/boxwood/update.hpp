// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/build.hpp"

namespace boxwood {

/// A tree that follows an animated scene (dissertation 3.1.4): it keeps what an update needs beside the tree,
/// positions, triangles and topology on the device. Every update leaves tree() as valid as a new build of the scene as
/// it then is; hits may differ in rounding only. Whatever an update throws, tree() and scene() are then as they were,
/// for which the old and the new of what changes are held at once. Updates throw InputError as said, and what build()
/// throws, which may come in the middle of the work. With no instances there is no tree, and updates change the scene
/// alone.
class AnimatedTree {
public:
    /// Builds as build() does. The scene, which must be valid, is kept; the device must outlive this.
    AnimatedTree(Device& device, Scene scene, const BuildOptions& options = {});
    ~AnimatedTree();
    AnimatedTree(AnimatedTree&&) noexcept;
    AnimatedTree& operator=(AnimatedTree&&) noexcept;

    /// The scene as it is now; after deform() its instances carry the deformation.
    const Scene& scene() const;
    const Tree& tree() const;

    /// New transforms of all instances, M_i = M_o M_m, in place of those they had: rebuilds the top level alone. Throws
    /// InputError when they are not as many as the instances, one is not affine, finite and invertible, one moves its
    /// mesh beyond largest_coordinate, or the tree has one level. O(instances).
    void move_instances(const std::vector<glm::mat4>& transforms);

    /// A linear deformation M_d of a mesh, M_m M_d: every instance of it takes `map` before its own transform, in
    /// double and rounded once, and the top level is rebuilt; the bottom level stays. Throws InputError when there is
    /// no such mesh, and as move_instances does. O(instances).
    void deform(std::uint32_t mesh, const glm::mat4& map);

    /// New positions of the vertices of a mesh: the volumes are fitted again over the same topology, and the top level
    /// is rebuilt. Slower rays than a rebuild when the shape changes much. Throws InputError when there is no such
    /// mesh, the positions are not as many as it has, or one is not finite or not within largest_coordinate, in object
    /// space or where an instance places it. Costs what the volumes and the layout of a build of the whole scene cost.
    void refit(std::uint32_t mesh, const std::vector<glm::vec3>& positions);

    /// Builds everything anew, as build() does.
    void rebuild();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace boxwood
