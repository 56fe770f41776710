// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace boxwood {

/// Bytes of outside text that a message quotes at most.
inline constexpr std::size_t longest_excerpt = 160;

/// `text` as messages quote it: names, addresses and words from outside may be of any length, so that what is longer
/// than `longest` bytes is cut there, never inside a UTF-8 sequence, and ends in "... (N bytes)" with its whole length.
/// Control characters become spaces, so that a message stays one line.
std::string excerpt(std::string_view text, std::size_t longest = longest_excerpt);

} // namespace boxwood
