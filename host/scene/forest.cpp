// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include "scene/procedural_kinds.hpp"
#include "scene/random.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

constexpr int tree_kinds = 3;

// Points on the unit circle, 4 * per_quadrant of them, through the rational parametrisation of a quarter.
std::vector<glm::dvec2> circle(std::uint32_t per_quadrant) {
    std::vector<glm::dvec2> points;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        for (std::uint32_t i = 0; i < per_quadrant; ++i) {
            const double t = static_cast<double>(i) / per_quadrant;
            glm::dvec2 point(1.0 - t * t, 2.0 * t);
            for (int turn = 0; turn < quadrant; ++turn) point = {-point.y, point.x};
            points.push_back(point / (1.0 + t * t));
        }
    }
    return points;
}

std::uint32_t add_ring(Mesh& mesh, const std::vector<glm::dvec2>& round, double radius, double y) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec2& point : round) mesh.positions.emplace_back(radius * point.x, y, -radius * point.y);
    return first;
}

void add_trunk(Mesh& mesh, const std::vector<glm::dvec2>& round, double radius, double height) {
    const std::uint32_t low = add_ring(mesh, round, radius, 0.0);
    const std::uint32_t high = add_ring(mesh, round, radius, height);
    const auto n = static_cast<std::uint32_t>(round.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        mesh.triangles.emplace_back(low + i, low + next, high + next);
        mesh.triangles.emplace_back(low + i, high + next, high + i);
    }
}

void add_cone(Mesh& mesh, const std::vector<glm::dvec2>& round, double radius, double bottom, double top) {
    const std::uint32_t ring = add_ring(mesh, round, radius, bottom);
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0.0, top, 0.0);
    mesh.positions.emplace_back(0.0, bottom, 0.0);
    const auto n = static_cast<std::uint32_t>(round.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        mesh.triangles.emplace_back(ring + i, ring + next, tip);
        mesh.triangles.emplace_back(ring + next, ring + i, tip + 1);
    }
}

// A trunk under one to three cones: 2 + 2 * cones triangles for every point of the circle.
Mesh make_tree(int cones, const std::vector<glm::dvec2>& round) {
    Mesh mesh{"tree " + std::to_string(cones), {}, {}};
    add_trunk(mesh, round, 0.0625, 0.375);
    for (int cone = 0; cone < cones; ++cone) {
        const double bottom = 0.25 + 0.3125 * cone;
        add_cone(mesh, round, 0.375 - 0.0625 * cone, bottom, bottom + 0.625);
    }
    return mesh;
}

Mesh make_ground(float half) {
    return {"ground",
            {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}},
            {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}};
}

// Cosine and sine of a uniform angle: the square of a uniform point of the unit disc, as a complex number, normalised.
glm::vec2 random_turn(Random& random) {
    for (;;) {
        const float a = random.uniform(-1.0f, 1.0f);
        const float b = random.uniform(-1.0f, 1.0f);
        const float square = a * a + b * b;
        if (square > 0.0f && square <= 1.0f) return glm::vec2(a * a - b * b, 2.0f * a * b) / square;
    }
}

// A tree within its cell of the plantation, turned and scaled.
Instance place_tree(Random& random, glm::vec2 cell) {
    Instance tree;
    tree.mesh = static_cast<std::uint32_t>(1 + random.below(tree_kinds));
    const float width = random.uniform(0.625f, 1.25f);
    const float height = random.uniform(0.625f, 1.5f);
    const glm::vec2 turn = random_turn(random);
    const float x = cell.x + random.uniform();
    const float z = cell.y + random.uniform();
    tree.transform[0] = width * glm::vec4(turn.x, 0, -turn.y, 0);
    tree.transform[1] = glm::vec4(0, height, 0, 0);
    tree.transform[2] = width * glm::vec4(turn.y, 0, turn.x, 0);
    tree.transform[3] = glm::vec4(x, 0, z, 1);
    return tree;
}

// Soil, bark, and leaves of a green of its own for each kind of tree.
void add_materials(Scene& scene, std::size_t round) {
    constexpr glm::vec3 greens[tree_kinds] = {{0.21f, 0.36f, 0.08f}, {0.1f, 0.27f, 0.07f}, {0.05f, 0.17f, 0.09f}};
    paint(scene, scene.meshes[0], "soil", {0.31f, 0.25f, 0.16f});
    Mesh bark;
    paint(scene, bark, "bark", {0.23f, 0.14f, 0.08f});
    for (std::size_t kind = 0; kind < tree_kinds; ++kind) {
        Mesh& tree = scene.meshes[1 + kind];
        paint(scene, tree, "leaves", greens[kind]);
        std::fill_n(tree.materials.begin(), 2 * round, 1u); // the trunk's triangles come first
    }
}

} // namespace

Scene make_forest(const ProceduralOptions& options) {
    const std::uint64_t trees = (options.instances != 0 ? options.instances : 1'001) - 1;
    const std::uint64_t quarters =
        options.triangles != 0 ? (std::max<std::uint64_t>(2, options.triangles) - 2) / 72 : 2;
    const auto round = circle(static_cast<std::uint32_t>(std::max<std::uint64_t>(1, quarters)));
    std::uint64_t rows = floor_sqrt(trees);
    if (rows * rows < trees) ++rows;
    const float half = 0.5f * static_cast<float>(std::max<std::uint64_t>(1, rows));

    Scene scene;
    scene.meshes.push_back(make_ground(half));
    for (int kind = 1; kind <= tree_kinds; ++kind) scene.meshes.push_back(make_tree(kind, round));
    add_materials(scene, round.size());
    scene.instances.reserve(trees + 1);
    scene.instances.push_back({"ground", 0, glm::mat4(1.0f)});
    Random random(options.seed);
    for (std::uint64_t i = 0; i < trees; ++i) {
        const glm::vec2 cell(static_cast<float>(i % rows), static_cast<float>(i / rows));
        scene.instances.push_back(place_tree(random, cell - half));
    }
    scene.cameras.push_back({"camera", look_at({0.0, 2.0 + 0.25 * half, 1.5 * half + 2.0}, {0.0, 0.0, 0.0})});
    return scene;
}

} // namespace boxwood
