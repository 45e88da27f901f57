// SPDX-License-Identifier: MIT
#pragma once

// The one place that knows the version of Embree: 3 and 4 differ in the header and in how queries take their
// arguments.
#if GOFFER_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <type_traits>

namespace goffer::view {

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease>;

/// Finds the nearest hit along `ray` and writes it into `ray`.
inline void embree_intersect(RTCScene scene, RTCRayHit& ray) {
#if GOFFER_EMBREE >= 4
    rtcIntersect1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#endif
}

/// Looks for any hit along `ray`; if there is one, tfar becomes negative.
inline void embree_occluded(RTCScene scene, RTCRay& ray) {
#if GOFFER_EMBREE >= 4
    rtcOccluded1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

}  // namespace goffer::view
