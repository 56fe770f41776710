// SPDX-License-Identifier: MIT
// Pictures of a scene: light by one of the integrators, and what each pixel met and cost (dissertation 3.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/environment.hpp"
#include "boxwood/image.hpp"
#include "boxwood/render_options.hpp"
#include "boxwood/scene.hpp"
#include "boxwood/tree.hpp"

namespace boxwood {

/// A kind of channels beside R, G and B. The first group is of the light, so that it depends on the samples:
/// - direct, indirect: "direct.R/.G/.B" and "indirect.R/.G/.B", linear; their sum is R, G, B (Integrator::ambient: with
///   ambient). What is emitted or reflected once, and what is reflected more often. Integrators path, direct and
///   ambient.
/// - ambient: "ambient.R/.G/.B": what the ambient light adds. Integrator::ambient only.
/// - ao: "ao.A", share of the ambient light that is not occluded, 1 where nothing is met. Integrators ambient and ao.
/// - variance: "variance.Y", variance that the mean of the samples' luminance would have if they were independent;
///   infinity for fewer than two samples. It is the true one for SamplerKind::random; sobol and stratified samples are
///   spread more evenly, and their mean has less (some half of it under a lamp at 16 samples).
/// - samples: "samples.N", samples that entered the mean.
/// The second is of one ray through the centre of each pixel, up to the first surface, whatever its alpha:
/// - depth: "depth.Z", distance from the ray's origin along the ray; infinity where it meets nothing.
/// - normal: "normal.X/.Y/.Z", for shading, in world space, normalised, towards the camera; else 0.
/// - position: "position.X/.Y/.Z" in world space; else 0.
/// - albedo: "albedo.R/.G/.B", base colour, linear; else 0.
/// - instance: "instance.id", index into Scene::instances; else 4294967295.
/// - primitive: "primitive.id", index of the triangle within its mesh; else 4294967295.
/// - material: "material.id", index into Scene::materials, their count for the plain one; else 4294967295.
/// - cost: "cost.volumes" and "cost.primitives", bounding volumes and triangles tested for the ray.
enum class Aov {
    direct,
    indirect,
    ambient,
    ao,
    variance,
    samples,
    depth,
    normal,
    position,
    albedo,
    instance,
    primitive,
    material,
    cost
};

/// The words used on the command line and in reports. to_aov throws InputError listing them.
std::string_view name(Aov aov);
std::vector<Aov> all_aovs();
Aov to_aov(std::string_view word);
/// Whether an integrator's pictures can have these channels.
bool has(Integrator integrator, Aov aov);
/// Each once, in the order of the enumeration.
std::vector<Aov> without_repetition(std::vector<Aov> aovs);

/// What to render.
struct RenderOptions {
    LightOptions light;
    std::uint32_t width = 1024; ///< 1 to 2^23.
    std::uint32_t height = 1024;
    std::vector<Aov> aovs;
    /// Integrators ambient and ao: the distance, in world units, at which a surface occludes by e^-1; finite, >= 0. The
    /// dissertation has 1 (its occlusion is e^-t); 0 stands for default_ao_distance(scene).
    float ao_distance = 0.0f;
    std::uint32_t batch = 1u << 18; ///< Pixels at a time, at least 1: memory for speed. Pictures do not depend on it.
};

/// A picture that grows: each sample of every pixel is added to the ones before. One that was moved from can be
/// assigned to and destroyed; else it throws Error.
class Render {
public:
    /// Uploads `scene` and `environment`; `tree` was built of the same scene on the same device. Device, scene and tree
    /// stay alive as long as this. Throws InputError for options out of range or that do not go together, for a camera
    /// that upload_camera refuses and a scene that does not validate, CapacityError when the film does not fit, before
    /// any work.
    Render(Device& device, const Scene& scene, const Tree& tree, const Environment& environment, const Camera& camera,
           const RenderOptions& options);
    ~Render();
    Render(Render&&) noexcept;
    Render& operator=(Render&&) noexcept;

    /// What was put in the place of pictures that cannot be used, and the like; one line each.
    const std::vector<std::string>& warnings() const;

    /// One sample of every pixel. Nothing when done(). When it throws, the sample is not counted, some pixels may have
    /// it already, and the next advance() takes it for the others: each pixel gets every sample once.
    void advance();
    std::uint32_t samples() const; ///< Taken so far.
    bool done() const;             ///< All of LightOptions::samples.

    /// The picture so far: R, G, B, linear, 0 before the first sample, then the channels of each AOV once, in the order
    /// of the enumeration. Its attributes tell all options that decide about pixels, samples and camera. Never NaN.
    Image image() const;

    /// Samples of pixels so far that were NaN, infinite or negative, and so left out. None are expected. Waits.
    std::uint64_t rejected_samples() const;

    /// All that a Render of the same arguments needs to go on from here to the same picture, bit by bit. Waits. Throws
    /// Error when some pixels are a sample ahead, after an advance() that threw.
    std::vector<std::byte> state() const;
    /// Goes on from a state. Throws InputError naming `file` when it is damaged, of another version, or of other
    /// arguments (scene, camera, options, or device; batch and AOVs may differ, and so may the tree but for
    /// Integrator::cost, which shows it).
    void restore(std::span<const std::byte> state, std::string_view file);

private:
    struct State;
    State& held() const; ///< Throws Error when moved from.
    std::unique_ptr<State> state_;
};

/// All samples of a Render.
Image render(Device& device, const Scene& scene, const Tree& tree, const Environment& environment, const Camera& camera,
             const RenderOptions& options = {});

/// Whether a scene needs no sky: it has punctual lights, or lamps light it. Those are triangles that emit, when more
/// than half of what leaves them meets a surface, as in a room, and when it is more than 2^-10 of what a sky of
/// radiance 1 would give the scene's box: a sign, a screen or a light-emitting diode on the outside of something does
/// not light it. Textures of emission count as white, surfaces with alpha as opaque. `tree` is of this scene. By 1024
/// rays; the same each time. O(triangles).
bool has_light(Device& device, const Scene& scene, const Tree& tree);

/// Throws CapacityError when the film of a picture of these options does not fit the device, or film and picture
/// together a CPU, whose memory is the host's: known without a scene.
void check_film(const Device& device, const RenderOptions& options);

/// How linear light becomes a preview.
struct PreviewOptions {
    float exposure = 0.0f; ///< Stops: the light is multiplied by 2^exposure.
    /// Khronos PBR Neutral, which shows base colours under white light as they are and brighter ones ever closer to
    /// white; else what is above 1 is cut off.
    bool tone_curve = true;
};

/// The channels R, G, B of `image` as 8-bit sRGB, 3 * width * height bytes. Throws InputError without them, or when one
/// has another size.
std::vector<std::uint8_t> preview(const Image& image, const PreviewOptions& options = {});

/// The exposure that suits `image`: the geometric mean of the median and the 90th percentile of the luminance of its
/// pixels that have any becomes 0.3. 0 for a black picture. Throws InputError without R, G and B, or when one has
/// another size. O(pixels).
float suitable_exposure(const Image& image);

/// A heat map of the channel "cost.volumes" as 8-bit sRGB, 3 * width * height bytes.
struct HeatMap {
    std::vector<std::uint8_t> rgb;
    std::uint32_t top = 0; ///< Count at the bright end of the map: the 99.5th percentile; larger ones are clamped.
};
/// Throws InputError without that channel, or when it has another size.
HeatMap cost_preview(const Image& image);

} // namespace boxwood
