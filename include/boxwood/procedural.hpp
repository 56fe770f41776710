// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood {

/// Size and seed of a procedural scene; 0 means the kind's own default.
struct ProceduralOptions {
    std::uint64_t triangles = 0; ///< Wanted to be stored; reached from below as closely as the shape allows.
    std::uint64_t instances = 0; ///< Wanted number of instances, for the kinds that have them.
    std::uint64_t seed = 1;
};

/// A kind of procedural scene, for listings.
struct ProceduralKind {
    std::string name;
    std::string description;
};

/// cornell, random (triangles), terrain, sphere, forest (instanced), menger (sponge), hair, planks, materials.
std::vector<ProceduralKind> procedural_kinds();

/// Makes a scene with a camera that shows it. The same kind and options give the same bytes on every machine.
/// Throws InputError for an unknown kind (listing the kinds) or a count of 2^31 or more. O(triangles + instances).
Scene make_procedural(std::string_view kind, const ProceduralOptions& options = {});

} // namespace boxwood
