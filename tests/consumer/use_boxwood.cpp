// SPDX-License-Identifier: MIT
// Uses each layer of an installed Boxwood once, so that a header or a library missing from the package shows.
#include "use_boxwood.hpp"

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <vector>

#include <boxwood/boxwood.hpp>

bool use_boxwood() {
    boxwood::Device device;
    const std::vector<std::uint32_t> numbers = {1, 2, 3, 4};
    const auto in = boxwood::upload(device, numbers, "numbers");
    auto sum = boxwood::make_buffer<std::uint32_t>(device, 1, "sum");
    boxwood::reduce(device, in, boxwood::Operator::sum, sum);

    const boxwood::Scene scene = boxwood::make_procedural("cornell");
    boxwood::BuildReport report;
    const boxwood::Tree tree = boxwood::build(device, scene, {}, &report);
    const auto file = std::filesystem::path("consumer.bxw");
    boxwood::save_bxw(file, scene, boxwood::download(device, tree));
    const boxwood::BxwFile again = boxwood::load_bxw(file);

    const bool good = boxwood::download(device, sum)[0] == 10 && report.nodes > 0 &&
                      again.scene.triangle_count() == scene.triangle_count();
    std::cout << "consumer: " << report.nodes << " nodes, " << (good ? "good" : "wrong") << '\n';
    return good;
}
