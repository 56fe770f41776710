// SPDX-License-Identifier: MIT
#include "runtime/argument_check.hpp"

#include <string>

#include "boxwood/error.hpp"

namespace boxwood::detail {

namespace {

/// "struct Aabb*" -> "Aabb".
std::string element_name(std::string name) {
    while (!name.empty() && (name.back() == '*' || name.back() == ' ' || name.back() == '\0')) name.pop_back();
    if (name.starts_with("struct ")) name.erase(0, 7);
    return name;
}

bool is_local_name(const std::string& name) { return name.ends_with("_t"); }

} // namespace

void check_arguments(const cl::Kernel& kernel, const Argument* arguments, cl_uint count) {
    for (cl_uint i = 0; i < count; ++i) {
        const Argument& given = arguments[i];
        std::size_t bytes = 0;
        if (clGetKernelArgInfo(kernel(), i, CL_KERNEL_ARG_TYPE_NAME, 0, nullptr, &bytes) != CL_SUCCESS) return;
        const std::string type = kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(i);
        const bool pointer = type.find('*') != std::string::npos;
        const std::string wanted = element_name(type);
        const auto fail = [&](const std::string& what) {
            throw DeviceError(0, "checking argument " + std::to_string(i), kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(),
                              what);
        };
        if (pointer != given.pointer || (!is_local_name(wanted) && wanted != given.type))
            fail("takes " + type + ", got " + std::string(given.type) + (given.pointer ? "*" : ""));
        const auto qualifier = kernel.getArgInfo<CL_KERNEL_ARG_TYPE_QUALIFIER>(i);
        if (pointer && (qualifier & CL_KERNEL_ARG_TYPE_CONST) == 0 && !given.writes)
            fail("may write to " + type + ", got a buffer of const elements");
    }
}

} // namespace boxwood::detail
