// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace boxwood::cli {

/// Rows of words in columns as wide as need be, the first to the left and the others to the right.
class Table {
public:
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

    /// On standard output, after an empty line and the title.
    void print(const std::string& title) const;

private:
    std::vector<std::vector<std::string>> rows_;
};

/// With so many digits after the point.
std::string fixed(double value, int digits);

/// The word for one of overlap_levels: its number, "all" for the last.
std::string level_word(std::uint32_t level);

} // namespace boxwood::cli
