// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "boxwood/scene.hpp"

namespace boxwood {

/// Reads a glTF 2.0 scene (.gltf or .glb): the default scene, else scene 0, else every root node. One Mesh per glTF
/// mesh that is used (its triangle primitives concatenated), with its attributes and materials, one Instance per node
/// with a mesh and per EXT_mesh_gpu_instancing transform, in depth-first node order. Morph targets are added by the
/// weights of the mesh or node, with a Mesh for each choice of weights. A skinned mesh is where its joints have it at
/// rest, whatever the transform of its node; for each node that shows one, and for each whose transform flattens a mesh
/// to a sheet, there is a Mesh in world space with an identity instance. Animations are not read.
/// Materials, textures with their pictures (PNG or JPEG) and the lights of KHR_lights_punctual come along; what of
/// materials cannot be used is replaced or left out with a warning (a picture that is missing, a number out of range).
/// Each extension that the file uses and that is not read is a warning saying what stands in for it; so is what shows
/// nothing (a mesh that no node shows or without triangles), and what exporters get wrong without harm (null,
/// references of -1, forbidden strides). Throws InputError naming the file and the element, also for a required
/// extension that changes geometry and is not supported, and for a file that asks for more than 2^24 elements without
/// data, or for more memory than there is.
Scene load_gltf(const std::filesystem::path& file);

/// Writes `scene` as binary glTF (meshes, nodes, cameras, materials, pictures, lights), atomically: on failure no file
/// is left under `file`. Loading it again gives an equal scene, but for numbers that nothing reads, such as a cutoff
/// without its alpha mode, for turned transforms of textures, which are rounded, and for sheared ones, which lose the
/// shear. Throws InputError when the file would pass 4 GiB, and OutputError when it cannot be written.
void save_glb(const std::filesystem::path& file, const Scene& scene);

} // namespace boxwood
