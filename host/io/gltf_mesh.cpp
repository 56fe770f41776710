// SPDX-License-Identifier: MIT
#include "io/gltf_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/gltf_accessor.hpp"
#include "io/gltf_attributes.hpp"
#include "io/gltf_extensions.hpp"
#include "io/gltf_pose.hpp"

namespace boxwood {

namespace {

/// The vertices that one primitive may name: `count` of them from `first` on.
struct VertexRange {
    std::size_t first;
    std::size_t count;
};

using PosedKey = std::pair<VertexKey, std::vector<int>>;

/// The marked elements, in their order. An empty list stays empty.
template <class T>
void keep_marked(const std::vector<bool>& kept, std::vector<T>& elements) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < elements.size(); ++i)
        if (kept[i]) elements[next++] = elements[i];
    elements.resize(next);
}

class MeshLoader {
public:
    MeshLoader(const GltfDocument& document, std::size_t index, const Pose& pose, ImportCounts& counts,
               Warnings& warnings)
        : document_(document), source_(document.model.meshes[index]), where_(element("meshes", index)), pose_(pose),
          counts_(counts), warnings_(warnings) {
        mesh_.name = source_.name;
    }

    Mesh load() {
        if (source_.primitives.empty()) warnings_.add(where_, "has no primitives");
        for (std::size_t i = 0; i < source_.primitives.size(); ++i) {
            add_primitive(source_.primitives[i], element(where_ + ".primitives", i));
        }
        if (!mesh_.materials.empty()) materials_to(mesh_.triangles.size(), BOXWOOD_NONE);
        complete_attributes(mesh_);
        drop_unusable();
        return std::move(mesh_);
    }

private:
    void add_primitive(const tinygltf::Primitive& primitive, const std::string& where) {
        if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            document_.fail(where + ".mode", "is not a mode of glTF");
        }
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
            ++counts_.skipped_points_and_lines;
            return warnings_.add(where, "points or lines, skipped");
        }
        const auto positions = primitive.attributes.find("POSITION");
        if (positions == primitive.attributes.end()) return warnings_.add(where, "has no positions, skipped");
        if (primitive.extensions.contains(draco) && !has_all_data(primitive, where))
            return warnings_.add(where, "has no data but what KHR_draco_mesh_compression holds, left out");

        const VertexRange range = add_vertices(primitive, where);
        first_new_triangle_ = mesh_.triangles.size();
        add_triangles(primitive.mode, vertex_order(primitive, range, where + ".indices"), where);
        turn_mirrored();
        if (mesh_.triangles.size() == first_new_triangle_) warnings_.add(where, "makes no triangle");
        add_materials(primitive, where + ".material");
    }

    /// Positions and, where it has any, indices.
    bool has_all_data(const tinygltf::Primitive& primitive, const std::string& where) const {
        return has_data(document_, primitive.attributes.at("POSITION"), where + ".attributes.POSITION") &&
               (primitive.indices < 0 || has_data(document_, primitive.indices, where + ".indices"));
    }

    VertexRange add_vertices(const tinygltf::Primitive& primitive, const std::string& name) {
        const VertexKey key = vertex_key(primitive);
        const PosedKey posed_key{key, pose_accessors(document_, primitive, pose_, name)};
        if (const auto known = ranges_.find(posed_key); known != ranges_.end()) return known->second;
        const std::string attributes = name + ".attributes", where = attributes + ".POSITION";
        const std::vector<glm::vec3> positions = read_vec3(document_, key[0], where);
        const VertexRange range{mesh_.positions.size(), positions.size()};
        if (range.first + range.count > std::numeric_limits<std::uint32_t>::max()) {
            document_.fail(where, "makes more than 2^32 vertices in one mesh");
        }
        mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
        ranges_.emplace(posed_key, range);
        add_attributes(document_, key, range.first, attributes, mesh_, warnings_);
        if (!pose_.empty()) {
            const auto mirrored = pose_vertices(document_, primitive, pose_, name, range.first, mesh_, warnings_);
            mirrored_.insert(mirrored_.end(), mirrored.begin(), mirrored.end());
        }
        note_unusable(range, where);
        return range;
    }

    // Of the triangles that have none yet. A mesh without any material keeps an empty list.
    void add_materials(const tinygltf::Primitive& primitive, const std::string& where) {
        const std::size_t known = document_.appearance["materials"].size();
        if (primitive.material >= 0 && static_cast<std::size_t>(primitive.material) >= known)
            document_.fail(where, "names a material that does not exist");
        if (primitive.material < 0 && mesh_.materials.empty()) return;
        materials_to(first_new_triangle_, BOXWOOD_NONE);
        materials_to(mesh_.triangles.size(),
                     primitive.material < 0 ? BOXWOOD_NONE : static_cast<std::uint32_t>(primitive.material));
    }

    void materials_to(std::size_t triangles, std::uint32_t material) { mesh_.materials.resize(triangles, material); }

    // Remembers the first unusable vertex of a primitive's positions for the messages of drop_unusable.
    void note_unusable(VertexRange range, const std::string& where) {
        for (std::size_t i = 0; i < range.count && first_unusable_.empty(); ++i) {
            if (!usable(mesh_.positions[range.first + i])) first_unusable_ = element(where, i);
        }
    }

    // Vertices in the order in which the primitive uses them, as indices into the mesh.
    std::vector<std::uint32_t> vertex_order(const tinygltf::Primitive& primitive, VertexRange range,
                                            const std::string& where) {
        std::vector<std::uint32_t> order;
        if (primitive.indices < 0) {
            order.resize(range.count);
            for (std::size_t i = 0; i < range.count; ++i) order[i] = static_cast<std::uint32_t>(range.first + i);
            return order;
        }
        order = read_indices(document_, primitive.indices, where, warnings_);
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (order[i] >= range.count) {
                document_.fail(element(where, i), "is " + std::to_string(order[i]) + " where there are " +
                                                      std::to_string(range.count) + " vertices");
            }
            order[i] += static_cast<std::uint32_t>(range.first);
        }
        return order;
    }

    // The three vertices of every triangle as glTF 2.0 section 3.7.2.1 orders them, so that all face the same way.
    void add_triangles(int mode, const std::vector<std::uint32_t>& v, const std::string& where) {
        if (mode == TINYGLTF_MODE_TRIANGLES) {
            if (v.size() % 3 != 0 && v.size() > 3)
                warnings_.add(where, "the vertices after the last whole triangle are left out");
            for (std::size_t i = 0; i + 2 < v.size(); i += 3) mesh_.triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
            return;
        }
        for (std::size_t i = 0; i + 2 < v.size(); ++i) {
            if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
                mesh_.triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
            } else {
                const std::size_t odd = i % 2;
                mesh_.triangles.emplace_back(v[i], v[i + 1 + odd], v[i + 2 - odd]);
            }
        }
    }

    /// Triangles whose corners are all mirrored turn round, so that their fronts stay where they are on the surface.
    void turn_mirrored() {
        if (mirrored_.empty()) return;
        for (std::size_t i = first_new_triangle_; i < mesh_.triangles.size(); ++i) {
            glm::uvec3& t = mesh_.triangles[i];
            if (mirrored_[t.x] && mirrored_[t.y] && mirrored_[t.z]) std::swap(t.y, t.z);
        }
    }

    static bool usable(const glm::vec3& position) {
        const glm::vec3 size = glm::abs(position); // a NaN fails every comparison
        return size.x <= largest_coordinate && size.y <= largest_coordinate && size.z <= largest_coordinate;
    }

    // Takes out unusable vertices and the triangles that use them; the others keep their order.
    void drop_unusable() {
        if (first_unusable_.empty()) return;
        constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> renumbered(mesh_.positions.size(), gone);
        std::vector<bool> kept(mesh_.positions.size());
        std::uint32_t next = 0;
        for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
            kept[i] = usable(mesh_.positions[i]);
            if (kept[i]) renumbered[i] = next++;
        }
        keep_marked(kept, mesh_.positions);
        keep_marked(kept, mesh_.normals);
        keep_marked(kept, mesh_.tangents);
        for (auto& uvs : mesh_.uvs) keep_marked(kept, uvs);
        keep_marked(kept, mesh_.colors);
        const std::size_t before = mesh_.triangles.size();
        for (glm::uvec3& t : mesh_.triangles) t = {renumbered[t.x], renumbered[t.y], renumbered[t.z]};
        kept.resize(before);
        for (std::size_t i = 0; i < before; ++i) {
            const glm::uvec3& t = mesh_.triangles[i];
            kept[i] = t.x != gone && t.y != gone && t.z != gone;
        }
        keep_marked(kept, mesh_.triangles);
        keep_marked(kept, mesh_.materials);
        const std::size_t dropped = before - mesh_.triangles.size();
        // What a node does to its mesh costs the node its mesh, what is wrong with the mesh itself refuses the file.
        if (before > 0 && mesh_.triangles.empty() && !pose_.places()) {
            document_.fail(first_unusable_,
                           "is not finite or out of range, like a vertex of every triangle of the mesh");
        }
        counts_.dropped_triangles += dropped;
        if (dropped == 0) return;
        warnings_.add(first_unusable_, "is not finite or out of range; triangles dropped: " + std::to_string(dropped));
    }

    const GltfDocument& document_;
    const tinygltf::Mesh& source_;
    std::string where_;
    const Pose& pose_;
    ImportCounts& counts_;
    Warnings& warnings_;
    Mesh mesh_;
    std::map<PosedKey, VertexRange> ranges_;
    std::vector<bool> mirrored_;         ///< By vertex; empty without a pose.
    std::size_t first_new_triangle_ = 0; ///< Of the primitive being added.
    std::string first_unusable_;
};

} // namespace

Mesh load_mesh(const GltfDocument& document, std::size_t index, const Pose& pose, ImportCounts& counts,
               Warnings& warnings) {
    return MeshLoader(document, index, pose, counts, warnings).load();
}

} // namespace boxwood
