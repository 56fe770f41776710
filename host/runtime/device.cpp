// SPDX-License-Identifier: MIT
#include "boxwood/device.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "boxwood/error.hpp"
#include "common/memory_limit.hpp"
#include "runtime/device_state.hpp"
#include "runtime/language.hpp"
#include "runtime/pocl.hpp"

namespace boxwood {

namespace {

std::vector<cl::Platform> all_platforms() {
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) { // no platform at all is reported as an error by the loader
    }
    return platforms;
}

/// Also where PoCL has no device.
bool has_pocl() {
    const std::vector<cl::Platform> platforms = all_platforms();
    return std::any_of(platforms.begin(), platforms.end(),
                       [](const cl::Platform& platform) { return is_pocl(platform.getInfo<CL_PLATFORM_NAME>()); });
}

/// PoCL ends the process, or waits for ever, where it cannot even start its threads and load its compiler.
void check_address_space() {
    constexpr std::uint64_t needed = std::uint64_t{512} << 20;
    static const std::uint64_t left = process_limit(); // before there are drivers
    if (left < needed)
        throw DeviceError(0, "choosing a device", "",
                          "limits of this process (ulimit -v, ulimit -d) leave " + std::to_string(left) +
                              " bytes of memory; OpenCL drivers need " + std::to_string(needed));
}

std::vector<cl::Device> all_devices() {
    check_address_space();
    pin_pocl_threads();
    std::vector<cl::Device> devices;
    for (const cl::Platform& platform : all_platforms()) {
        std::vector<cl::Device> found;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &found);
        } catch (const cl::Error&) { // a platform without devices, likewise
            continue;
        }
        for (const cl::Device& device : found)
            if (device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) devices.push_back(device);
    }
    return devices;
}

/// Devices before OpenCL 3.0 refuse these questions.
detail::LanguageOffer language_offer(const cl::Device& device) {
    detail::LanguageOffer offer{device.getInfo<CL_DEVICE_VERSION>()};
    std::size_t bytes = 0;
    if (clGetDeviceInfo(device(), CL_DEVICE_OPENCL_C_ALL_VERSIONS, 0, nullptr, &bytes) != CL_SUCCESS) return offer;
    std::vector<cl_name_version> versions(bytes / sizeof(cl_name_version));
    if (clGetDeviceInfo(device(), CL_DEVICE_OPENCL_C_ALL_VERSIONS, bytes, versions.data(), nullptr) == CL_SUCCESS)
        for (const cl_name_version& each : versions) offer.dialects.push_back(each.version);
    cl_device_atomic_capabilities atomics = 0;
    if (clGetDeviceInfo(device(), CL_DEVICE_ATOMIC_MEMORY_CAPABILITIES, sizeof atomics, &atomics, nullptr) ==
        CL_SUCCESS)
        offer.atomics = atomics;
    return offer;
}

DeviceInfo describe(const cl::Device& device, std::size_t index) {
    DeviceInfo info;
    info.index = index;
    info.platform = cl::Platform(device.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_NAME>();
    info.name = device.getInfo<CL_DEVICE_NAME>();
    info.driver = device.getInfo<CL_DRIVER_VERSION>();
    info.version = device.getInfo<CL_DEVICE_VERSION>();
    info.language = detail::choose_language(language_offer(device));
    const cl_device_fp_config arithmetic = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
    info.denormals = (arithmetic & CL_FP_DENORM) != 0;
    info.correctly_rounded_divide_sqrt = (arithmetic & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    info.cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.global_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.largest_buffer_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    if (info.cpu) info.global_bytes = std::min(info.global_bytes, usable_by_device(memory_limit()));
    info.largest_buffer_bytes = std::min(info.largest_buffer_bytes, info.global_bytes);
    return info;
}

/// A CPU runs a few long slices on its vector units, each work-group one work-item; a GPU many short ones.
Tuning default_tuning(const DeviceInfo& info) {
    if (info.cpu) return {1, 16 * info.compute_units, 256, 16};
    return {64, 1024 * info.compute_units, 4};
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool selects(const std::string& selector, const DeviceInfo& info) {
    std::size_t index = 0;
    const char* end = selector.data() + selector.size();
    const auto [rest, status] = std::from_chars(selector.data(), end, index);
    if (status == std::errc() && rest == end) return index == info.index;
    return lower(info.name).find(lower(selector)) != std::string::npos ||
           lower(info.platform).find(lower(selector)) != std::string::npos;
}

std::string listing(const std::vector<DeviceInfo>& infos) {
    std::ostringstream out;
    for (const DeviceInfo& info : infos) out << "\n  " << info.index << "  " << info.platform << ": " << info.name;
    return out.str();
}

void check_language(const DeviceInfo& info) {
    if (!info.language.empty()) return;
    throw DeviceError(0, "choosing a device", "",
                      info.name + " (" + info.version + ") can compile neither OpenCL C 1.2, nor 3.0 with atomics of " +
                          "acquire and release at device scope; choose another device");
}

/// Where in list_devices() it is.
std::size_t index_of(const cl::Device& device) {
    const std::vector<cl::Device> all = all_devices();
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const cl::Device& each) { return each() == device(); }) - all.begin());
}

