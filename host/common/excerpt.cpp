// SPDX-License-Identifier: MIT
#include "common/excerpt.hpp"

#include <algorithm>

namespace boxwood {

std::string excerpt(std::string_view text, std::size_t longest) {
    std::size_t length = std::min(text.size(), longest);
    const auto continues = [&text](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80; };
    // A sequence has at most three bytes after its first; what has more is no UTF-8 and may be cut anywhere.
    for (int i = 0; i < 3 && length > 0 && length < text.size() && continues(length); ++i) --length;
    std::string shown(text.substr(0, length));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
    if (length < text.size()) shown += "... (" + std::to_string(text.size()) + " bytes)";
    return shown;
}

} // namespace boxwood
