// SPDX-License-Identifier: MIT
#include "oracles/reference_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "oracles/brute_force.hpp"
#include "oracles/reference_obb.hpp"
#include "oracles/triangle_box.hpp"

namespace boxwood::test {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Box {
    glm::vec3 low{infinity};
    glm::vec3 high{-infinity};
    void add(const glm::vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
    void add(const Box& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
    double half_area() const {
        if (low.x > high.x) return 0.0;
        const glm::dvec3 e = glm::dvec3(high) - glm::dvec3(low);
        return e.x * e.y + e.y * e.z + e.z * e.x;
    }
};

Aabb to_aabb(const Box& b) { return {{b.low.x, b.low.y, b.low.z}, {b.high.x, b.high.y, b.high.z}}; }

/// A binary tree over boxes; a leaf has one primitive.
struct Node {
    Box box;
    int left = -1, right = -1;
    std::uint32_t first = 0, count = 0; ///< Range of `order`.
};

struct BinaryTree {
    std::vector<Node> nodes; ///< Root 0.
    std::vector<std::uint32_t> order;
};

/// Splits order[first, first + count), sorted along the best axis; returns how many go left.
std::uint32_t split(const std::vector<Box>& boxes, std::vector<std::uint32_t>& order, const Node& node, Shape shape) {
    const auto begin = order.begin() + node.first;
    const auto end = begin + node.count;
    const auto centre = [&](std::uint32_t i, int axis) {
        return static_cast<double>(boxes[i].low[axis]) + boxes[i].high[axis];
    };
    if (shape == Shape::chain) {
        std::sort(begin, end, [&](auto a, auto b) { return centre(a, 0) < centre(b, 0); });
        return node.count - 1;
    }
    constexpr int bins = 16;
    double best_cost = std::numeric_limits<double>::infinity();
    int best_axis = -1;
    double best_plane = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (auto i = begin; i != end; ++i)
            low = std::min(low, centre(*i, axis)), high = std::max(high, centre(*i, axis));
        if (!(low < high)) continue;
        Box bin_box[bins];
        std::uint32_t bin_count[bins] = {};
        const auto bin_of = [&](std::uint32_t i) {
            return std::min(bins - 1, static_cast<int>((centre(i, axis) - low) / (high - low) * bins));
        };
        for (auto i = begin; i != end; ++i) bin_box[bin_of(*i)].add(boxes[*i]), ++bin_count[bin_of(*i)];
        for (int plane = 1; plane < bins; ++plane) {
            Box left, right;
            std::uint32_t left_count = 0;
            for (int b = 0; b < bins; ++b) (b < plane ? left : right).add(bin_box[b]);
            for (int b = 0; b < plane; ++b) left_count += bin_count[b];
            if (left_count == 0 || left_count == node.count) continue;
            const double cost = left.half_area() * left_count + right.half_area() * (node.count - left_count);
            if (cost < best_cost) best_cost = cost, best_axis = axis, best_plane = low + (high - low) * plane / bins;
        }
    }
    const std::uint32_t half = node.count / 2;
    if (best_axis < 0) return half;
    const auto middle = std::partition(begin, end, [&](auto i) { return centre(i, best_axis) < best_plane; });
    const auto left_count = static_cast<std::uint32_t>(middle - begin);
    return left_count == 0 || left_count == node.count ? half : left_count;
}

BinaryTree make_binary(const std::vector<Box>& boxes, Shape shape) {
    BinaryTree tree;
    tree.order.resize(boxes.size());
    std::iota(tree.order.begin(), tree.order.end(), 0u);
    tree.nodes.push_back({{}, -1, -1, 0, static_cast<std::uint32_t>(boxes.size())});
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
        Node node = tree.nodes[n];
        for (std::uint32_t i = 0; i < node.count; ++i) node.box.add(boxes[tree.order[node.first + i]]);
        if (node.count > 1) {
            const std::uint32_t left = split(boxes, tree.order, node, shape);
            node.left = static_cast<int>(tree.nodes.size());
            node.right = node.left + 1;
            tree.nodes.push_back({{}, -1, -1, node.first, left});
            tree.nodes.push_back({{}, -1, -1, node.first + left, node.count - left});
        }
        tree.nodes[n] = node;
    }
    return tree;
}

/// The vertices of each primitive, and how far each may be off.
struct Corners {
    std::vector<std::vector<glm::dvec3>> of;
    double slack = 0.0;
};

/// Turns binary trees into one layout. `add_leaf` stores the primitives of a node and returns its leaf index; `corners`
/// are read for oriented boxes.
template <class AddLeaf>
class Emitter {
public:
    Emitter(const BinaryTree& tree, std::uint32_t leaf_size, const Corners& corners, AddLeaf add_leaf)
        : tree_(tree), leaf_size_(leaf_size), corners_(corners), add_leaf_(add_leaf) {}

