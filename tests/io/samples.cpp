// SPDX-License-Identifier: MIT
#include "io/samples.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>

#include "io/sample_materials.hpp"

namespace boxwood::test {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Aabb empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

/// A box and the child reference that it belongs to.
struct Item {
    Aabb box;
    std::uint32_t reference;
};

void grow(Aabb& box, const glm::vec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = std::min(box.min[axis], point[axis]);
        box.max[axis] = std::max(box.max[axis], point[axis]);
    }
}

Aabb box_of(std::span<const Item> items) {
    Aabb box = empty_box;
    for (const Item& item : items) {
        grow(box, {item.box.min[0], item.box.min[1], item.box.min[2]});
        grow(box, {item.box.max[0], item.box.max[1], item.box.max[2]});
    }
    return box;
}

void set_slot(BinaryNode& node, std::size_t slot, const Item& item) {
    node.bounds[slot] = item.box;
    node.child[slot] = item.reference;
}

void set_slot(OrientedNode& node, std::size_t slot, const Item& item) {
    float* volume = node.volume[slot];
    const bool aligned = item.reference == BOXWOOD_NONE || item.reference % 2 == 0;
    node.child[slot] = item.reference | (aligned ? BOXWOOD_ALIGNED : 0u);
    std::fill_n(volume, 15, 0.0f);
    for (int k = 0; k < 3; ++k) {
        const float low = item.box.min[k], high = item.box.max[k];
        const int axis = (k + 1) % 3; // row `axis` of the axes is unit vector k
        volume[k] = aligned ? low : 0.5f * (low + high);
        volume[3 + (aligned ? k : axis)] = aligned ? high : 0.5f * (high - low);
        if (!aligned) volume[6 + 3 * k + axis] = 1.0f;
    }
}

void set_slot(Wide8Node& node, std::size_t slot, const Item& item) {
    node.min_x[slot] = item.box.min[0];
    node.min_y[slot] = item.box.min[1];
    node.min_z[slot] = item.box.min[2];
    node.max_x[slot] = item.box.max[0];
    node.max_y[slot] = item.box.max[1];
    node.max_z[slot] = item.box.max[2];
    node.child[slot] = item.reference;
}

void set_count(BinaryNode&, std::size_t) {}
void set_count(OrientedNode&, std::size_t) {}
void set_count(Wide8Node& node, std::size_t count) { node.count = static_cast<std::uint32_t>(count); }

/// Appends the tree over `items`, root first, and returns its depth.
template <class Node>
std::uint32_t append_tree(std::vector<Node>& nodes, std::span<const Item> items) {
    constexpr std::size_t width = std::is_same_v<Node, Wide8Node> ? 8 : 2;
    const std::size_t self = nodes.size();
    nodes.emplace_back();
    for (std::size_t slot = 0; slot < width; ++slot) set_slot(nodes[self], slot, {empty_box, BOXWOOD_NONE});
    const std::size_t used = std::min(width, items.size());
    set_count(nodes[self], used);
    std::uint32_t depth = 1;
    for (std::size_t slot = 0; slot < used; ++slot) {
        const std::size_t first = items.size() * slot / used;
        const auto part = items.subspan(first, items.size() * (slot + 1) / used - first);
        Item item{box_of(part), part.front().reference};
        if (part.size() > 1) {
            item.reference = static_cast<std::uint32_t>(nodes.size());
            depth = std::max(depth, 1 + append_tree(nodes, part));
        }
        set_slot(nodes[self], slot, item);
    }
    return depth;
}

using Corners = std::array<glm::vec3, 3>;

std::vector<Corners> triangles_of(const Mesh& mesh, const glm::mat4& transform) {
    std::vector<Corners> triangles;
    for (const glm::uvec3& indices : mesh.triangles) {
        Corners corners;
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 position = mesh.positions[indices[i]];
            corners[static_cast<std::size_t>(i)] = glm::vec3(transform * glm::vec4(position, 1.0f));
        }
        triangles.push_back(corners);
    }
    return triangles;
}

std::vector<Item> append_leaves(std::vector<Triangle>& leaves, const std::vector<Corners>& triangles) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        items.push_back({empty_box, BOXWOOD_LEAF | static_cast<std::uint32_t>(leaves.size())});
        for (const glm::vec3& corner : triangles[i]) grow(items.back().box, corner);
        leaves.push_back({{a.x, a.y, a.z}, static_cast<std::uint32_t>(i), {b.x, b.y, b.z}, 0, {c.x, c.y, c.z}, 0});
    }
    return items;
}

