// SPDX-License-Identifier: MIT
#include "io/gltf_warnings.hpp"

#include <algorithm>
#include <utility>

namespace boxwood {

namespace {

constexpr std::size_t most_warnings = 100;

} // namespace

void Warnings::add(const std::string& where, const std::string& what) {
    const std::string line = where + ": " + what;
    if (std::find(lines_.begin(), lines_.end(), line) != lines_.end()) return; // of a mesh that is loaded in two poses
    if (lines_.size() < most_warnings) {
        lines_.push_back(line);
    } else {
        ++more_;
    }
}

void Warnings::add_repeated(const std::string& where, const std::string& what) {
    const auto [known, is_new] = repeated_.try_emplace(what, Repeated{lines_.size(), {}});
    if (is_new) add(where, what);
    known->second.places.insert(where);
}

std::vector<std::string> Warnings::take() {
    for (const auto& [what, repeated] : repeated_)
        if (repeated.places.size() > 1 && repeated.line < most_warnings)
            lines_[repeated.line] += " (and " + std::to_string(repeated.places.size() - 1) + " more like it)";
    if (more_ > 0) lines_.push_back("and " + std::to_string(more_) + " more warnings");
    return std::move(lines_);
}

} // namespace boxwood