void check_queue(const cl::Context& context, const cl::CommandQueue& queue) {
    const auto fail = [](const char* what) { throw DeviceError(0, "taking the caller's queue", "", what); };
    if (queue.getInfo<CL_QUEUE_CONTEXT>()() != context()) fail("the queue is of another context");
    if ((queue.getInfo<CL_QUEUE_PROPERTIES>() & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) != 0)
        fail("the queue executes out of order; Boxwood's work relies on order");
}

} // namespace

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> infos;
    for (const cl::Device& device : all_devices()) infos.push_back(describe(device, infos.size()));
    return infos;
}

Device::Device(const std::string& selector) {
    std::string wanted = selector;
    if (const char* variable = std::getenv("BOXWOOD_DEVICE"); wanted.empty() && variable) wanted = variable;
    const std::vector<DeviceInfo> infos = list_devices();
    if (infos.empty()) {
        const std::string fault = has_pocl() ? pocl_cache_fault() : "";
        throw DeviceError(0, "choosing a device", "",
                          fault.empty() ? "no OpenCL device found; install one, such as pocl-opencl-icd" : fault);
    }
    const auto found = wanted.empty() ? infos.begin() : std::find_if(infos.begin(), infos.end(), [&](const auto& info) {
        return selects(wanted, info);
    });
    if (found == infos.end())
        throw DeviceError(0, "choosing a device", "",
                          "no device matches \"" + wanted + "\"; there are:" + listing(infos));
    check_language(*found);
    try {
        state_ = std::make_shared<detail::DeviceState>(all_devices().at(found->index), *found);
    } catch (const cl::Error& error) {
        throw DeviceError(error.err(), error.what(), "", "opening " + found->name);
    }
    state_->tuning = default_tuning(*found);
}

Device::Device(cl_context context, cl_command_queue queue) {
    try {
        const cl::Context own_context(context, true);
        const cl::CommandQueue own_queue(queue, true);
        check_queue(own_context, own_queue);
        const cl::Device device = own_queue.getInfo<CL_QUEUE_DEVICE>();
        const DeviceInfo info = describe(device, index_of(device));
        check_language(info);
        state_ = std::make_shared<detail::DeviceState>(own_context, own_queue, info);
        state_->tuning = default_tuning(info);
    } catch (const cl::Error& error) {
        throw DeviceError(error.err(), error.what(), "", "taking the caller's context and queue");
    }
}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const { return state_->info; }

const Tuning& Device::tuning() const { return state_->tuning; }

void Device::set_tuning(const Tuning& tuning) {
    const std::size_t limit = state_->device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    if (tuning.group_size == 0 || tuning.group_size > limit || tuning.work_items == 0 || tuning.smallest_slice == 0 ||
        (tuning.lanes != 1 && tuning.lanes != 8 && tuning.lanes != 16))
        throw DeviceError(0, "setting the tuning", "",
                          "sizes must be positive, groups at most " + std::to_string(limit) + ", lanes 1, 8 or 16");
    state_->tuning = tuning;
}

void Device::finish() {
    try {
        state_->queue.finish();
    } catch (const cl::Error& error) {
        throw DeviceError(error.err(), error.what(), "", "");
    }
}

std::uint64_t Device::held_bytes() const { return state_->held_bytes; }
std::uint64_t Device::peak_bytes() const { return state_->peak_bytes; }
void Device::reset_peak() { state_->peak_bytes = state_->held_bytes; }
void Device::trim() { state_->trim(); }
double Device::compile_ms() const { return state_->compile_ms; }

Profile Device::take_profile() {
    try {
        return state_->take_profile();
    } catch (const cl::Error& error) {
        throw DeviceError(error.err(), error.what(), "", "");
    }
}

} // namespace boxwood
