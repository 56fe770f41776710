// SPDX-License-Identifier: MIT
#include "cli/table.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "boxwood/analysis.hpp"

namespace boxwood::cli {

void Table::print(const std::string& title) const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::cout << '\n' << title << '\n';
    for (const auto& row : rows_) {
        std::cout << std::left << std::setw(static_cast<int>(widths[0])) << row[0] << std::right;
        for (std::size_t i = 1; i < row.size(); ++i) std::cout << std::setw(static_cast<int>(widths[i] + 2)) << row[i];
        std::cout << '\n';
    }
}

std::string fixed(double value, int digits) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits) << value;
    return text.str();
}

std::string level_word(std::uint32_t level) {
    return level == overlap_levels[std::size(overlap_levels) - 1] ? "all" : std::to_string(level);
}

} // namespace boxwood::cli
