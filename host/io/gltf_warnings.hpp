// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace boxwood {

/// The warnings of an import, each once: the first hundred, then only how many more there were.
class Warnings {
public:
    void add(const std::string& where, const std::string& what);

    /// A fault that exporters repeat all over a file: one line for each `what`, which names the first place and counts
    /// the others.
    void add_repeated(const std::string& where, const std::string& what);

    std::vector<std::string> take();

private:
    /// What add_repeated was given before.
    struct Repeated {
        std::size_t line;
        std::set<std::string> places;
    };

    std::vector<std::string> lines_;
    std::map<std::string, Repeated> repeated_; ///< By `what`.
    std::size_t more_ = 0;
};

} // namespace boxwood
