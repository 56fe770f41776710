// SPDX-License-Identifier: MIT
// A picture of a scene by path tracing, as OpenEXR.
#include <iostream>

#include <boxwood/boxwood.hpp>

int main() {
    boxwood::Device device;
    const boxwood::Scene scene = boxwood::make_procedural("cornell");
    const boxwood::Tree tree = boxwood::build(device, scene);
    boxwood::RenderOptions options;
    options.width = 64;
    options.height = 48;
    options.light.samples = 8;
    const boxwood::Image image =
        boxwood::render(device, scene, tree, boxwood::Environment(), scene.cameras[0], options);
    boxwood::save_exr("cornell.exr", image);
    std::cout << image.width << " x " << image.height << ", " << image.channels.size() << " channels\n";
    return image.channels.empty() ? 1 : 0;
}
