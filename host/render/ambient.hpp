// SPDX-License-Identifier: MIT
// The simplified model of light of dissertation 3.7.7, and ambient occlusion alone (cl/render/ambient.cl).
#pragma once

#include <array>

#include "boxwood/environment.hpp"
#include "render/path.hpp"

namespace boxwood {

/// Irradiance over pi by the normal n, as 9 coefficients of 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2: what a white
/// Lambert surface reflects, from spherical harmonics up to the second degree (Ramamoorthi and Hanrahan 2001), exact to
/// a few percent of the mean. O(pixels).
std::array<glm::dvec3, 9> ambient_coefficients(const Environment& environment);

/// What the model reads beside the World.
struct AmbientLight {
    Buffer<float> coefficients; ///< Of ambient_coefficients.
    std::uint32_t punctual = 0; ///< Lights of the Appearance that are punctual; 0 also when they give no light.
    Buffer<LightNode> nodes;    ///< The tree over them.
};
AmbientLight make_ambient_light(Device& device, const Appearance& appearance, const Environment& environment);

/// Light of one sample of some pixels: 3 floats each, and 1.
struct AmbientSample {
    BufferView<float> direct;   ///< What is emitted towards the camera, and of punctual lights what is reflected once.
    BufferView<float> indirect; ///< All that the surfaces behind the first one add.
    BufferView<float> ambient;  ///< Of the ambient light what is reflected once.
    BufferView<float> ao;       ///< Share of the hemisphere that does not occlude, 1 where nothing is met.
};

/// Sample number `sample` of the pixels of `primary`, by options.depth surfaces of a path each; `distance` is the unit
/// of the occlusion's t. Stages in the profile: shade, shadow, trace, accumulate.
void trace_ambient(Device& device, const World& world, const AmbientLight& around, const LightOptions& options,
                   float distance, std::uint32_t sample, const PrimaryHits& primary, const AmbientSample& light);

/// The same of the occlusion alone; `light` gets it three times.
void trace_occlusion(Device& device, const World& world, const LightOptions& options, float distance,
                     std::uint32_t sample, const PrimaryHits& primary, BufferView<float> light, BufferView<float> ao);

} // namespace boxwood
