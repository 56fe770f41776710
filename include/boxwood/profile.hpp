// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace boxwood {

class Device;

/// Device time of all launches of one label within one stage.
struct PassTime {
    std::string stage; ///< Innermost Stage alive at the launch, or "".
    std::string label; ///< Label of the launch.
    std::uint64_t launches = 0;
    double ms = 0.0;
};

/// Times per pass in order of first launch.
struct Profile {
    std::vector<PassTime> passes;

    /// Sum over the passes of one stage.
    double stage_ms(const std::string& stage) const;
    /// Sum over all passes.
    double total_ms() const;
};

/// Attributes the launches made on a device during its life to a named stage of the pipeline. Stages nest; the
/// innermost wins.
class Stage {
public:
    Stage(Device& device, std::string name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    Device& device_;
    std::string previous_;
};

} // namespace boxwood