std::vector<Item> append_leaves(std::vector<Triangle4>& blocks, const std::vector<Corners>& triangles) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t slot = i % 4;
        if (slot == 0) {
            items.push_back({empty_box, BOXWOOD_LEAF | static_cast<std::uint32_t>(blocks.size())});
            blocks.push_back({});
            std::ranges::fill(blocks.back().primitive, BOXWOOD_NONE);
        }
        const auto& [a, b, c] = triangles[i];
        for (const glm::vec3& corner : triangles[i]) grow(items.back().box, corner);
        Triangle4& block = blocks.back();
        block.v0_x[slot] = a.x;
        block.v0_y[slot] = a.y;
        block.v0_z[slot] = a.z;
        block.v1_x[slot] = b.x;
        block.v1_y[slot] = b.y;
        block.v1_z[slot] = b.z;
        block.v2_x[slot] = c.x;
        block.v2_y[slot] = c.y;
        block.v2_z[slot] = c.z;
        block.primitive[slot] = static_cast<std::uint32_t>(i);
    }
    return items;
}

InstanceRecord record_of(const Instance& instance, std::uint32_t root) {
    InstanceRecord record{};
    const glm::mat4 inverse = glm::inverse(instance.transform);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            record.to_object[4 * row + column] = inverse[column][row];
            record.to_world[4 * row + column] = instance.transform[column][row];
        }
    }
    record.mesh = instance.mesh;
    record.root = root;
    return record;
}

template <class Node, class Leaf>
void build(TreeImage& tree, const Scene& scene, std::vector<Node>& nodes, std::vector<Leaf>& leaves,
           std::vector<Node>& top) {
    if (tree.levels == Levels::one) {
        std::vector<Corners> all;
        for (const Instance& instance : scene.instances) {
            const auto part = triangles_of(scene.meshes[instance.mesh], instance.transform);
            all.insert(all.end(), part.begin(), part.end());
        }
        if (scene.instances.size() > 1) {
            tree.first_triangles = {0};
            for (const Instance& instance : scene.instances) {
                const std::size_t count = scene.meshes[instance.mesh].triangles.size();
                tree.first_triangles.push_back(tree.first_triangles.back() + static_cast<std::uint32_t>(count));
            }
        }
        if (!all.empty()) tree.bottom_depth = append_tree<Node>(nodes, append_leaves(leaves, all));
        return;
    }
    std::vector<std::uint32_t> roots;
    for (const Mesh& mesh : scene.meshes) {
        roots.push_back(static_cast<std::uint32_t>(nodes.size()));
        const auto items = append_leaves(leaves, triangles_of(mesh, glm::mat4(1.0f)));
        tree.bottom_depth = std::max(tree.bottom_depth, append_tree<Node>(nodes, items));
    }
    std::vector<Item> items;
    for (const Instance& instance : scene.instances) {
        items.push_back({empty_box, BOXWOOD_LEAF | static_cast<std::uint32_t>(items.size())});
        for (const Corners& corners : triangles_of(scene.meshes[instance.mesh], instance.transform)) {
            for (const glm::vec3& corner : corners) grow(items.back().box, corner);
        }
        tree.instances.push_back(record_of(instance, roots[instance.mesh]));
    }
    if (!items.empty()) tree.top_depth = append_tree<Node>(top, items);
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same(const Mesh& a, const Mesh& b) {
    return a.name == b.name && same_bytes(a.positions, b.positions) && same_bytes(a.triangles, b.triangles) &&
           a.materials == b.materials && same_bytes(a.normals, b.normals) && same_bytes(a.tangents, b.tangents) &&
           same_bytes(a.uvs[0], b.uvs[0]) && same_bytes(a.uvs[1], b.uvs[1]) && same_bytes(a.colors, b.colors);
}

} // namespace

