// SPDX-License-Identifier: MIT
#include "cli/study_published.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"

namespace boxwood::cli {

namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
}

/// The next line without its end, of either kind.
bool get_line(std::istream& stream, std::string& line) {
    if (!std::getline(stream, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
}

/// One line, its cells found by the names of their columns.
struct Line {
    const std::map<std::string, std::size_t>& columns;
    std::vector<std::string> cells;
    std::string file;
    std::string where;

    const std::string& word(const std::string& column) const {
        const std::size_t index = columns.at(column);
        if (index >= cells.size()) throw InputError(file, where, "has no column " + column);
        return cells[index];
    }
    double number(const std::string& column) const {
        const std::string& text = word(column);
        double value = 0.0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
        if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(value) || value < 0.0)
            throw InputError(file, where,
                             "has \"" + excerpt(text) + "\" for " + column + ", which is not a number of 0 or more");
        return value;
    }
};

} // namespace

Published load_published(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) throw InputError(file.string(), "", "is a folder");
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string(), "", "cannot be opened");
    std::string text;
    get_line(stream, text);
    std::map<std::string, std::size_t> columns;
    std::size_t column = 0;
    for (const std::string& name : cells_of(text))
        if (!columns.emplace(name, column++).second && !name.empty())
            throw InputError(file.string(), "line 1", "names column " + excerpt(name) + " twice");
    for (const char* name : {"scene", "area", "orientation", "builder", "real_cost_local", "estimated_pah_cost",
                             "estimated_sah_cost", "overlap_level4", "overlap_level4_culled"})
        if (!columns.contains(name)) throw InputError(file.string(), "line 1", std::string("names no column ") + name);
    Published published;
    for (std::size_t number = 2; get_line(stream, text); ++number) {
        if (text.empty()) continue;
        const Line line{columns, cells_of(text), file.string(), "line " + std::to_string(number)};
        const std::string configuration = line.word("scene") + ' ' + line.word("area") + ' ' + line.word("orientation");
        if (published[configuration].contains(line.word("builder")))
            throw InputError(line.file, line.where,
                             "has " + excerpt(line.word("builder")) + " of " + excerpt(configuration) + " again");
        PublishedCost& cost = published[configuration][line.word("builder")];
        cost.cost = line.number("real_cost_local");
        cost.estimated_pah = line.number("estimated_pah_cost");
        cost.estimated_sah = line.number("estimated_sah_cost");
        cost.overlap = line.number("overlap_level4");
        cost.overlap_culled = line.number("overlap_level4_culled");
    }
    return published;
}

} // namespace boxwood::cli
