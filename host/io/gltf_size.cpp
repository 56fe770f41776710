// SPDX-License-Identifier: MIT
#include "io/gltf_size.hpp"

#include <algorithm>
#include <set>

#include <unistd.h>

#include "boxwood/error.hpp"
#include "common/memory_limit.hpp"
#include "io/gltf_accessor.hpp"
#include "io/gltf_attributes.hpp"

namespace boxwood {

namespace {

/// Sums in double, which no numbers of a file can make overflow. What the file gets wrong counts as nothing here and is
/// named where it is read.
class SizeCheck {
public:
    explicit SizeCheck(const GltfDocument& document) : document_(document) {}

    void add_mesh(const tinygltf::Mesh& mesh) {
        std::set<VertexKey> known; // primitives of one key share their vertices
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (primitive.mode < TINYGLTF_MODE_TRIANGLES) continue;
            const VertexKey key = vertex_key(primitive);
            const double vertices = count(key[0]);
            if (known.insert(key).second) {
                for (const int accessor : key) {
                    implicit += implicit_count(accessor);
                    bytes += vertices * vector_bytes(accessor);
                }
            }
            implicit += implicit_count(primitive.indices);
            const double corners = primitive.indices < 0 ? vertices : count(primitive.indices);
            const double triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3.0 : corners - 2.0;
            bytes += std::max(0.0, triangles) * sizeof(glm::uvec3);
        }
    }

    /// The instances of a node by EXT_mesh_gpu_instancing, or the one that it has without.
    void add_instances(const tinygltf::Node& node) {
        double instances = 1.0;
        if (const auto found = node.extensions.find("EXT_mesh_gpu_instancing"); found != node.extensions.end()) {
            const tinygltf::Value& attributes = found->second.Get("attributes");
            for (const std::string& name : attributes.Keys()) {
                const int accessor = attributes.Get(name).GetNumberAsInt();
                instances = count(accessor);
                implicit += implicit_count(accessor);
            }
        }
        bytes += instances * static_cast<double>(sizeof(Instance) + node.name.size());
    }

    /// The pictures in buffer views; of a file beside the scene each name is read once.
    void add_images() {
        std::set<int> known;
        for (const nlohmann::json& image : document_.appearance["images"])
            if (image.contains("bufferView") && known.insert(image["bufferView"].get<int>()).second)
                bytes += bytes_there(image["bufferView"].get<int>());
    }

    double implicit = 0.0; ///< Elements without data.
    double bytes = 0.0;    ///< That the scene takes at least.

private:
    const tinygltf::Accessor* find(int index) const {
        const auto& accessors = document_.model.accessors;
        return GltfDocument::has(index, accessors.size()) ? &accessors[static_cast<std::size_t>(index)] : nullptr;
    }

    /// Elements of an accessor, at most as many as there are bytes for them.
    double count(int index) const {
        const tinygltf::Accessor* accessor = find(index);
        if (accessor == nullptr || accessor->bufferView < 0) return implicit_count(index);
        return std::min(static_cast<double>(accessor->count), bytes_there(accessor->bufferView));
    }

    /// Of a buffer view, as far as its buffer has them.
    double bytes_there(int index) const {
        const auto& views = document_.model.bufferViews;
        if (!GltfDocument::has(index, views.size())) return 0.0;
        const tinygltf::BufferView& view = views[static_cast<std::size_t>(index)];
        if (!GltfDocument::has(view.buffer, document_.buffers.size())) return 0.0;
        const std::size_t there = document_.buffers[static_cast<std::size_t>(view.buffer)].bytes.size();
        return static_cast<double>(std::min(view.byteLength, there));
    }

    double implicit_count(int index) const {
        const tinygltf::Accessor* accessor = find(index);
        const bool counts =
            accessor != nullptr && accessor->bufferView < 0 && accessor->count <= largest_implicit_count;
        return counts ? static_cast<double>(accessor->count) : 0.0;
    }

    /// Of one element in the scene.
    double vector_bytes(int index) const {
        const tinygltf::Accessor* accessor = find(index);
        if (accessor == nullptr) return 0.0;
        return sizeof(float) *
               std::max(0, tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor->type)));
    }

    const GltfDocument& document_;
};

} // namespace

std::uint64_t host_memory() {
    const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
    return std::min(pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)), memory_limit());
}

void check_size(const GltfDocument& document, const std::vector<PlacedNode>& nodes, const std::vector<bool>& used,
                std::uint64_t memory) {
    SizeCheck size(document);
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) size.add_mesh(document.model.meshes[i]);
    for (const PlacedNode& placed : nodes)
        if (const tinygltf::Node& node = document.model.nodes[placed.node]; node.mesh >= 0) size.add_instances(node);
    size.add_images();
    const auto whole = [](double number) { return std::to_string(static_cast<std::uint64_t>(number)); };
    if (size.implicit > static_cast<double>(largest_implicit_total))
        document.fail("accessors", "without a bufferView ask for " + whole(size.implicit) +
                                       " elements, of which the file has none; " +
                                       std::to_string(largest_implicit_total) + " are the most that are made up");
    if (size.bytes > static_cast<double>(memory))
        document.fail("", "asks for " + whole(size.bytes) +
                              " bytes of meshes, instances and pictures; this machine has " + std::to_string(memory));
}

} // namespace boxwood
