// SPDX-License-Identifier: MIT
#include "io/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include <glm/gtc/type_ptr.hpp>

namespace boxwood {

namespace {

/// Elements in a buffer, known to lie inside it.
struct Elements {
    const std::byte* first;
    std::size_t stride;
};

const tinygltf::Accessor& find_accessor(const GltfDocument& document, int index, const std::string& where) {
    if (!GltfDocument::has(index, document.model.accessors.size())) {
        document.fail(where, "names accessors[" + std::to_string(index) + "], which does not exist");
    }
    return document.model.accessors[static_cast<std::size_t>(index)];
}

// `count` > 0 elements of `size` bytes, `offset` bytes into a buffer view. All sizes come from the file, so nothing is
// added or multiplied before it is known to fit.
Elements find_elements(const GltfDocument& document, int view_index, std::size_t offset, std::size_t count,
                       std::size_t size, const std::string& where) {
    const tinygltf::Model& model = document.model;
    if (!GltfDocument::has(view_index, model.bufferViews.size())) {
        document.fail(where, "names bufferViews[" + std::to_string(view_index) + "], which does not exist");
    }
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
    const std::string view_name = element("bufferViews", static_cast<std::size_t>(view_index));
    if (!GltfDocument::has(view.buffer, document.buffers.size())) {
        document.fail(view_name, "names buffers[" + std::to_string(view.buffer) + "], which does not exist");
    }
    const GltfDocument::Buffer& source = document.buffers[static_cast<std::size_t>(view.buffer)];
    if (!source.fault.empty()) document.fail(source.fault_place, source.fault);
    const std::span<const std::byte> buffer = source.bytes;
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
        document.fail(view_name, "reaches outside " + element("buffers", static_cast<std::size_t>(view.buffer)));
    }
    const std::size_t stride = view.byteStride != 0 ? view.byteStride : size;
    if (stride < size) document.fail(view_name, "has a byteStride smaller than the elements in it");
    if (offset > view.byteLength || size > view.byteLength - offset ||
        (count - 1) > (view.byteLength - offset - size) / stride) {
        document.fail(where, "reaches outside " + view_name);
    }
    return {buffer.data() + view.byteOffset + offset, stride};
}

// Calls use(T{}) for the C++ type of a glTF component type.
template <class Use>
void with_component(const GltfDocument& document, int component_type, const std::string& where, Use use) {
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return use(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return use(std::uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return use(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return use(std::uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return use(std::uint32_t{});
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return use(float{});
    default:
        document.fail(where, "has an unknown componentType, " + std::to_string(component_type));
    }
}

template <class T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof value); // elements need not be aligned in memory
    return value;
}

template <class T>
float to_float(T value, bool normalized) {
    const auto plain = static_cast<float>(value);
    if (std::is_floating_point_v<T> || !normalized) return plain;
    const float scaled = plain / static_cast<float>(std::numeric_limits<T>::max());
    return std::is_signed_v<T> ? std::max(scaled, -1.0f) : scaled;
}

// Sparse indices, checked to be below `count`.
std::vector<std::uint32_t> read_sparse_indices(const GltfDocument& document, const tinygltf::Accessor& accessor,
                                               const std::string& where) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<std::size_t>(sparse.count);
    std::vector<std::uint32_t> indices;
    with_component(document, sparse.indices.componentType, where, [&](auto zero) {
        using T = decltype(zero);
        if constexpr (std::is_unsigned_v<T>) {
            const Elements from =
                find_elements(document, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                              count, sizeof(T), where);
            for (std::size_t i = 0; i < count; ++i) indices.push_back(load<T>(from.first + i * from.stride));
        } else {
            document.fail(where, "has a componentType that cannot be an index");
        }
    });
    for (const std::uint32_t index : indices) {
        if (index >= accessor.count) document.fail(where, "holds " + std::to_string(index) + ", which is out of range");
    }
    return indices;
}

// Fills `out` (accessor.count * components, zero on entry) through convert(T).
template <class T, class Out, class Convert>
void read_elements(const GltfDocument& document, const tinygltf::Accessor& accessor, std::size_t components,
                   const std::string& name, Out* out, Convert convert) {
    const std::size_t size = components * sizeof(T);
    const auto copy = [&](const std::byte* from, std::size_t to) {
        for (std::size_t c = 0; c < components; ++c) out[to * components + c] = convert(load<T>(from + c * sizeof(T)));
    };
    if (accessor.bufferView >= 0) {
        const Elements from =
            find_elements(document, accessor.bufferView, accessor.byteOffset, accessor.count, size, name);
        for (std::size_t i = 0; i < accessor.count; ++i) copy(from.first + i * from.stride, i);
    }
    if (!accessor.sparse.isSparse || accessor.sparse.count <= 0) return;
    const auto indices = read_sparse_indices(document, accessor, name + ".sparse.indices");
    const auto& values = accessor.sparse.values;
    const Elements from = find_elements(document, values.bufferView, static_cast<std::size_t>(values.byteOffset),
                                        indices.size(), size, name + ".sparse.values");
    for (std::size_t i = 0; i < indices.size(); ++i) copy(from.first + i * from.stride, indices[i]);
}

// Checks what can be checked before memory is taken for the elements.
const tinygltf::Accessor& open_accessor(const GltfDocument& document, int index, int type, const char* type_name,
                                        const std::string& where) {
    const tinygltf::Accessor& accessor = find_accessor(document, index, where);
    if (accessor.type != type) document.fail(where, std::string("needs an accessor of type ") + type_name);
    const std::string name = element("accessors", static_cast<std::size_t>(index));
    if (accessor.bufferView < 0) {
        if (accessor.count > largest_implicit_count) document.fail(name, "has no bufferView and too many elements");
    } else if (accessor.count > 0) {
        find_elements(document, accessor.bufferView, accessor.byteOffset, accessor.count, 1, name);
    }
    return accessor;
}

template <class Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, int index, int type, const char* type_name,
                                 const std::string& where) {
    const tinygltf::Accessor& accessor = open_accessor(document, index, type, type_name, where);
    std::vector<Vector> elements(accessor.count, Vector(0.0f));
    if (elements.empty()) return elements;
    const std::string name = element("accessors", static_cast<std::size_t>(index));
    with_component(document, accessor.componentType, name, [&](auto zero) {
        using T = decltype(zero);
        read_elements<T>(document, accessor, sizeof(Vector) / sizeof(float), name, glm::value_ptr(elements.front()),
                         [&](T value) { return to_float(value, accessor.normalized); });
    });
    return elements;
}

} // namespace

