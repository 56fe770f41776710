// SPDX-License-Identifier: MIT
#include <iostream>
#include <limits>
#include <vector>

#include <boxwood/boxwood.hpp>

int main() {
    boxwood::Device device; // the first OpenCL device, or the one that BOXWOOD_DEVICE names
    const boxwood::Scene scene = boxwood::make_procedural("sphere", {.triangles = 20000});
    const boxwood::Tree tree = boxwood::build(device, scene);

    // Two rays along -z: one at the centre of the sphere, one past it. Origin, t_min, direction, t_max.
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<boxwood::Ray> rays = {{{0, 0, 9}, 0, {0, 0, -1}, infinity}, //
                                            {{9, 9, 9}, 0, {0, 0, -1}, infinity}};
    const auto queries = boxwood::upload(device, rays, "rays");
    auto answers = boxwood::make_buffer<boxwood::Hit>(device, rays.size(), "hits");
    boxwood::closest_hit(device, tree, queries, answers);

    const std::vector<boxwood::Hit> hits = boxwood::download(device, answers);
    for (const boxwood::Hit& hit : hits) {
        if (hit.primitive == BOXWOOD_NONE)
            std::cout << "miss\n";
        else
            std::cout << "triangle " << hit.primitive << " at t = " << hit.t << '\n';
    }
    return hits[0].primitive != BOXWOOD_NONE && hits[1].primitive == BOXWOOD_NONE ? 0 : 1;
}
