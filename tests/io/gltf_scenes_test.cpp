// SPDX-License-Identifier: MIT
// Real and sample files: BOXWOOD_SCENES names their folder, and INDEX.md there is where the numbers come from.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "io/samples.hpp"
#include "support.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;

namespace {

struct Expected {
    const char* file;
    std::uint64_t triangles;
    std::uint64_t vertices;
    std::size_t meshes;
    std::size_t instances;
    std::uint64_t instanced_triangles;
};

constexpr std::array index_table{
    Expected{"sibenik.glb", 75284, 77008, 15, 15, 75284},
    Expected{"sponza_dabrovic.glb", 66450, 61378, 37, 37, 66450},
    Expected{"bunny_144046.glb", 144046, 72378, 1, 1, 144046},
    Expected{"bunny_69451.glb", 69451, 35947, 1, 1, 69451},
    Expected{"dragon_871414.glb", 871414, 437645, 1, 1, 871414},
    Expected{"dragon_res3.glb", 47794, 22998, 1, 1, 47794},
    Expected{"conference.glb", 331179, 194399, 41, 41, 331179},
    Expected{"teapot_15704.glb", 15704, 8334, 2, 2, 15704},
    Expected{"pah_MonkeyModel.glb", 967, 2865, 1, 1, 967},
    Expected{"pah_Cottage.glb", 4281, 6613, 1, 1, 4281},
    Expected{"pah_CottageWalls.glb", 5817, 7483, 4, 4, 5817},
    Expected{"pah_WoodScene.glb", 7058, 10105, 107, 107, 7058},
    Expected{"synth_forest_pine_5000.glb", 1650, 1404, 2, 10000, 8250000},
    Expected{"synth_crowd_armadillo_1024.glb", 34557, 17290, 1, 1024, 35386368},
    Expected{"synth_crowd_armadillo_1024_gpuinst.glb", 34557, 17290, 1, 1024, 35386368},
    Expected{"cornellbox_original.glb", 36, 64, 8, 8, 36},
    Expected{"cornellbox_sphere.glb", 2188, 1280, 8, 8, 2188},
    Expected{"cornellbox_glossy.glb", 1112, 676, 8, 8, 1112},
};

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

// The folder under BOXWOOD_SCENES, or an empty path after saying that `test` is skipped.
std::filesystem::path scenes(const char* test, const char* folder) {
    const std::filesystem::path root = test::scenes_folder();
    if (!root.empty() && std::filesystem::exists(root / folder)) return root / folder;
    MESSAGE("skipped: ", test, ", which needs BOXWOOD_SCENES/", folder);
    return {};
}

} // namespace

TEST_CASE("gltf_scenes: real scenes have the counts of their index") {
    const auto folder = scenes("real scenes have the counts of their index", ".");
    if (folder.empty()) return;
    for (const Expected& expected : index_table) {
        CAPTURE(expected.file);
        const Scene scene = load_gltf(folder / expected.file);
        CHECK_NOTHROW(validate(scene, expected.file));
        CHECK(scene.triangle_count() == expected.triangles);
        CHECK(scene.vertex_count() == expected.vertices);
        CHECK(scene.meshes.size() == expected.meshes);
        CHECK(scene.instances.size() == expected.instances);
        CHECK(scene.instanced_triangle_count() == expected.instanced_triangles);
        CHECK(scene.warnings.empty());
    }
}

TEST_CASE("gltf_scenes: the crowd is the same through nodes and through EXT_mesh_gpu_instancing") {
    const auto folder = scenes("the crowd through nodes and through EXT_mesh_gpu_instancing", ".");
    if (folder.empty()) return;
    const Scene nodes = load_gltf(folder / "synth_crowd_armadillo_1024.glb");
    const Scene gpu = load_gltf(folder / "synth_crowd_armadillo_1024_gpuinst.glb");
    CHECK(gpu.meshes.at(0).positions == nodes.meshes.at(0).positions);
    CHECK(gpu.meshes[0].triangles == nodes.meshes[0].triangles);
    REQUIRE(gpu.instances.size() == nodes.instances.size());
    for (std::size_t i = 0; i < gpu.instances.size(); ++i) {
        for (int column = 0; column < 4; ++column) { // JSON holds decimals of double, the accessors floats
            const glm::vec4 difference = gpu.instances[i].transform[column] - nodes.instances[i].transform[column];
            CHECK(glm::length(difference) <= 1e-6f * glm::length(nodes.instances[i].transform[column]));
        }
    }
}

TEST_CASE("gltf_scenes: every conformance file loads, or is refused for the extension or version it asks for") {
    const auto folder = scenes("every conformance file loads or is refused by name", "conformance");
    if (folder.empty()) return;
    const std::map<std::string, std::string> refused{{"Compatibility_04.gltf", "asset.minVersion"},
                                                     {"Compatibility_05.gltf", "EXT_QuantumRendering"}};
    std::size_t loaded = 0;
    std::size_t turned_away = 0;
    for (const auto& file : gltf_files(folder)) {
        CAPTURE(file.string());
        std::string reason;
        if (const auto found = refused.find(file.filename().string()); found != refused.end()) reason = found->second;
        if (file.string().find("glTF-Draco") != std::string::npos) reason = "KHR_draco_mesh_compression";
        if (reason.empty()) {
            const Scene scene = load_gltf(file);
            CHECK_NOTHROW(validate(scene, file.string()));
            CHECK(scene.instances.size() + scene.counts.skipped_points_and_lines > 0);
            CHECK(scene.counts.dropped_triangles == 0);
            ++loaded;
        } else {
            CHECK_THROWS_WITH_AS(load_gltf(file), doctest::Contains(reason.c_str()), InputError);
            ++turned_away;
        }
    }
    CHECK(loaded > 100);
    CHECK(turned_away == 6); // four with Draco, one of glTF 2.1, one of an extension that does not exist
}