    /// Appends the tree to `nodes` and returns its depth.
    std::uint32_t emit(std::vector<BinaryNode>& nodes, int source = 0) {
        const Node& node = tree_.nodes[static_cast<std::size_t>(source)];
        std::vector<int> children{node.left, node.right};
        if (node.count == 1) children = {source};
        BinaryNode made{};
        const auto empty = to_aabb({});
        made.bounds[0] = made.bounds[1] = empty;
        made.child[0] = made.child[1] = BOXWOOD_NONE;
        return append(nodes, made, children, [](BinaryNode& n, std::size_t slot, const Node& child, std::uint32_t ref) {
            n.bounds[slot] = to_aabb(child.box);
            n.child[slot] = ref;
        });
    }

    std::uint32_t emit(std::vector<OrientedNode>& nodes, int source = 0) {
        const Node& node = tree_.nodes[static_cast<std::size_t>(source)];
        std::vector<int> children{node.left, node.right};
        if (node.count == 1) children = {source};
        OrientedNode made{};
        for (float* volume : {made.volume[0], made.volume[1]}) {
            std::fill_n(volume, 3, infinity);
            std::fill_n(volume + 3, 3, -infinity);
        }
        made.child[0] = made.child[1] = BOXWOOD_NONE;
        return append(nodes, made, children,
                      [&](OrientedNode& n, std::size_t slot, const Node& child, std::uint32_t ref) {
                          n.child[slot] = set_volume(child, n.volume[slot]) ? ref | BOXWOOD_ALIGNED : ref;
                      });
    }

    std::uint32_t emit(std::vector<Wide8Node>& nodes, int source = 0) {
        std::vector<int> children{source};
        while (children.size() < 8) {
            const auto larger = [&](int a, int b) { return opening_area(a) < opening_area(b); };
            const auto widest = std::max_element(children.begin(), children.end(), larger);
            if (opening_area(*widest) < 0.0) break;
            const Node& node = tree_.nodes[static_cast<std::size_t>(*widest)];
            *widest = node.left;
            children.push_back(node.right);
        }
        Wide8Node made{};
        for (int slot = 0; slot < 8; ++slot) {
            made.min_x[slot] = made.min_y[slot] = made.min_z[slot] = infinity;
            made.max_x[slot] = made.max_y[slot] = made.max_z[slot] = -infinity;
            made.child[slot] = BOXWOOD_NONE;
        }
        made.count = static_cast<std::uint32_t>(children.size());
        return append(nodes, made, children, [](Wide8Node& n, std::size_t slot, const Node& child, std::uint32_t ref) {
            const Aabb box = to_aabb(child.box);
            n.min_x[slot] = box.min[0], n.min_y[slot] = box.min[1], n.min_z[slot] = box.min[2];
            n.max_x[slot] = box.max[0], n.max_y[slot] = box.max[1], n.max_z[slot] = box.max[2];
            n.child[slot] = ref;
        });
    }

private:
    const Node& at(int index) const { return tree_.nodes[static_cast<std::size_t>(index)]; }
    double opening_area(int index) const { return at(index).count <= leaf_size_ ? -1.0 : at(index).box.half_area(); }

    /// The volume of a node; whether it is aligned.
    bool set_volume(const Node& node, float* volume) {
        const std::uint32_t choice = random_.below(4);
        if (choice == 0) {
            const Aabb box = to_aabb(node.box);
            std::copy_n(box.min, 3, volume);
            std::copy_n(box.max, 3, volume + 3);
            return true;
        }
        std::vector<glm::dvec3> points;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            points.insert(points.end(), corners_.of[tree_.order[i]].begin(), corners_.of[tree_.order[i]].end());
        store_volume(box_around(random_rows(random_, choice == 1), points, corners_.slack), volume);
        return false;
    }