Scene sample_scene() {
    Scene scene;
    scene.meshes.push_back({"one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    Mesh strip{"strip", {}, {}};
    constexpr std::uint32_t triangles = 37;
    for (std::uint32_t i = 0; i < triangles + 2; ++i) {
        strip.positions.push_back(
            {static_cast<float>(i / 2), static_cast<float>(i % 2), 0.25f * static_cast<float>(i)});
    }
    for (std::uint32_t i = 0; i < triangles; ++i) strip.triangles.push_back({i, i + 1, i + 2});
    scene.meshes.push_back(strip);
    add_materials(scene);
    glm::mat4 moved(2.0f); // powers of two: the inverse is exact
    moved[3] = {4.0f, -8.0f, 16.0f, 1.0f};
    scene.instances = {{"a", 0, glm::mat4(1.0f)}, {"", 1, moved}, {"c", 0, moved}};
    scene.cameras = {{"eye", glm::mat4(1.0f), true, 0.5f, 1.0f}, {"flat", glm::mat4(1.0f), false, 0.5f, 3.0f}};
    scene.counts = {1, 2, 3};
    scene.warnings = {"skins[0]: rest pose"};
    return scene;
}

TreeImage sample_tree(const Scene& scene, Layout layout, Levels levels, Bounds bounds) {
    TreeImage tree;
    tree.sphere = scene_sphere(scene);
    tree.layout = layout;
    tree.levels = levels;
    tree.bounds = bounds;
    if (bounds != Bounds::aabb) {
        build(tree, scene, tree.oriented_nodes, tree.triangles, tree.oriented_top);
    } else if (layout == Layout::binary) {
        build(tree, scene, tree.binary_nodes, tree.triangles, tree.binary_top);
    } else {
        build(tree, scene, tree.wide_nodes, tree.blocks, tree.wide_top);
    }
    return tree;
}

void add_sample_area(TreeImage& tree) {
    InfluenceRecord region{};
    region.right[0] = region.up[1] = region.forward[2] = 1.0f;
    region.half_width = region.half_height = region.far = 2.0f;
    const Aabb box{{-2, -2, 0}, {2, 2, 2}};
    const Aabb none{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    std::uint32_t root = 0;
    if (tree.layout == Layout::binary) {
        const auto is_first = [](const Triangle& triangle) { return triangle.primitive == 0; };
        const Triangle first = *std::find_if(tree.triangles.begin(), tree.triangles.end(), is_first);
        const auto leaf = BOXWOOD_LEAF | static_cast<std::uint32_t>(tree.triangles.size());
        root = static_cast<std::uint32_t>(tree.binary_nodes.size());
        tree.triangles.push_back(first);
        tree.binary_nodes.push_back({{box, none}, {leaf, BOXWOOD_NONE}, {0, 0}});
    } else {
        const auto is_first = [](const Triangle4& block) { return block.primitive[0] == 0; };
        const Triangle4 first = *std::find_if(tree.blocks.begin(), tree.blocks.end(), is_first);
        root = static_cast<std::uint32_t>(tree.wide_nodes.size());
        Wide8Node node{};
        for (std::uint32_t i = 0; i < 8; ++i) {
            const Aabb& slot = i == 0 ? box : none;
            node.min_x[i] = slot.min[0], node.max_x[i] = slot.max[0];
            node.min_y[i] = slot.min[1], node.max_y[i] = slot.max[1];
            node.min_z[i] = slot.min[2], node.max_z[i] = slot.max[2];
            node.child[i] = i == 0 ? BOXWOOD_LEAF | static_cast<std::uint32_t>(tree.blocks.size()) : BOXWOOD_NONE;
        }
        node.count = 1;
        tree.wide_nodes.push_back(node);
        tree.blocks.push_back(first);
    }
    tree.areas = {{region, box, root, 0}};
    tree.area_index.kind = AreaIndexKind::kd;
    tree.area_index.nodes = {{{0, 0, 1}, 2, 1, BOXWOOD_NONE}, {{}, 0, 0, 1}, {{}, 0, 1, 1}};
    tree.area_index.items = {0, 0};
}

bool same(const Scene& a, const Scene& b) {
    const auto bits = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    const auto instances = [&](const Instance& x, const Instance& y) {
        return x.name == y.name && x.mesh == y.mesh && bits(x.transform, y.transform);
    };
    const auto cameras = [&](const Camera& x, const Camera& y) {
        return x.name == y.name && bits(x.to_world, y.to_world) && x.perspective == y.perspective &&
               bits(x.vertical_fov, y.vertical_fov) && bits(x.half_height, y.half_height);
    };
    const auto same_mesh = [](const Mesh& x, const Mesh& y) { return same(x, y); };
    return std::ranges::equal(a.meshes, b.meshes, same_mesh) &&
           std::ranges::equal(a.instances, b.instances, instances) &&
           std::ranges::equal(a.cameras, b.cameras, cameras) && bits(a.counts, b.counts) && a.warnings == b.warnings &&
           same_materials(a, b);
}

bool same(const TreeImage& a, const TreeImage& b) {
    return a.layout == b.layout && a.levels == b.levels && a.bounds == b.bounds &&
           same_bytes(a.binary_nodes, b.binary_nodes) && same_bytes(a.oriented_nodes, b.oriented_nodes) &&
           same_bytes(a.oriented_top, b.oriented_top) && same_bytes(a.triangles, b.triangles) &&
           same_bytes(a.wide_nodes, b.wide_nodes) && same_bytes(a.blocks, b.blocks) &&
           same_bytes(a.binary_top, b.binary_top) && same_bytes(a.wide_top, b.wide_top) &&
           same_bytes(a.instances, b.instances) && same_bytes(a.first_triangles, b.first_triangles) &&
           same_bytes(a.areas, b.areas) && a.area_index.kind == b.area_index.kind &&
           same_bytes(a.area_index.nodes, b.area_index.nodes) && same_bytes(a.area_index.items, b.area_index.items) &&
           a.bottom_depth == b.bottom_depth && a.top_depth == b.top_depth;
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "boxwood-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::size_t TemporaryFolder::entries() const {
    const std::filesystem::directory_iterator entries(path_);
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

} // namespace boxwood::test
