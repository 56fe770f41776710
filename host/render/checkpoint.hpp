// SPDX-License-Identifier: MIT
// The bytes of Render::state(): a film between two samples.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "boxwood/render.hpp"
#include "render/path.hpp"

namespace boxwood {

/// Number that differs, but for a chance of 2^-64, between renders that would not give the same samples: of the device,
/// the version of Boxwood, all arrays of the scene, environment, camera and the options that decide about light; for
/// Integrator::cost, the nodes of the tree too. Reads the scene back from the device. O(size of the scene).
std::uint64_t render_fingerprint(Device& device, const World& world, const Camera& camera,
                                 const RenderOptions& options);

/// A film and how many samples are in it.
struct Checkpoint {
    std::uint32_t samples = 0;
    std::vector<float> film;
};

std::vector<std::byte> encode_checkpoint(const Checkpoint& checkpoint, std::uint64_t fingerprint);

/// Throws InputError naming `file` when the bytes are damaged, of another version, have another fingerprint, or not
/// `floats` floats and at most `most_samples` samples.
Checkpoint decode_checkpoint(std::span<const std::byte> bytes, std::uint64_t fingerprint, std::size_t floats,
                             std::uint32_t most_samples, std::string_view file);

} // namespace boxwood
