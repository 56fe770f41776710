// SPDX-License-Identifier: MIT
#include "boxwood/error.hpp"

#include <sstream>
#include <utility>

namespace boxwood {

namespace {

std::string device_message(int code, const std::string& call, const std::string& kernel, const std::string& detail) {
    std::ostringstream out;
    out << call;
    if (!kernel.empty()) out << " (kernel " << kernel << ")";
    if (code != 0) out << ": OpenCL error " << code;
    if (!detail.empty()) out << ": " << detail;
    return out.str();
}

std::string program_message(const std::string& file, const std::string& device, const std::string& options,
                            const std::string& log, const std::string& text) {
    std::ostringstream out;
    out << file << ": does not compile for " << device << "\noptions: " << options << "\nlog:\n" << log << "\ntext:\n";
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) out << number << ": " << line << '\n';
    return out.str();
}

std::string input_message(const std::string& file, const std::string& where, const std::string& what) {
    return file + (where.empty() ? "" : ": " + where) + ": " + what;
}

} // namespace

DeviceError::DeviceError(int code_, std::string call_, std::string kernel_, const std::string& detail)
    : Error(device_message(code_, call_, kernel_, detail)), code(code_), call(std::move(call_)),
      kernel(std::move(kernel_)) {}

ProgramError::ProgramError(std::string file_, std::string device_, std::string options_, std::string log_,
                           const std::string& text)
    : Error(program_message(file_, device_, options_, log_, text)), file(std::move(file_)), device(std::move(device_)),
      options(std::move(options_)), log(std::move(log_)) {}

InputError::InputError(std::string file_, std::string where_, const std::string& what)
    : Error(input_message(file_, where_, what)), file(std::move(file_)), where(std::move(where_)) {}

OutputError::OutputError(std::string file_, const std::string& what)
    : Error(input_message(file_, "", what)), file(std::move(file_)) {}

CapacityError::CapacityError(const std::string& what, std::uint64_t asked_, std::uint64_t available_)
    : Error(what + ": " + std::to_string(asked_) + " asked, " + std::to_string(available_) + " available"),
      asked(asked_), available(available_) {}

} // namespace boxwood