    template <class AnyNode, class Set>
    std::uint32_t append(std::vector<AnyNode>& nodes, const AnyNode& made, const std::vector<int>& children, Set set) {
        const std::size_t index = nodes.size();
        nodes.push_back(made);
        std::uint32_t depth = 0;
        for (std::size_t slot = 0; slot < children.size(); ++slot) {
            const Node& child = at(children[slot]);
            std::uint32_t reference;
            if (child.count <= leaf_size_) {
                reference = BOXWOOD_LEAF |
                            add_leaf_(std::vector<std::uint32_t>(tree_.order.begin() + child.first,
                                                                 tree_.order.begin() + child.first + child.count));
            } else {
                reference = static_cast<std::uint32_t>(nodes.size());
                depth = std::max(depth, emit(nodes, children[slot]));
            }
            set(nodes[index], slot, child, reference);
        }
        return depth + 1;
    }

    const BinaryTree& tree_;
    std::uint32_t leaf_size_;
    const Corners& corners_;
    AddLeaf add_leaf_;
    Random random_{77};
};

void store(const std::array<glm::vec3, 3>& c, std::uint32_t primitive, Triangle& out) {
    out = {{c[0].x, c[0].y, c[0].z}, primitive, {c[1].x, c[1].y, c[1].z}, 0, {c[2].x, c[2].y, c[2].z}, 0};
}

void store(const std::array<glm::vec3, 3>& c, std::uint32_t primitive, std::size_t lane, Triangle4& out) {
    out.v0_x[lane] = c[0].x, out.v0_y[lane] = c[0].y, out.v0_z[lane] = c[0].z;
    out.v1_x[lane] = c[1].x, out.v1_y[lane] = c[1].y, out.v1_z[lane] = c[1].z;
    out.v2_x[lane] = c[2].x, out.v2_y[lane] = c[2].y, out.v2_z[lane] = c[2].z;
    out.primitive[lane] = primitive;
}

/// Appends the tree of one mesh to the image and returns its root.
std::uint32_t add_bottom(TreeImage& image, std::vector<std::array<glm::vec3, 3>> triangles, Shape shape) {
    std::vector<Box> boxes(triangles.size());
    Corners corners;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        const Aabb box = box_of(a, b, c);
        boxes[i] = {{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}};
        corners.of.emplace_back(triangles[i].begin(), triangles[i].end());
        corners.slack = std::max(corners.slack, hit_slack * longest_extent(a, b, c));
        if (is_collinear(triangles[i])) triangles[i] = {a, a, a};
    }
    const BinaryTree tree = make_binary(boxes, shape);
    const bool oriented = image.bounds != Bounds::aabb;
    std::size_t root = 0;
    std::uint32_t depth = 0;
    if (image.layout == Layout::binary) {
        root = oriented ? image.oriented_nodes.size() : image.binary_nodes.size();
        Emitter emitter(tree, 1, corners, [&](const std::vector<std::uint32_t>& leaf) {
            store(triangles[leaf[0]], leaf[0], image.triangles.emplace_back());
            return static_cast<std::uint32_t>(image.triangles.size() - 1);
        });
        depth = oriented ? emitter.emit(image.oriented_nodes) : emitter.emit(image.binary_nodes);
    } else {
        root = image.wide_nodes.size();
        Emitter emitter(tree, 4, corners, [&](std::vector<std::uint32_t> leaf) {
            std::sort(leaf.begin(), leaf.end());
            Triangle4 made{};
            std::fill(std::begin(made.primitive), std::end(made.primitive), BOXWOOD_NONE);
            for (std::size_t lane = 0; lane < leaf.size(); ++lane) store(triangles[leaf[lane]], leaf[lane], lane, made);
            image.blocks.push_back(made);
            return static_cast<std::uint32_t>(image.blocks.size() - 1);
        });
        depth = emitter.emit(image.wide_nodes);
    }
    image.bottom_depth = std::max(image.bottom_depth, depth);
    return static_cast<std::uint32_t>(root);
}

glm::dvec3 transform(const glm::mat4& matrix, const glm::vec3& p) {
    return glm::dvec3(glm::dmat4(matrix) * glm::dvec4(p, 1.0));
}

