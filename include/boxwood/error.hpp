// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace boxwood {

/// Base of every exception that Boxwood throws on purpose.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An OpenCL call failed, or no usable device was found.
class DeviceError : public Error {
public:
    /// `code` is the OpenCL status, `call` the API call or selection step, `kernel` the kernel concerned or "".
    DeviceError(int code, std::string call, std::string kernel, const std::string& detail);

    int code;
    std::string call;
    std::string kernel;
};

/// A kernel file did not compile. what() carries device, options, log and the numbered program text.
class ProgramError : public Error {
public:
    ProgramError(std::string file, std::string device, std::string options, std::string log, const std::string& text);

    std::string file;
    std::string device;
    std::string options;
    std::string log;
};

/// Input from outside (a scene, a tree file, an argument value) cannot be used.
class InputError : public Error {
public:
    /// `where` names the element, for example "accessors[3]"; `what` says what is wrong and what to do.
    InputError(std::string file, std::string where, const std::string& what);

    std::string file;
    std::string where;
};

/// An output (a file, standard output) cannot be written.
class OutputError : public Error {
public:
    /// `what` holds the system's reason, and what to do where that does not say it.
    OutputError(std::string file, const std::string& what);

    std::string file;
};

/// The work does not fit the device. Thrown before any of it is done.
class CapacityError : public Error {
public:
    /// `asked` and `available` are in bytes unless `what` names another unit.
    CapacityError(const std::string& what, std::uint64_t asked, std::uint64_t available);

    std::uint64_t asked;
    std::uint64_t available;
};

} // namespace boxwood
