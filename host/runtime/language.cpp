// SPDX-License-Identifier: MIT
#include "runtime/language.hpp"

#include <algorithm>

namespace boxwood::detail {

namespace {

bool has_dialect(const LanguageOffer& offer, unsigned major, unsigned minor) {
    return std::any_of(offer.dialects.begin(), offer.dialects.end(), [&](cl_version each) {
        return CL_VERSION_MAJOR(each) == major && CL_VERSION_MINOR(each) >= minor;
    });
}

} // namespace

std::string choose_language(const LanguageOffer& offer) {
    constexpr cl_device_atomic_capabilities hand_off = CL_DEVICE_ATOMIC_ORDER_ACQ_REL | CL_DEVICE_ATOMIC_SCOPE_DEVICE;
    // By the version too: Oclgrind, a 1.2 device, lists 3.0 and then refuses it.
    const bool version_3 = offer.version.starts_with("OpenCL 3");
    if (version_3 && has_dialect(offer, 3, 0) && (offer.atomics & hand_off) == hand_off) return "CL3.0";
    const bool old = offer.version.starts_with("OpenCL 1.0") || offer.version.starts_with("OpenCL 1.1");
    return old || (version_3 && !has_dialect(offer, 1, 2)) ? "" : "CL1.2";
}

} // namespace boxwood::detail
