// SPDX-License-Identifier: MIT
#include "io/gltf_attributes.hpp"

#include <cmath>

#include "io/gltf_accessor.hpp"

namespace boxwood {

namespace {

constexpr std::array<const char*, 6> names{"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};

constexpr glm::vec4 white(1.0f);

template <class Vector>
bool finite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

/// Normalised; zero where it is zero or not finite. What is normalised already, but for rounding, passes unchanged.
glm::vec3 direction_of(const glm::vec3& v) {
    const glm::dvec3 exact(v);
    const double square = glm::dot(exact, exact);
    if (!(square > 0.0) || !std::isfinite(square)) return glm::vec3(0.0f);
    return std::abs(square - 1.0) < 0x1p-20 ? v : glm::vec3(exact / std::sqrt(square));
}

/// What stands in for values, counted.
struct Faults {
    std::size_t not_finite = 0;
    std::size_t zero = 0;
};

glm::vec3 clean_normal(const glm::vec3& n, Faults& faults) {
    const glm::vec3 direction = direction_of(n);
    if (!finite(n))
        ++faults.not_finite;
    else if (direction == glm::vec3(0.0f))
        ++faults.zero;
    return direction;
}

glm::vec4 clean_tangent(const glm::vec4& t, Faults& faults) {
    if (!finite(t)) ++faults.not_finite;
    const glm::vec3 direction = finite(t) ? direction_of(glm::vec3(t)) : glm::vec3(0.0f);
    return direction == glm::vec3(0.0f) ? glm::vec4(0.0f) : glm::vec4(direction, t.w < 0.0f ? -1.0f : 1.0f);
}

glm::vec2 clean_uv(const glm::vec2& uv, Faults& faults) {
    if (std::abs(uv.x) <= largest_coordinate && std::abs(uv.y) <= largest_coordinate) return uv;
    ++faults.not_finite;
    return glm::vec2(0.0f);
}

glm::vec4 clean_color(const glm::vec4& color, Faults& faults) {
    if (finite(color)) return color;
    ++faults.not_finite;
    return white;
}

class AttributeReader {
public:
    AttributeReader(const GltfDocument& document, const VertexKey& key, std::size_t first, const std::string& where,
                    std::size_t vertices, Warnings& warnings)
        : document_(document), key_(key), first_(first), where_(where), vertices_(vertices), warnings_(warnings) {}

    template <class Vector, class Read, class Clean>
    void add(std::size_t place, const Vector& missing, Read read, Clean clean, const char* substitute,
             std::vector<Vector>& target) {
        if (key_[place] < 0) return;
        const std::string where = where_ + "." + names[place];
        std::vector<Vector> values = read(document_, key_[place], where);
        if (values.size() != vertices_ - first_)
            document_.fail(where, "has " + std::to_string(values.size()) + " elements where there are " +
                                      std::to_string(vertices_ - first_) + " positions");
        Faults faults;
        for (Vector& value : values) value = clean(value, faults);
        if (faults.not_finite > 0)
            warnings_.add(where, "values not finite or out of range: " + std::to_string(faults.not_finite) +
                                     "; taken as " + substitute);
        if (faults.zero > 0)
            warnings_.add(where,
                          "normals of length zero: " + std::to_string(faults.zero) + "; the triangles' own stand in");
        target.resize(first_, missing);
        target.insert(target.end(), values.begin(), values.end());
    }

private:
    const GltfDocument& document_;
    const VertexKey& key_;
    std::size_t first_;
    const std::string& where_;
    std::size_t vertices_;
    Warnings& warnings_;
};

} // namespace

VertexKey vertex_key(const tinygltf::Primitive& primitive) {
    VertexKey key;
    for (std::size_t i = 0; i < key.size(); ++i) {
        const auto found = primitive.attributes.find(names[i]);
        key[i] = found == primitive.attributes.end() ? -1 : found->second;
    }
    return key;
}

void add_attributes(const GltfDocument& document, const VertexKey& key, std::size_t first, const std::string& where,
                    Mesh& mesh, Warnings& warnings) {
    AttributeReader reader(document, key, first, where, mesh.positions.size(), warnings);
    reader.add(1, glm::vec3(0.0f), read_vec3, clean_normal, "none", mesh.normals);
    reader.add(2, glm::vec4(0.0f), read_vec4, clean_tangent, "none", mesh.tangents);
    reader.add(3, glm::vec2(0.0f), read_vec2, clean_uv, "0", mesh.uvs[0]);
    reader.add(4, glm::vec2(0.0f), read_vec2, clean_uv, "0", mesh.uvs[1]);
    reader.add(5, white, read_colors, clean_color, "white", mesh.colors);
}

void complete_attributes(Mesh& mesh) {
    const auto complete = [&mesh](auto& values, const auto& missing) {
        if (!values.empty()) values.resize(mesh.positions.size(), missing);
    };
    complete(mesh.normals, glm::vec3(0.0f));
    complete(mesh.tangents, glm::vec4(0.0f));
    for (auto& uvs : mesh.uvs) complete(uvs, glm::vec2(0.0f));
    complete(mesh.colors, white);
}

} // namespace boxwood
