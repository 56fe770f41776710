// SPDX-License-Identifier: MIT
// What traversal programs are specialised for.
#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "traverse/specialise.hpp"

using namespace boxwood;

TEST_SUITE_BEGIN("traverse");

TEST_CASE("specialise: stacks hold what is needed, in few sizes") {
    CHECK(stack_entries(0) == 64);
    CHECK(stack_entries(64) == 64);
    CHECK(stack_entries(65) == 512);
    CHECK(stack_entries(512) == 512);
    CHECK(stack_entries(513) == 4096);
    CHECK(stack_entries(1u << 18) == 1u << 18);
    CHECK_THROWS_AS(stack_entries((1u << 18) + 1), CapacityError);
}

TEST_SUITE_END();
