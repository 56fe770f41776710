// SPDX-License-Identifier: MIT
// How OpenCL C writes a type of the host.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include <CL/cl.h>
#include <glm/glm.hpp>

namespace boxwood::detail {

/// The name of a class without its namespaces, from what GCC and Clang call this function.
template <class T>
constexpr std::string_view class_name() {
    std::string_view name = __PRETTY_FUNCTION__;
    name = name.substr(name.find("T = ") + 4);
    name = name.substr(0, name.find_first_of(";]"));
    return name.substr(name.rfind(':') + 1);
}

/// "uint", "float4", "Aabb".
template <class T>
constexpr std::string_view opencl_type() {
    if constexpr (std::is_floating_point_v<T>)
        return sizeof(T) == 4 ? "float" : "double";
    else if constexpr (std::is_integral_v<T>) {
        constexpr std::string_view names[2][4] = {{"uchar", "ushort", "uint", "ulong"},
                                                  {"char", "short", "int", "long"}};
        return names[std::is_signed_v<T>][sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3];
    } else if constexpr (std::is_same_v<T, cl_uint2>)
        return "uint2";
    else if constexpr (std::is_same_v<T, cl_float2>)
        return "float2";
    else if constexpr (std::is_same_v<T, cl_float4> || std::is_same_v<T, glm::vec4>)
        return "float4";
    else if constexpr (std::is_same_v<T, cl_float8>)
        return "float8";
    else if constexpr (std::is_same_v<T, cl_ulong4>)
        return "ulong4";
    else
        return class_name<T>();
}

} // namespace boxwood::detail
