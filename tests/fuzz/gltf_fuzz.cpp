// SPDX-License-Identifier: MIT
// Whatever the bytes, the reader returns a scene that keeps its promises or throws an InputError. The first byte of an
// input chooses: 255 is the rest as a file, which tries container and JSON; below that, a sample file with everything
// in it is edited, value by value, which tries what lies behind.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "io/gltf_document.hpp"
#include "io/samples.hpp"

using namespace boxwood;
using nlohmann::json;

namespace {

constexpr std::uint8_t raw_file = 255;

/// The sample scene as glTF: JSON, and the buffer that it names.
struct Sample {
    json root;
    std::string binary;
    std::vector<std::string> places; ///< JSON pointers of all values that hold no others.
};

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

/// Gives the first primitive joints and a morph target, and the first node that shows it a skin: save_glb writes none.
void add_pose(Sample& sample) {
    json& root = sample.root;
    const auto add = [&](const std::string& bytes, int component, std::size_t count, const char* type) {
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", sample.binary.size()}, {"byteLength", bytes.size()}});
        sample.binary += bytes;
        root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", component == 5121}});
        return root["accessors"].size() - 1;
    };
    json& primitive = root["meshes"][0]["primitives"][0];
    json& attributes = primitive["attributes"];
    const auto count = root["accessors"][attributes["POSITION"].get<std::size_t>()]["count"].get<std::size_t>();
    attributes["JOINTS_0"] = add(std::string(8 * count, '\0'), 5123, count, "VEC4");
    attributes["WEIGHTS_0"] = add(std::string(4 * count, '\x40'), 5121, count, "VEC4");
    primitive["targets"] = {{{"POSITION", attributes["POSITION"]}}};
    root["meshes"][0]["weights"] = {0.5};
    std::array<float, 16> identity{};
    for (std::size_t i = 0; i < 16; i += 5) identity[i] = 1.0f;
    std::string matrix(sizeof identity, '\0');
    std::memcpy(matrix.data(), identity.data(), sizeof identity);
    root["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", add(matrix, 5126, 1, "MAT4")}}};
    for (json& node : root["nodes"]) {
        if (node.value("mesh", -1) != 0) continue;
        node["skin"] = 0;
        break;
    }
    root["buffers"][0]["byteLength"] = sample.binary.size();
}

const Sample& sample() {
    static const Sample made = [] {
        const test::TemporaryFolder folder;
        save_glb(folder.path() / "sample.glb", test::sample_scene());
        const std::string bytes = test::read_bytes(folder.path() / "sample.glb");
        const std::size_t length = word_at(bytes, 12);
        Sample result{json::parse(bytes.substr(20, length)), bytes.substr(28 + length), {}};
        result.root["buffers"].push_back({{"byteLength", 4}, {"uri", "data:,text"}});
        result.root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
        result.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = 0;
        result.root["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
            {"diffuseFactor", {1, 0.5, 0, 1}}, {"diffuseTexture", {{"index", 0}}}};
        add_pose(result);
        const json flat = result.root.flatten();
        for (const auto& [place, value] : flat.items()) result.places.push_back(place);
        return result;
    }();
    return made;
}

/// What a value is replaced by.
const std::array<json, 16>& hostile_values() {
    static const std::array<json, 16> values{nullptr,
                                             true,
                                             0,
                                             1,
                                             2,
                                             -1,
                                             7,
                                             0x7fffffff,
                                             0xffffffffu,
                                             std::uint64_t{1} << 53,
                                             0.5,
                                             1e300,
                                             json::array(),
                                             "data:;base64,_-%3D",
                                             -1e-300,
                                             {{"a", 1}}};
    return values;
}

std::string glb(const std::string& text, const std::string& binary) {
    std::string file = "glTF";
    const auto add_word = [&file](std::size_t word) {
        for (int i = 0; i < 4; ++i) file += static_cast<char>(word >> (8 * i));
    };
    add_word(2);
    add_word(28 + text.size() + binary.size());
    add_word(text.size());
    file += "JSON" + text;
    add_word(binary.size());
    return file + std::string("BIN\0", 4) + binary;
}

/// Edits of four bytes: two of JSON values in three, a byte of the buffer else.
std::string edited(std::span<const std::uint8_t> input) {
    json root = sample().root;
    std::string binary = sample().binary;
    for (; input.size() >= 4; input = input.subspan(4)) {
        const std::size_t place = input[1] | static_cast<std::size_t>(input[2]) << 8;
        if (input[0] % 3 == 0) {
            binary[place % binary.size()] = static_cast<char>(input[3]);
            continue;
        }
        const json::json_pointer pointer(sample().places[place % sample().places.size()]);
        // An edit before this one may have taken the value away.
        if (!root.contains(pointer)) continue;
        if (input[0] % 3 == 1)
            root[pointer] = hostile_values()[input[3] % hostile_values().size()];
        else if (root[pointer.parent_pointer()].is_object())
            root[pointer.parent_pointer()].erase(pointer.back());
        else
            root[pointer] = input[3];
    }
    return glb(root.dump(), binary);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::span<const std::uint8_t> input(data, size);
    if (input.empty()) return 0;
    const std::uint8_t choice = input.front();
    input = input.subspan(1);
    const std::string file = choice == raw_file ? std::string(input.begin(), input.end()) : edited(input);
    Scene scene;
    try {
        scene = load_gltf_memory(std::as_bytes(std::span(file)), "fuzz", {});
    } catch (const InputError&) {
        return 0;
    }
    validate(scene, "fuzz"); // throws, and so fails, when the reader let something through
    return 0;
}
