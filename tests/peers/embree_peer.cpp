// SPDX-License-Identifier: MIT
#include "embree_peer.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <thread>

#if defined(__SSE3__) || defined(__x86_64__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "workload.hpp"

namespace boxwood::peers {

namespace {

/// Embree asks for this in every thread that calls it.
void flush_denormals() {
#if defined(__x86_64__)
    _mm_setcsr(_mm_getcsr() | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
#endif
}

RTCRay to_embree(const Ray& ray) {
    RTCRay out{};
    out.org_x = ray.origin[0];
    out.org_y = ray.origin[1];
    out.org_z = ray.origin[2];
    out.dir_x = ray.direction[0];
    out.dir_y = ray.direction[1];
    out.dir_z = ray.direction[2];
    out.tnear = ray.t_min;
    out.tfar = ray.t_max;
    out.mask = 0xffffffffu;
    return out;
}

/// Runs `work(i)` for every i below `count` on all cores, in chunks taken as threads become free.
template <class Work>
double on_all_cores(std::size_t count, const Work& work) {
    constexpr std::size_t chunk = 1024;
    std::atomic<std::size_t> next = 0;
    const auto run = [&] {
        flush_denormals();
        for (std::size_t first = next.fetch_add(chunk); first < count; first = next.fetch_add(chunk))
            for (std::size_t i = first; i < std::min(first + chunk, count); ++i) work(i);
    };
    return milliseconds([&] {
        std::vector<std::jthread> threads;
        for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(run);
    });
}

} // namespace

EmbreePeer::EmbreePeer() : device_(rtcNewDevice(nullptr)) {}

EmbreePeer::~EmbreePeer() {
    if (scene_) rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

double EmbreePeer::build(const Mesh& mesh, RTCBuildQuality quality, bool robust) {
    if (scene_) rtcReleaseScene(scene_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, quality);
    rtcSetSceneFlags(scene_, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             mesh.positions.size());
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(vertices));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                              mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<glm::uvec3*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    return milliseconds([&] { rtcCommitScene(scene_); });
}

double EmbreePeer::closest_hit(std::span<const Ray> rays, std::span<Hit> hits) const {
    return on_all_cores(rays.size(), [&](std::size_t i) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{to_embree(rays[i]), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            hits[i] = {std::numeric_limits<float>::infinity(), 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
        else
            hits[i] = {query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID, 0};
    });
}

double EmbreePeer::any_hit(std::span<const Ray> rays, std::span<std::uint32_t> hits) const {
    return on_all_cores(rays.size(), [&](std::size_t i) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay query = to_embree(rays[i]);
        rtcOccluded1(scene_, &context, &query);
        hits[i] = query.tfar < 0.0f ? 1u : 0u;
    });
}

} // namespace boxwood::peers
