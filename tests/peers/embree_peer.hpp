// SPDX-License-Identifier: MIT
// Embree 3 behind the same calls as Boxwood, so that both are measured alike.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <embree3/rtcore.h>

#include "boxwood/scene.hpp"
#include "shared/ray.h"

namespace boxwood::peers {

/// One mesh committed to an Embree scene.
class EmbreePeer {
public:
    EmbreePeer();
    ~EmbreePeer();
    EmbreePeer(const EmbreePeer&) = delete;
    EmbreePeer& operator=(const EmbreePeer&) = delete;

    /// Builds a new tree over `mesh` with all of Embree's threads, in place of the last; returns the milliseconds that
    /// rtcCommitScene took.
    /// `robust` asks for RTC_SCENE_FLAG_ROBUST.
    double build(const Mesh& mesh, RTCBuildQuality quality, bool robust);

    /// rtcIntersect1 for each ray, on one std::thread per core; returns milliseconds. An interval [t_min, t_max] here.
    double closest_hit(std::span<const Ray> rays, std::span<Hit> hits) const;
    /// rtcOccluded1 for each ray, likewise.
    double any_hit(std::span<const Ray> rays, std::span<std::uint32_t> hits) const;

private:
    RTCDevice device_;
    RTCScene scene_ = nullptr;
};

} // namespace boxwood::peers
