// SPDX-License-Identifier: MIT
#include "io/gltf_warnings.hpp"

#include <utility>

namespace boxwood {

namespace {

constexpr std::size_t most_warnings = 100;

} // namespace

void Warnings::add(const std::string& where, const std::string& what) {
    if (lines_.size() < most_warnings) {
        lines_.push_back(where + ": " + what);
    } else {
        ++more_;
    }
}

void Warnings::add_repeated(const std::string& where, const std::string& what) {
    const auto [known, is_new] = repeated_.try_emplace(what, Repeated{lines_.size()});
    if (is_new) return add(where, what);
    ++known->second.others;
}

std::vector<std::string> Warnings::take() {
    for (const auto& [what, repeated] : repeated_)
        if (repeated.others > 0 && repeated.line < most_warnings)
            lines_[repeated.line] += " (and " + std::to_string(repeated.others) + " more like it)";
    if (more_ > 0) lines_.push_back("and " + std::to_string(more_) + " more warnings");
    return std::move(lines_);
}

} // namespace boxwood
