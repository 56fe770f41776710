// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/build.hpp"

namespace boxwood {

/// A tree that follows an animated scene (dissertation 3.1.4): it keeps what an update needs beside the tree. Every
/// update leaves tree() as valid as a new build of the scene as it then is; hits may differ in rounding only.
class AnimatedTree {
public:
    /// Builds as build() does. The scene is kept.
    AnimatedTree(Device& device, Scene scene, const BuildOptions& options = {});
    ~AnimatedTree();
    AnimatedTree(AnimatedTree&&) noexcept;
    AnimatedTree& operator=(AnimatedTree&&) noexcept;

    /// The scene as it is now; after deform() its instances carry the deformation.
    const Scene& scene() const;
    const Tree& tree() const;

    /// New transforms of all instances, M_i = M_o M_m: rebuilds the top level alone. Throws InputError when they are not as
    /// many as the instances, one is not affine, finite and invertible, or the tree has one level. O(instances).
    void move_instances(const std::vector<glm::mat4>& transforms);

    /// A linear deformation M_d of a mesh, M_m M_d: every instance of it takes `map` before its own transform, and the top
    /// level is rebuilt; the bottom level stays. Throws as move_instances does. O(instances).
    void deform(std::uint32_t mesh, const glm::mat4& map);

    /// New positions of the vertices of a mesh, as many as it has, each finite and within largest_coordinate: the
    /// volumes are fitted again over the same topology. Slower rays than a rebuild when the shape changes much.
    void refit(std::uint32_t mesh, const std::vector<glm::vec3>& positions);

    /// Builds everything anew.
    void rebuild();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace boxwood
