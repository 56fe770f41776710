// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <sched.h>

#include "runtime/pocl.hpp"

using namespace boxwood;

TEST_SUITE_BEGIN("runtime");

TEST_CASE("pocl: threads are pinned only where the process may run on all the CPUs that they are pinned to") {
    cpu_set_t before;
    REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
    CHECK(may_run_on_first_cpus(0));
    CHECK_FALSE(may_run_on_first_cpus(1 << 16));
    CHECK_FALSE(may_run_on_first_cpus(std::size_t{1} << 40));
    for (int only = 0; only < CPU_SETSIZE; ++only) {
        if (!CPU_ISSET(only, &before)) continue;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(only, &one);
        REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
        CHECK(may_run_on_first_cpus(1) == (only == 0));
        CHECK_FALSE(may_run_on_first_cpus(2));
    }
    sched_setaffinity(0, sizeof before, &before);
}

TEST_SUITE_END();
