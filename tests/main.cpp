// SPDX-License-Identifier: MIT
// boxwood-tests: qualifies a device. doctest's options, plus --device=SELECTOR, --seed=N and
// --tuning=GROUP,ITEMS,SLICE,LANES.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "boxwood/error.hpp"
#include "runtime/device_state.hpp"
#include "runtime/kernel_text.hpp"
#include "support.hpp"

namespace boxwood {
extern const std::vector<KernelText> test_kernels;
}

namespace boxwood::test {
namespace {

std::unique_ptr<Device> device_under_test;
std::uint64_t seed = 20260101;

} // namespace

Device& test_device() { return *device_under_test; }
std::uint64_t test_seed() { return seed; }

std::filesystem::path scenes_folder() {
    const char* folder = std::getenv("BOXWOOD_SCENES");
    return folder ? folder : "";
}

bool small_sizes() { return std::getenv("BOXWOOD_SMALL") != nullptr; }

namespace {

/// Empties the device's pool before each test case under a checker: Oclgrind goes through every byte of every buffer,
/// used or not, after each kernel.
struct EmptyPool : doctest::IReporter {
    explicit EmptyPool(const doctest::ContextOptions&) {}
    void test_case_start(const doctest::TestCaseData&) override {
        if (small_sizes()) test_device().trim();
    }
    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_run_end(const doctest::TestRunStats&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_end(const doctest::CurrentTestCaseStats&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_LISTENER("empty-pool", 1, EmptyPool);

/// Takes `--name=value` or `--name value` out of the arguments; "" when absent.
std::string take_option(std::vector<char*>& arguments, const std::string& name) {
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string argument = arguments[i];
        if (argument.starts_with("--" + name + "=")) {
            arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i));
            return argument.substr(name.size() + 3);
        }
        if (argument == "--" + name && i + 1 < arguments.size()) {
            const std::string value = arguments[i + 1];
            const auto first = arguments.begin() + static_cast<std::ptrdiff_t>(i);
            arguments.erase(first, first + 2);
            return value;
        }
    }
    return "";
}

/// "64,2048,4,1": the members of Tuning in their order. Throws std::invalid_argument.
Tuning to_tuning(const std::string& text) {
    Tuning tuning;
    std::istringstream words(text);
    char commas[3] = {};
    words >> tuning.group_size >> commas[0] >> tuning.work_items >> commas[1] >> tuning.smallest_slice >> commas[2] >>
        tuning.lanes;
    if (!words || words.peek() != EOF || std::string(commas, 3) != ",,,")
        throw std::invalid_argument("--tuning takes GROUP,ITEMS,SLICE,LANES, such as 64,2048,4,1, not " + text);
    return tuning;
}

int run(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    const std::string selector = take_option(arguments, "device");
    if (const std::string value = take_option(arguments, "seed"); !value.empty()) seed = std::stoull(value);

    const std::string tuning = take_option(arguments, "tuning");

    doctest::Context context(static_cast<int>(arguments.size()), arguments.data());
    device_under_test = std::make_unique<Device>(selector);
    device_under_test->state().checks_arguments = true;
    if (!tuning.empty()) device_under_test->set_tuning(to_tuning(tuning));
    add_kernels(test_kernels);
    const DeviceInfo& info = device_under_test->info();
    const Tuning& used = device_under_test->tuning();
    std::cout << "device: " << info.name << "\nplatform: " << info.platform << "\ndriver: " << info.driver << " ("
              << info.version << ", " << info.language << (info.denormals ? ", " : ", no ")
              << "denormals, division and square root "
              << (info.correctly_rounded_divide_sqrt ? "" : "not promised to be ")
              << "rounded correctly)\ntuning: " << used.group_size << ',' << used.work_items << ','
              << used.smallest_slice << ',' << used.lanes << "\nseed: " << seed << std::endl;

    const int status = context.run();
    if (!context.shouldExit()) {
        std::cout << "verdict: " << info.name << (status == 0 ? " PASSES" : " FAILS") << " the Boxwood tests"
                  << std::endl;
    }
    device_under_test.reset();
    return status;
}

} // namespace
} // namespace boxwood::test

int main(int argc, char** argv) {
    try {
        return boxwood::test::run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "boxwood-tests: " << error.what() << '\n';
        return 4;
    }
}
