// SPDX-License-Identifier: MIT
// Pictures of a tree: what each pixel's ray meets, and what finding it cost (dissertation figures 12 and 13).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "boxwood/geometry.hpp"
#include "boxwood/image.hpp"
#include "boxwood/trace.hpp"

namespace boxwood {

/// A kind of channels that render adds to the shading:
/// - depth: "depth.Z", distance from the ray's origin along the ray; infinity where it meets nothing.
/// - normal: "normal.X/.Y/.Z", the triangle's normal in world space, normalised, towards the camera; else 0.
/// - instance: "instance.id", index into Scene::instances; else 4294967295.
/// - primitive: "primitive.id", index of the triangle within its mesh; else 4294967295.
/// - cost: "cost.volumes" and "cost.primitives", bounding volumes and triangles tested for the pixel's ray.
enum class Aov { depth, normal, instance, primitive, cost };

/// The words used on the command line and in reports, in the order of the enumeration.
std::string_view name(Aov aov);
/// All of them. to_aov throws InputError listing them.
std::vector<Aov> all_aovs();
Aov to_aov(std::string_view word);

/// What to render.
struct RenderOptions {
    std::uint32_t width = 1024; ///< 1 to 2^23.
    std::uint32_t height = 1024;
    std::vector<Aov> aovs; ///< Beside the shading. Statistics are counted only when cost is among them.
    TraceOptions trace;
};

/// One ray per pixel through `tree`, which was built of the scene in `geometry`. The image has the channels R, G, B
/// (linear shading of the normal under fixed lights without shadows, the background's gradient where nothing is met)
/// and those of options.aovs. Throws InputError for a resolution out of range, CapacityError when it does not fit.
Image render(Device& device, const Tree& tree, const Geometry& geometry, const Camera& camera,
             const RenderOptions& options = {});

/// The channels R, G, B of `image` as 8-bit sRGB, 3 * width * height bytes. Throws InputError without them.
std::vector<std::uint8_t> shading_preview(const Image& image);

/// A heat map of the channel "cost.volumes" as 8-bit sRGB, 3 * width * height bytes.
struct HeatMap {
    std::vector<std::uint8_t> rgb;
    std::uint32_t top = 0; ///< Count at the bright end of the map: the 99.5th percentile; larger ones are clamped.
};
/// Throws InputError without that channel.
HeatMap cost_preview(const Image& image);

} // namespace boxwood