/// Room for all roundings of a ray that is moved to object space, on any axis: 64 of what terms there are, for points
/// within 8 radii of the sphere's center.
double slack_of(const InstanceRecord& record, const SceneSphere& sphere) {
    glm::dvec3 object, world;
    for (int row = 0; row < 3; ++row) {
        object[row] = 0.0;
        for (int k = 0; k < 3; ++k)
            object[row] +=
                std::fabs(double{record.to_object[4 * row + k]}) *
                (std::fabs(double{sphere.center[k]} - record.to_world[4 * k + 3]) + 8.0 * double{sphere.radius});
    }
    for (int row = 0; row < 3; ++row) {
        world[row] = 0.0;
        for (int k = 0; k < 3; ++k) world[row] += std::fabs(double{record.to_world[4 * row + k]}) * object[k];
    }
    return 0x1p-18 * std::max({world.x, world.y, world.z});
}

void add_top(TreeImage& image, const Scene& scene, Shape shape) {
    std::vector<Box> boxes;
    Corners corners;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        Box& box = boxes.emplace_back();
        auto& points = corners.of.emplace_back();
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions) {
            points.push_back(transform(instance.transform, p));
            box.add(glm::vec3(points.back()));
        }
        // The box itself rounds by half a unit in the last place.
        const glm::vec3 reach = glm::max(glm::abs(box.low), glm::abs(box.high));
        const double slack =
            slack_of(image.instances[i], image.sphere) + 0x1p-23 * std::max({reach.x, reach.y, reach.z});
        box.low -= static_cast<float>(slack);
        box.high += static_cast<float>(slack);
        corners.slack = std::max(corners.slack, slack);
    }
    const BinaryTree tree = make_binary(boxes, shape);
    Emitter emitter(tree, 1, corners, [](const std::vector<std::uint32_t>& leaf) { return leaf[0]; });
    image.top_depth = image.bounds != Bounds::aabb     ? emitter.emit(image.oriented_top)
                      : image.layout == Layout::binary ? emitter.emit(image.binary_top)
                                                       : emitter.emit(image.wide_top);
}

} // namespace

std::vector<std::array<glm::vec3, 3>> corners(const Mesh& mesh) {
    std::vector<std::array<glm::vec3, 3>> triangles;
    for (const glm::uvec3& t : mesh.triangles)
        triangles.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
    return triangles;
}

std::vector<std::array<glm::vec3, 3>> world_corners(const Scene& scene, const Instance& instance) {
    auto triangles = corners(scene.meshes[instance.mesh]);
    if (instance.transform == glm::mat4(1.0f)) return triangles;
    for (auto& triangle : triangles)
        for (glm::vec3& p : triangle) p = glm::vec3(transform(instance.transform, p));
    return triangles;
}

std::vector<InstanceRecord> reference_records(const Scene& scene) {
    std::vector<InstanceRecord> records;
    for (const Instance& instance : scene.instances) {
        InstanceRecord record{};
        const glm::dmat4 to_world(instance.transform);
        const glm::dmat4 to_object = glm::inverse(to_world);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                record.to_world[4 * row + column] = static_cast<float>(to_world[column][row]);
                record.to_object[4 * row + column] = static_cast<float>(to_object[column][row]);
            }
        }
        record.mesh = instance.mesh;
        records.push_back(record);
    }
    return records;
}

TreeImage reference_tree(const Scene& scene, Layout layout, Levels levels, Bounds bounds, Shape shape) {
    TreeImage image;
    image.layout = layout;
    image.levels = levels;
    image.bounds = bounds;
    image.sphere = scene_sphere(scene);
    if (scene.instances.empty()) return image;
    if (levels == Levels::one) {
        std::vector<std::array<glm::vec3, 3>> all;
        std::vector<std::uint32_t> first;
        for (const Instance& instance : scene.instances) {
            const auto triangles = world_corners(scene, instance);
            first.push_back(static_cast<std::uint32_t>(all.size()));
            all.insert(all.end(), triangles.begin(), triangles.end());
        }
        first.push_back(static_cast<std::uint32_t>(all.size()));
        if (scene.instances.size() > 1) image.first_triangles = first;
        add_bottom(image, all, shape);
        return image;
    }
    std::vector<std::uint32_t> roots;
    for (const Mesh& mesh : scene.meshes) roots.push_back(add_bottom(image, corners(mesh), shape));
    image.instances = reference_records(scene);
    for (InstanceRecord& record : image.instances) record.root = roots[record.mesh];
    add_top(image, scene, shape);
    return image;
}

} // namespace boxwood::test
