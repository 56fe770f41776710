// SPDX-License-Identifier: MIT
#include "runtime/language.hpp"

#include <doctest/doctest.h>

#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;
using boxwood::detail::choose_language;

TEST_SUITE_BEGIN("runtime");

namespace {

constexpr cl_device_atomic_capabilities relaxed = CL_DEVICE_ATOMIC_ORDER_RELAXED | CL_DEVICE_ATOMIC_SCOPE_WORK_GROUP;
constexpr cl_device_atomic_capabilities order = CL_DEVICE_ATOMIC_ORDER_ACQ_REL, scope = CL_DEVICE_ATOMIC_SCOPE_DEVICE;
constexpr cl_version c30 = CL_MAKE_VERSION(3, 0, 0), c12 = CL_MAKE_VERSION(1, 2, 0), c11 = CL_MAKE_VERSION(1, 1, 0);

} // namespace

TEST_CASE("language: OpenCL C 3.0 only with acquire and release at device scope, which a 3.0 device need not have") {
    CHECK(choose_language({"OpenCL 3.0 PoCL", {c12, c30}, relaxed | order | scope}) == "CL3.0");
    for (const cl_device_atomic_capabilities less :
         {cl_device_atomic_capabilities(0), relaxed, relaxed | order, relaxed | scope})
        CHECK(choose_language({"OpenCL 3.0 CUDA", {c11, c12, c30}, less}) == "CL1.2");
    CHECK(choose_language({"OpenCL 3.0 without C 3.0", {c12}, relaxed | order | scope}) == "CL1.2");
}

TEST_CASE("language: older devices take 1.2 whatever they list; without it there is none") {
    CHECK(choose_language({"OpenCL 1.2 (Oclgrind 21.10)", {c12, c30}, relaxed | order | scope}) == "CL1.2");
    CHECK(choose_language({"OpenCL 1.2 old"}) == "CL1.2");
    CHECK(choose_language({"OpenCL 2.1 old"}) == "CL1.2");
    CHECK(choose_language({"OpenCL 1.1 older"}) == "");
    CHECK(choose_language({"OpenCL 3.0 bare", {c30}, relaxed}) == "");
}

TEST_CASE("language: the device under test was asked") {
    const std::string& language = test_device().info().language;
    CHECK((language == "CL3.0" || language == "CL1.2"));
}
