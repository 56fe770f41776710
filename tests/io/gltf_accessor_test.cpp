// SPDX-License-Identifier: MIT
#include "io/gltf_accessor.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <doctest/doctest.h>

#include "io/gltf_fixture.hpp"
#include "support.hpp"

TEST_SUITE_BEGIN("io");

using namespace boxwood;
using boxwood::test::GltfFixture;
using nlohmann::json;

namespace {

struct Component {
    int type;
    std::size_t size;
    std::function<double(const std::byte*)> plain;
    double largest; ///< Divisor when normalised; 0 for float.
    bool is_signed;
};

template <class T>
Component component(int type, bool is_integer = true) {
    const auto read = [](const std::byte* from) {
        T value;
        std::memcpy(&value, from, sizeof value);
        return static_cast<double>(value);
    };
    return {type, sizeof(T), read, is_integer ? static_cast<double>(std::numeric_limits<T>::max()) : 0.0,
            std::numeric_limits<T>::is_signed};
}

const std::array components{component<std::int8_t>(5120),   component<std::uint8_t>(5121),
                            component<std::int16_t>(5122),  component<std::uint16_t>(5123),
                            component<std::uint32_t>(5125), component<float>(5126, false)};

// Position values of three vertices in every layout; they span a triangle whatever the bytes are.
std::vector<std::byte> random_bytes(test::Random& random, const Component& kind, std::size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.bits());
    if (kind.type != 5126) return bytes;
    for (std::size_t i = 0; i + 4 <= count; i += 4) { // random bits would hold NaNs
        const float value = random.uniform(-10.0f, 10.0f);
        std::memcpy(&bytes[i], &value, 4);
    }
    return bytes;
}

// The specification's table of conversions, in double.
double expected(const Component& kind, const std::byte* from, bool normalized) {
    const double value = kind.plain(from);
    if (!normalized || kind.largest == 0.0) return value;
    return kind.is_signed ? std::fmax(value / kind.largest, -1.0) : value / kind.largest;
}

} // namespace

