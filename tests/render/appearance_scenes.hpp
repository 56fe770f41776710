// SPDX-License-Identifier: MIT
// A square and its appearance, for the tests of what shading reads.
#pragma once

#include <doctest/doctest.h>

#include "boxwood/appearance.hpp"
#include "scene/picture.hpp"
#include "support.hpp"

namespace boxwood::test {

/// The unit square in the plane z = 0, facing +z, with uv = (x, y).
inline Mesh square() {
    Mesh mesh{"square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return mesh;
}

inline Scene one_square(const Material& material) {
    Scene scene;
    scene.meshes.push_back(square());
    scene.meshes[0].materials = {0, 0};
    scene.materials.push_back(material);
    scene.instances.push_back({"square", 0, glm::mat4(1.0f)});
    return scene;
}

inline EncodedImage image(const std::string& name, PictureSize size, const std::vector<std::uint8_t>& rgba) {
    return {name, encode_png(name, size, 4, rgba)};
}

template <class Code = std::uint8_t>
std::vector<Code> noise(PictureSize size, std::uint64_t salt) {
    Random random(salt);
    std::vector<Code> rgba(4 * size.width * size.height);
    for (Code& code : rgba) code = static_cast<Code>(random.below(std::uint32_t{1} << (8 * sizeof(Code))));
    return rgba;
}

inline Appearance appearance_of(const Scene& scene, std::vector<std::string>& warnings) {
    return upload_appearance(test_device(), scene, shading_requirements(scene), warnings);
}

/// Of a scene that gives no warning.
inline Appearance appearance_of(const Scene& scene) {
    std::vector<std::string> warnings;
    Appearance appearance = appearance_of(scene, warnings);
    CHECK(warnings.empty());
    return appearance;
}

} // namespace boxwood::test
