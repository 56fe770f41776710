// SPDX-License-Identifier: MIT
#include "runtime/kernel_text.hpp"

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "boxwood/error.hpp"

namespace boxwood {

namespace {

std::map<std::string, const char*>& table() {
    static std::map<std::string, const char*> files = [] {
        std::map<std::string, const char*> result;
        for (const KernelText& kernel : library_kernels) result[kernel.file] = kernel.text;
        return result;
    }();
    return files;
}

std::string load(const std::string& file, const std::string& includer) {
    if (const char* folder = std::getenv("BOXWOOD_KERNEL_DIR")) {
        std::ifstream stream(std::string(folder) + "/" + file, std::ios::binary);
        if (stream) return std::string(std::istreambuf_iterator<char>(stream), {});
    }
    const auto found = table().find(file);
    if (found == table().end()) throw ProgramError(includer, "any device", "", "no kernel file \"" + file + "\"", "");
    return found->second;
}

/// The file named by an include line of the embedded file `includer`, if it is one: a name without a folder is beside
/// it.
std::optional<std::string> included_file(const std::string& line, const std::string& includer) {
    const std::size_t start = line.find_first_not_of(" \t");
    if (start == std::string::npos || line.compare(start, 8, "#include") != 0) return std::nullopt;
    const std::size_t open = line.find('"', start);
    const std::size_t close = open == std::string::npos ? open : line.find('"', open + 1);
    if (close == std::string::npos) return std::nullopt;
    const std::string name = line.substr(open + 1, close - open - 1);
    return name.find('/') == std::string::npos ? includer.substr(0, includer.rfind('/') + 1) + name : name;
}

/// Stands for the text that a launch brings along.
constexpr const char* insertion_point = "runtime/inserted.h";

void append(const std::string& file, const std::string& includer, const std::string& inserted,
            std::set<std::string>& seen, std::ostream& out) {
    if (!seen.insert(file).second) return;
    out << "#line 1 \"" << file << "\"\n";
    const bool own = file == insertion_point && !inserted.empty();
    std::istringstream lines(own ? inserted : load(file, includer));
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (const auto include = included_file(line, file)) {
            append(*include, file, inserted, seen, out);
            out << "#line " << number + 1 << " \"" << file << "\"\n";
        } else {
            out << line << '\n';
        }
    }
}

} // namespace

void add_kernels(const std::vector<KernelText>& kernels) {
    for (const KernelText& kernel : kernels) table()[kernel.file] = kernel.text;
}

std::vector<std::string> kernel_files() {
    std::vector<std::string> names;
    for (const auto& [name, text] : table()) names.push_back(name);
    return names;
}

std::string resolve_kernel_text(const std::string& file, const std::string& inserted) {
    std::ostringstream out;
    std::set<std::string> seen;
    append(file, file, inserted, seen, out);
    return out.str();
}

} // namespace boxwood
