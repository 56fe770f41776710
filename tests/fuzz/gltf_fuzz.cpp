// SPDX-License-Identifier: MIT
// Whatever the bytes, the reader returns a scene that keeps its promises or throws an InputError.
#include <cstddef>
#include <cstdint>
#include <span>

#include "boxwood/error.hpp"
#include "io/gltf_document.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    boxwood::Scene scene;
    try {
        scene = boxwood::load_gltf_memory({reinterpret_cast<const std::byte*>(data), size}, "fuzz", {});
    } catch (const boxwood::InputError&) {
        return 0;
    }
    boxwood::validate(scene, "fuzz"); // throws, and so fails, when the reader let something through
    return 0;
}