std::vector<glm::vec2> read_vec2(const GltfDocument& document, int index, const std::string& where) {
    return read_vectors<glm::vec2>(document, index, TINYGLTF_TYPE_VEC2, "VEC2", where);
}

std::vector<glm::vec3> read_vec3(const GltfDocument& document, int index, const std::string& where) {
    return read_vectors<glm::vec3>(document, index, TINYGLTF_TYPE_VEC3, "VEC3", where);
}

std::vector<glm::vec4> read_vec4(const GltfDocument& document, int index, const std::string& where) {
    return read_vectors<glm::vec4>(document, index, TINYGLTF_TYPE_VEC4, "VEC4", where);
}

std::vector<glm::mat4> read_mat4(const GltfDocument& document, int index, const std::string& where) {
    return read_vectors<glm::mat4>(document, index, TINYGLTF_TYPE_MAT4, "MAT4", where);
}

std::vector<glm::vec4> read_colors(const GltfDocument& document, int index, const std::string& where) {
    if (find_accessor(document, index, where).type != TINYGLTF_TYPE_VEC3) return read_vec4(document, index, where);
    const std::vector<glm::vec3> colors = read_vec3(document, index, where);
    std::vector<glm::vec4> with_alpha;
    with_alpha.reserve(colors.size());
    for (const glm::vec3& color : colors) with_alpha.emplace_back(color, 1.0f);
    return with_alpha;
}

std::span<const std::byte> view_bytes(const GltfDocument& document, int index, const std::string& where) {
    const auto& views = document.model.bufferViews;
    if (!GltfDocument::has(index, views.size())) document.fail(where, "names a buffer view that does not exist");
    const std::size_t size = views[static_cast<std::size_t>(index)].byteLength;
    if (size == 0) return {};
    return {find_elements(document, index, 0, 1, size, where).first, size};
}

bool has_data(const GltfDocument& document, int index, const std::string& where) {
    const tinygltf::Accessor& accessor = find_accessor(document, index, where);
    return accessor.bufferView >= 0 || (accessor.sparse.isSparse && accessor.sparse.count > 0);
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index, const std::string& where,
                                        Warnings& warnings) {
    const tinygltf::Accessor& accessor = open_accessor(document, index, TINYGLTF_TYPE_SCALAR, "SCALAR", where);
    const auto& views = document.model.bufferViews;
    if (GltfDocument::has(accessor.bufferView, views.size()) &&
        views[static_cast<std::size_t>(accessor.bufferView)].byteStride != 0)
        warnings.add_repeated(where, "are in a buffer view with a byteStride, which glTF forbids; followed as it is");
    std::vector<std::uint32_t> elements(accessor.count, 0);
    if (elements.empty()) return elements;
    const std::string name = element("accessors", static_cast<std::size_t>(index));
    with_component(document, accessor.componentType, name, [&](auto zero) {
        using T = decltype(zero);
        if constexpr (std::is_unsigned_v<T>) {
            read_elements<T>(document, accessor, 1, name, elements.data(),
                             [](T value) { return std::uint32_t{value}; });
            if (std::find(elements.begin(), elements.end(), std::numeric_limits<T>::max()) != elements.end()) {
                document.fail(where, "holds the largest value of its type, which glTF forbids (primitive restart)");
            }
        } else {
            document.fail(name, "has a componentType that cannot be an index");
        }
    });
    return elements;
}

std::size_t element_count(const GltfDocument& document, int index, const std::string& where) {
    return find_accessor(document, index, where).count;
}

} // namespace boxwood