TEST_CASE("gltf_scenes: the same model in different encodings is the same scene") {
    const auto folder = scenes("the same model in different encodings", "conformance/sample-assets");
    if (folder.empty()) return;
    const auto check = [&folder](const char* a, const char* b, double tolerance) {
        CAPTURE(b);
        const Mesh first = flatten(load_gltf(folder / a)).meshes.at(0);
        const Mesh second = flatten(load_gltf(folder / b)).meshes.at(0);
        REQUIRE(first.triangles.size() == second.triangles.size());
        for (std::size_t i = 0; i < first.triangles.size(); ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 p(first.positions[first.triangles[i][corner]]);
                const glm::dvec3 q(second.positions[second.triangles[i][corner]]);
                CHECK(glm::length(p - q) <= tolerance);
            }
        }
    };
    check("Box/glTF/Box.gltf", "Box/glTF-Binary/Box.glb", 0);
    check("Box/glTF/Box.gltf", "Box/glTF-Embedded/Box.gltf", 0);
    check("Box/glTF/Box.gltf", "BoxInterleaved/glTF-Binary/BoxInterleaved.glb", 0);
    check("Duck/glTF/Duck.gltf", "Duck/glTF-Binary/Duck.glb", 0);
    check("AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", "AnimatedMorphCube/glTF-Quantized/AnimatedMorphCube.gltf",
          1e-3);
}

TEST_CASE("gltf_scenes: every conformance file comes back as it was from what is written of it") {
    const auto folder = scenes("every conformance file comes back", "conformance");
    if (folder.empty()) return;
    const test::TemporaryFolder target;
    std::size_t checked = 0;
    for (const auto& file : gltf_files(folder)) {
        CAPTURE(file.string());
        Scene scene;
        try {
            scene = load_gltf(file);
        } catch (const InputError&) {
            continue; // by the test above
        }
        save_glb(target.path() / "again.glb", scene);
        Scene again = load_gltf(target.path() / "again.glb");
        again.warnings = scene.warnings;
        again.counts = scene.counts;
        for (std::size_t i = 0; i < scene.cameras.size(); ++i) { // what a camera's kind does not read is not kept
            again.cameras[i].half_height = scene.cameras[i].half_height;
            again.cameras[i].vertical_fov = scene.cameras[i].vertical_fov;
        }
        CHECK(test::same(again, scene));
        ++checked;
    }
    CHECK(checked > 100);
}

TEST_CASE("gltf_scenes: malformed files load or are refused by name, and a scene that loads keeps its promises") {
    const auto folder = scenes("malformed files", "malformed");
    if (folder.empty()) return;
    const std::map<std::string, std::string> refused{
        {"BoxWithInfinites.glb", "meshes[0].primitives[0].attributes.POSITION[0]"},
        {"AllIndicesOutOfRange.gltf", "meshes[0].primitives[0].indices"},
        {"IndexOutOfRange.gltf", "meshes[0].primitives[0].indices[0]"},
        {"MissingBin/BoxTextured.gltf", "buffers[0].uri"},
        {"RecursiveNodes.gltf", "nodes[0]"},
        {"sceneWrongType.gltf", "scene"},
        {"NoScene.gltf", "scene"},
        {"badArray.gltf", "meshes[0].primitives"},
        {"badString.gltf", "scenes[0].name"},
        {"badExtension.gltf", "materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform"},
        {"badNumber.gltf", "materials[0].normalTexture.index"},
        {"badObject.gltf", "materials[0].pbrMetallicRoughness"},
        {"badUint.gltf", "materials[0].pbrMetallicRoughness.baseColorTexture.index"},
        {"integer-out-of-bounds.gltf", "bufferViews[0].byteLength"},
        {"invalid-buffer-view-index.gltf", "meshes[0].primitives[0].indices"},
        {"invalid-primitive-indices.gltf", "meshes[0].primitives[0].indices"},
        {"issue-416.gltf", "asset.version"},
    };
    std::size_t turned_away = 0;
    for (const auto& file : gltf_files(folder)) {
        CAPTURE(file.string());
        std::string where;
        for (const auto& [name, element] : refused) {
            if (file.string().ends_with("/" + name)) where = element;
        }
        try {
            validate(load_gltf(file), "a scene that loaded");
            CHECK(where == "");
        } catch (const InputError& error) {
            CHECK(error.file == file.string());
            CHECK(error.where == where);
            ++turned_away;
        }
    }
    CHECK(turned_away == refused.size());
}

TEST_SUITE_END();
