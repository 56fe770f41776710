// SPDX-License-Identifier: MIT
#include "boxwood/profile.hpp"

#include <utility>

#include "runtime/device_state.hpp"

namespace boxwood {

double Profile::stage_ms(const std::string& stage) const {
    double sum = 0.0;
    for (const PassTime& pass : passes)
        if (pass.stage == stage) sum += pass.ms;
    return sum;
}

double Profile::total_ms() const {
    double sum = 0.0;
    for (const PassTime& pass : passes) sum += pass.ms;
    return sum;
}

Stage::Stage(Device& device, std::string name)
    : device_(device), previous_(std::exchange(device.state().stage, std::move(name))) {}

Stage::~Stage() { device_.state().stage.swap(previous_); }

} // namespace boxwood