TEST_CASE("gltf_accessor: positions of every component type, stride and offset") {
    test::Random random(2);
    for (const Component& kind : components) {
        for (const bool normalized : {false, true}) {
            // tight; one element and padding; interleaved with something larger; the largest stride that glTF allows
            for (const std::size_t stride : {std::size_t{0}, std::size_t{12}, std::size_t{20}, std::size_t{252}}) {
                for (const std::size_t offset : {std::size_t{0}, std::size_t{8}}) {
                    CAPTURE(kind.type);
                    CAPTURE(normalized);
                    CAPTURE(stride);
                    CAPTURE(offset);
                    constexpr std::size_t count = 7;
                    const std::size_t step = stride != 0 ? stride : 3 * kind.size;
                    GltfFixture fixture;
                    fixture.view(std::vector<std::uint8_t>(8)); // so that the view does not start the buffer
                    const auto bytes = random_bytes(random, kind, offset + (count - 1) * step + 3 * kind.size);
                    const std::size_t accessor =
                        fixture.accessor(fixture.view(bytes, stride), kind.type, count, "VEC3");
                    fixture.root["accessors"][accessor]["byteOffset"] = offset;
                    fixture.root["accessors"][accessor]["normalized"] = normalized;
                    fixture.show({{"attributes", {{"POSITION", accessor}}}, {"mode", 5}});

                    const Scene scene = fixture.load();
                    REQUIRE(scene.meshes.at(0).positions.size() == count);
                    for (std::size_t i = 0; i < count; ++i) {
                        for (std::size_t c = 0; c < 3; ++c) {
                            const std::byte* from = &bytes[offset + i * step + c * kind.size];
                            const auto want = static_cast<float>(expected(kind, from, normalized));
                            const float got = scene.meshes[0].positions[i][static_cast<int>(c)];
                            CHECK(std::abs(got - want) <= std::abs(want) * 0x1p-23f);
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("gltf_accessor: indices of every type, and none") {
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<glm::uvec3> wanted{{2, 1, 0}, {0, 3, 2}};
    const auto load = [&](auto zero, int type) {
        GltfFixture fixture;
        const std::size_t positions = fixture.positions(square);
        const std::vector<decltype(zero)> order{2, 1, 0, 0, 3, 2};
        const std::size_t indices = fixture.accessor(fixture.view(order), type, order.size(), "SCALAR");
        fixture.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        return fixture.load().meshes.at(0).triangles;
    };
    CHECK(load(std::uint8_t{}, 5121) == wanted);
    CHECK(load(std::uint16_t{}, 5123) == wanted);
    CHECK(load(std::uint32_t{}, 5125) == wanted);

    GltfFixture fixture;
    fixture.show(
        {{"attributes", {{"POSITION", fixture.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 0, 2, 0})}}}});
    CHECK(fixture.load().meshes.at(0).triangles == std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}});
}

TEST_CASE("gltf_accessor: sparse positions, over a buffer view and over zeros") {
    for (const bool with_base : {true, false}) {
        CAPTURE(with_base);
        GltfFixture fixture;
        std::vector<float> base(5 * 3);
        for (std::size_t i = 0; with_base && i < base.size(); ++i) base[i] = static_cast<float>(i + 1);
        const std::size_t accessor = fixture.positions(base);
        if (!with_base) fixture.root["accessors"][accessor].erase("bufferView");
        fixture.root["accessors"][accessor]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", fixture.view(std::vector<std::uint16_t>{1, 4})}, {"componentType", 5123}}},
            {"values", {{"bufferView", fixture.view(std::vector<float>{-1, -2, -3, -4, -5, -6})}}}};
        fixture.show({{"attributes", {{"POSITION", accessor}}}, {"mode", 5}});

        std::vector<glm::vec3> wanted;
        for (std::size_t i = 0; i < 5; ++i) wanted.emplace_back(base[3 * i], base[3 * i + 1], base[3 * i + 2]);
        wanted[1] = {-1, -2, -3};
        wanted[4] = {-4, -5, -6};
        CHECK(fixture.load().meshes.at(0).positions == wanted);

        json& sparse = fixture.root["accessors"][accessor]["sparse"];
        const std::string name = "accessors[" + std::to_string(accessor) + "].sparse";
        GltfFixture wrong = fixture;
        wrong.root["accessors"][accessor]["sparse"]["count"] = 3;
        CHECK(wrong.fault() == name + ".indices");
        wrong = fixture;
        wrong.root["accessors"][accessor]["sparse"]["values"]["byteOffset"] = 4;
        CHECK(wrong.fault() == name + ".values");
        wrong = fixture;
        wrong.root["accessors"][accessor]["count"] = 4; // index 4 is then outside
        CHECK(wrong.fault() == name + ".indices");
        sparse["indices"]["componentType"] = 5126;
        CHECK(fixture.fault() == name + ".indices");
    }
}

TEST_CASE("gltf_accessor: an accessor that reaches outside is refused, whatever arithmetic would overflow") {
    const auto fault = [](auto change) {
        GltfFixture fixture = test::triangle_fixture(); // accessor 0 positions in view 0, accessor 1 indices in view 1
        change(fixture.root);
        return fixture.fault();
    };
    constexpr std::uint64_t huge = std::uint64_t{1} << 53;
    CHECK(fault([](json&) {}) == "no error");
    CHECK(fault([](json& r) { r["accessors"][0]["count"] = 4; }) == "accessors[0]");
    CHECK(fault([&](json& r) { r["accessors"][0]["count"] = huge; }) == "accessors[0]");
    CHECK(fault([](json& r) { r["accessors"][0]["byteOffset"] = 4; }) == "accessors[0]");
    CHECK(fault([&](json& r) { r["accessors"][0]["byteOffset"] = huge; }) == "accessors[0]");
    CHECK(fault([](json& r) { r["accessors"][0]["byteOffset"] = -4; }) == "accessors[0].byteOffset");
    CHECK(fault([](json& r) { r["accessors"][0]["bufferView"] = 2; }) == "accessors[0]");
    CHECK(fault([](json& r) { r["accessors"][0]["componentType"] = 5124; }) == "accessors[0].componentType");
    CHECK(fault([](json& r) { r["accessors"][0]["type"] = "VEC5"; }) == "accessors[0].type");
    CHECK(fault([](json& r) { r["accessors"][0]["type"] = "VEC2"; }) == "meshes[0].primitives[0].attributes.POSITION");
    CHECK(fault([&](json& r) {
              r["accessors"][0].erase("bufferView");
              r["accessors"][0]["count"] = huge;
          }) == "accessors[0]");
    CHECK(fault([](json& r) { r["bufferViews"][0]["byteLength"] = 1000; }) == "bufferViews[0]");
    CHECK(fault([&](json& r) { r["bufferViews"][0]["byteLength"] = huge; }) == "bufferViews[0]");
    CHECK(fault([&](json& r) { r["bufferViews"][0]["byteOffset"] = huge; }) == "bufferViews[0]");
    CHECK(fault([](json& r) { r["bufferViews"][0]["byteStride"] = 8; }) == "bufferViews[0]"); // smaller than a VEC3
    CHECK(fault([](json& r) { r["bufferViews"][0]["byteStride"] = 13; }) == "accessors[0]");
    CHECK(fault([](json& r) { r["bufferViews"][0]["buffer"] = 1; }) == "bufferViews[0]");
    CHECK(fault([](json& r) { r["bufferViews"][0]["buffer"] = "0"; }) == "bufferViews[0].buffer");
    CHECK(fault([](json& r) { r["bufferViews"][0]["buffer"] = std::uint64_t{1} << 32; }) == "bufferViews[0].buffer");
    CHECK(fault([](json& r) { r["buffers"] = {{{"byteLength", 1000}}}; }) == "buffers[0]");
    CHECK(fault([](json& r) { r["buffers"] = {{{"byteLength", 8}}}; }) == "bufferViews[0]");
}

TEST_SUITE_END();
