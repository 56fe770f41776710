// SPDX-License-Identifier: MIT
#include "common/excerpt.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("common");

using namespace boxwood;

TEST_CASE("excerpt: short text whole, long text cut with its length, never inside a sequence of UTF-8") {
    CHECK(excerpt("").empty());
    CHECK(excerpt("a \xe2\x9d\xa4") == "a \xe2\x9d\xa4");
    const std::string whole(longest_excerpt, 'x');
    CHECK(excerpt(whole) == whole);
    CHECK(excerpt(whole + "x") == whole + "... (161 bytes)");
    for (std::size_t before = longest_excerpt - 3; before <= longest_excerpt; ++before) {
        CAPTURE(before);
        const std::string start(before, 'x');
        const bool fits = before + 3 <= longest_excerpt;
        const std::string shown = start + (fits ? "\xe2\x9d\xa4" : "");
        CHECK(excerpt(start + "\xe2\x9d\xa4\xe2\x9d\xa4").starts_with(shown + "... ("));
    }
    CHECK(
        excerpt(std::string(1000, '\x80')).starts_with(std::string(longest_excerpt - 3, '\x80') + "... (")); // no UTF-8
    CHECK(excerpt(std::string(300, 'x'), 300) == std::string(300, 'x'));
    CHECK(excerpt(std::string(301, 'x'), 300) == std::string(300, 'x') + "... (301 bytes)");
}

TEST_CASE("excerpt: control characters become spaces, so that a message is one line") {
    CHECK(excerpt(std::string("a\nb\tc\x1b[1m\x7f\0d", 12)) == "a b c [1m  d");
}

TEST_SUITE_END();
