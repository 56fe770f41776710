// SPDX-License-Identifier: MIT
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS // clCreateCommandQueue, which every device has

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "boxwood/device.hpp"
#include "boxwood/error.hpp"
#include "boxwood/gather.hpp"
#include "runtime/device_state.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

namespace {

/// Sets an environment variable (or clears it: nullptr) until the end of the scope.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) previous_ = old;
        set(value);
    }
    ~Variable() { set(previous_ ? previous_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    void set(const char* value) const {
        if (value)
            setenv(name_, value, 1);
        else
            unsetenv(name_);
    }
    const char* name_;
    std::optional<std::string> previous_;
};

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return text;
}

} // namespace

TEST_CASE("device: chosen by index, by part of a name in any case, by the environment") {
    const std::vector<DeviceInfo> all = list_devices();
    REQUIRE(!all.empty());
    for (std::size_t i = 0; i < all.size(); ++i) CHECK(all[i].index == i);
    const DeviceInfo& last = all.back();
    CHECK(Device(std::to_string(last.index)).info().index == last.index);

    // The first device whose name or platform holds the word.
    const std::string word = upper(all[0].name.substr(0, all[0].name.size() / 2 + 1));
    CHECK(Device(word).info().index == 0);
    CHECK(upper(Device(upper(last.platform)).info().platform).find(upper(last.platform)) != std::string::npos);
    {
        const Variable variable("BOXWOOD_DEVICE", std::to_string(last.index).c_str());
        CHECK(Device().info().index == last.index);
        CHECK(Device("0").info().index == 0); // the argument wins
    }
    {
        const Variable variable("BOXWOOD_DEVICE", "no such device");
        CHECK_THROWS_AS(Device(), DeviceError);
        CHECK_NOTHROW(Device("0"));
    }
    const Variable variable("BOXWOOD_DEVICE", nullptr);
    CHECK(Device().info().index == 0);
}

TEST_CASE("device: an unknown selector is refused with a listing of all devices") {
    const std::vector<DeviceInfo> all = list_devices();
    for (const std::string& selector : {std::string("no such device"), std::to_string(all.size())}) {
        try {
            const Device device(selector);
            FAIL("did not throw");
        } catch (const DeviceError& error) {
            const std::string what = error.what();
            CHECK(what.find("\"" + selector + "\"") != std::string::npos);
            for (const DeviceInfo& info : all) {
                CHECK(what.find(info.name) != std::string::npos);
                CHECK(what.find(info.platform) != std::string::npos);
            }
        }
    }
}

TEST_CASE("device: a tuning that cannot be is refused and changes nothing") {
    Device& device = test_device();
    const Tuning before = device.tuning();
    for (const Tuning& bad : {Tuning{0, 1, 1}, Tuning{1, 0, 1}, Tuning{1, 1, 0}, Tuning{1u << 30, 1, 1}})
        CHECK_THROWS_AS(device.set_tuning(bad), DeviceError);
    CHECK(device.tuning().group_size == before.group_size);
    CHECK(device.tuning().work_items == before.work_items);
    CHECK(device.tuning().smallest_slice == before.smallest_slice);
}

TEST_CASE("device: slices cover every element once, none is empty") {
    Device& device = test_device();
    for (const Tuning& tuning : {Tuning{1, 16, 256}, Tuning{1, 7, 5}, Tuning{1, 1, 1}, Tuning{1, 4096, 1}}) {
        const TuningScope scope(tuning);
        for (const std::size_t count : {1u, 4u, 5u, 6u, 35u, 36u, 255u, 256u, 257u, 4096u, 4097u, 1000003u}) {
            for (const std::size_t multiple : {1u, 64u}) {
                CAPTURE(count);
                const Slices slices = cut(device, count, multiple);
                CHECK(slices.length % multiple == 0);
                CHECK(slices.length >= std::min<std::size_t>(tuning.smallest_slice, count));
                CHECK(slices.length < count + multiple); // none longer than all
                CHECK(slices.slices <= tuning.work_items);
                CHECK(slices.slices <= most_slices(device, count, multiple));
                CHECK(std::size_t(slices.slices) * slices.length >= count);
                CHECK(std::size_t(slices.slices - 1) * slices.length < count);
            }
        }
        CHECK(cut(device, 0).slices == 0);
        CHECK(most_slices(device, 0) == 0);
    }
}

TEST_CASE("device: works in the caller's context, on the caller's queue and buffers") {
    const cl_context context = test_device().state().context();
    const cl_device_id id = test_device().state().device();
    cl_int status = CL_SUCCESS;
    const cl_command_queue queue = clCreateCommandQueue(context, id, 0, &status); // without profiling
    REQUIRE(status == CL_SUCCESS);
    const cl_mem memory = clCreateBuffer(context, CL_MEM_READ_WRITE, 4 * sizeof(std::uint32_t), nullptr, &status);
    REQUIRE(status == CL_SUCCESS);
    {
        Device device(context, queue);
        CHECK(device.info().name == test_device().info().name);
        CHECK(device.info().index == test_device().info().index);
        const BufferView<std::uint32_t> own(memory, 4);
        gather(device, upload(device, std::vector<std::uint32_t>{10, 20, 30, 40}, "values"),
               upload(device, std::vector<std::uint32_t>{3, 0, 2, 1}, "indices"), own);
        CHECK(download(device, own) == std::vector<std::uint32_t>{40, 10, 30, 20});
        const Profile profile = device.take_profile();
        REQUIRE(profile.passes.size() == 1);
        CHECK(profile.passes[0].launches == 1);
        CHECK(profile.passes[0].ms == 0.0); // the queue does not time
    }
    CHECK(clReleaseMemObject(memory) == CL_SUCCESS);
    CHECK(clReleaseCommandQueue(queue) == CL_SUCCESS); // the device had references of its own
}

TEST_CASE("device: a queue that is out of order, and one of another context, are refused") {
    const cl_context context = test_device().state().context();
    const cl_device_id id = test_device().state().device();
    cl_int status = CL_SUCCESS;
    const cl_command_queue loose = clCreateCommandQueue(context, id, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, &status);
    if (status == CL_SUCCESS) { // not every device has such queues
        CHECK_THROWS_WITH_AS(Device(context, loose), doctest::Contains("out of order"), DeviceError);
        clReleaseCommandQueue(loose);
    }
    const cl_context other = clCreateContext(nullptr, 1, &id, nullptr, nullptr, &status);
    REQUIRE(status == CL_SUCCESS);
    CHECK_THROWS_WITH_AS(Device(other, test_device().state().queue()), doctest::Contains("another context"),
                         DeviceError);
    clReleaseContext(other);
}
