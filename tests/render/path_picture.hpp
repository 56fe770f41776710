// SPDX-License-Identifier: MIT
// Small pictures by trace_paths, for tests and benchmarks that compare light.
#pragma once

#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/build.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"
#include "render/camera.hpp"
#include "render/path.hpp"

namespace boxwood::test {

/// A scene on a device with all that light needs.
struct LitScene {
    Tree tree;
    Geometry geometry;
    Appearance appearance;
    EnvironmentMap environment;

    LitScene(Device& device, const Scene& scene, const Environment& around = {}, const BuildOptions& options = {})
        : tree(build(device, scene, options)), geometry(upload(device, scene)),
          environment(upload_environment(device, around)) {
        std::vector<std::string> warnings;
        appearance = upload_appearance(device, scene, shading_requirements(scene), warnings);
    }
    World world() const { return {tree, geometry, appearance, environment}; }
};

/// Sums of samples, 3 values per pixel, rows top to bottom.
struct Picture {
    std::vector<double> direct, indirect;
    std::size_t unusable = 0; ///< Values of a sample that are negative or not finite.

    double light(std::size_t i) const { return direct[i] + indirect[i]; }
};

/// A grid of pixels and how it is cut into batches.
struct Frame {
    std::uint32_t width = 8, height = 8;
    std::uint32_t batch = 0; ///< Pixels per batch; 0: all in one.
    bool backwards = false;  ///< Last batch first.
    bool jitter = false;     ///< Samples at different places of their pixels, of a golden-ratio sequence.
};

/// The light of one sample of some pixels, direct then indirect.
inline std::vector<float> batch_light(Device& device, const LitScene& lit, const LightOptions& options,
                                      std::uint32_t sample, BufferView<const CameraRecord> record, std::uint32_t first,
                                      std::uint32_t count) {
    Buffer<Ray> rays = make_buffer<Ray>(device, count, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, count, "hits");
    Buffer<float> direct = make_buffer<float>(device, 3 * std::size_t{count}, "direct");
    Buffer<float> indirect = make_buffer<float>(device, 3 * std::size_t{count}, "indirect");
    primary_rays(device, record, first, rays);
    closest_hit(device, lit.tree, rays, hits);
    trace_paths(device, lit.world(), options, sample, {record, rays, hits, first}, {direct, indirect});
    std::vector<float> light = download(device, direct);
    const std::vector<float> more = download(device, indirect);
    light.insert(light.end(), more.begin(), more.end());
    return light;
}

/// Samples 0 .. options.samples - 1, averaged.
inline Picture take_picture(Device& device, const LitScene& lit, const Camera& camera, const Frame& frame,
                            const LightOptions& options) {
    const std::uint32_t pixels = frame.width * frame.height, batch = frame.batch == 0 ? pixels : frame.batch;
    const std::uint32_t batches = (pixels + batch - 1) / batch;
    Picture picture{std::vector<double>(3 * std::size_t{pixels}), std::vector<double>(3 * std::size_t{pixels}), 0};
    for (std::uint32_t sample = 0; sample < options.samples; ++sample) {
        glm::vec2 jitter(0.0f);
        if (frame.jitter) jitter = 2.0f * glm::fract((float(sample) + 0.5f) * glm::vec2(0.7548777f, 0.5698403f)) - 1.0f;
        const Buffer<CameraRecord> record = upload_camera(device, camera, frame.width, frame.height, jitter);
        for (std::uint32_t b = 0; b < batches; ++b) {
            const std::uint32_t first = (frame.backwards ? batches - 1 - b : b) * batch;
            const std::uint32_t count = std::min(batch, pixels - first);
            const std::vector<float> light = batch_light(device, lit, options, sample, record, first, count);
            for (std::size_t i = 0; i < light.size(); ++i) {
                const bool second = i >= 3 * std::size_t{count};
                const std::size_t at = 3 * std::size_t{first} + i - (second ? 3 * std::size_t{count} : 0);
                (second ? picture.indirect : picture.direct)[at] += double(light[i]) / options.samples;
                if (!(light[i] >= 0.0f && std::isfinite(light[i]))) ++picture.unusable;
            }
        }
    }
    return picture;
}

/// Mean over the pixels and channels of several pictures of different seeds, and the standard error of that mean.
struct Estimate {
    double mean = 0.0, error = 0.0;
    std::uint32_t repeats = 2;

    /// How far from the mean the true one may be: as improbable as three standard errors that are known, though this
    /// one comes from a few pictures (quantiles of Student's distribution by Wallace 1959, within 2 % from 5 pictures,
    /// wider of fewer); and roundings, some 64 of each light.
    double margin() const {
        const double free = repeats - 1.0, shrunk = free - 2.0 / 3 + 0.1 / free;
        const double quantile = std::sqrt(free * std::expm1(9.0 * (free - 5.0 / 6) / (shrunk * shrunk)));
        return quantile * error + 64 * 0x1p-24 * mean;
    }
};

struct Estimates {
    Estimate direct, indirect, light; ///< The last of their sum.
};

inline Estimate estimate_of(const std::vector<double>& values) {
    double sum = 0.0, square = 0.0;
    for (const double value : values) sum += value;
    const double count = double(values.size()), mean = sum / count;
    for (const double value : values) square += (value - mean) * (value - mean);
    return {mean, std::sqrt(square / (count * (count - 1))), static_cast<std::uint32_t>(values.size())};
}

inline Estimates estimates(Device& device, const LitScene& lit, const Camera& camera, const Frame& frame,
                           LightOptions options, std::uint32_t repeats) {
    std::vector<double> direct(repeats), indirect(repeats), light(repeats);
    for (std::uint32_t r = 0; r < repeats; ++r) {
        const Picture picture = take_picture(device, lit, camera, frame, options);
        const double count = double(picture.direct.size());
        direct[r] = std::accumulate(picture.direct.begin(), picture.direct.end(), 0.0) / count;
        indirect[r] = std::accumulate(picture.indirect.begin(), picture.indirect.end(), 0.0) / count;
        light[r] = direct[r] + indirect[r];
        ++options.seed;
    }
    return {estimate_of(direct), estimate_of(indirect), estimate_of(light)};
}

inline Estimate estimate(Device& device, const LitScene& lit, const Camera& camera, const Frame& frame,
                         const LightOptions& options, std::uint32_t repeats) {
    return estimates(device, lit, camera, frame, options, repeats).light;
}

} // namespace boxwood::test
