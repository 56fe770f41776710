// SPDX-License-Identifier: MIT
// boxwood-benchmark-watertight: rays from inside of closed meshes, none of which may get out, through every kind of
// tree, all of which must give the same hits; of slivers, grazing rays and random bits those of brute force. Runs for
// as many rays as asked, and fails on one miss or one difference.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/trace.hpp"
#include "oracles/brute_force.hpp"
#include "oracles/closed_meshes.hpp"
#include "oracles/extreme_rays.hpp"
#include "support.hpp"

namespace boxwood {

std::uint64_t test::test_seed() { return 20260101; } // the oracles ask for it

namespace benchmarks {
namespace {

using test::ClosedScene;

/// One way to build a tree.
struct Kind {
    Builder builder;
    Layout layout;
    Bounds bounds;
};

/// An area for `blend`: rays along an axis through all of the scene, or all that areas may reach.
std::vector<InfluenceArea> areas_of(const Scene& scene) {
    const SceneSphere sphere = scene_sphere(scene);
    InfluenceArea area;
    const double reach = std::min(double{sphere.radius}, 0.25 * double{largest_coordinate});
    area.origin = {sphere.center[0], sphere.center[1], sphere.center[2] - reach};
    area.direction = {0.0, 0.0, 1.0};
    area.half_width = area.half_height = reach;
    area.far = 2.0 * reach;
    return {area};
}

std::vector<Kind> kinds_of(Levels levels) {
    std::vector<Kind> kinds;
    for (const Layout layout : {Layout::wide8, Layout::binary})
        for (const Builder builder : {Builder::lbvh, Builder::sah, Builder::midpoint, Builder::blend})
            if (levels == Levels::one || builder != Builder::blend) kinds.push_back({builder, layout, Bounds::aabb});
    for (const Bounds bounds : all_bounds())
        if (bounds != Bounds::aabb) kinds.push_back({Builder::lbvh, Layout::binary, bounds});
    return kinds;
}

Tree build_kind(Device& device, const Scene& scene, const Kind& kind, Levels levels) {
    BuildOptions options{.levels = levels, .layout = kind.layout, .builder = kind.builder};
    options.bounds.kind = kind.bounds;
    if (kind.builder == Builder::blend) options.areas = areas_of(scene);
    return build(device, scene, options);
}

struct Count {
    std::uint64_t rays = 0, missed = 0, different = 0;
};

bool same(const Hit& a, const Hit& b) {
    return a.t == b.t && a.u == b.u && a.v == b.v && a.primitive == b.primitive && a.instance == b.instance;
}

void check_batch(Device& device, const std::vector<Tree>& trees, const std::vector<Ray>& batch, Count& count) {
    const Buffer<Ray> rays = upload(device, batch, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, batch.size(), "hits");
    Buffer<std::uint32_t> flags = make_buffer<std::uint32_t>(device, batch.size(), "flags");
    std::vector<Hit> first;
    for (const Tree& tree : trees) {
        closest_hit(device, tree, rays, hits);
        const std::vector<Hit> found = download(device, hits);
        if (first.empty()) first = found;
        for (std::size_t i = 0; i < found.size(); ++i) {
            count.missed += found[i].primitive == BOXWOOD_NONE;
            count.different += !same(found[i], first[i]);
        }
        count.rays += batch.size();
    }
    any_hit(device, trees.front(), rays, flags);
    for (const std::uint32_t flag : download(device, flags)) count.missed += flag == 0;
    count.rays += batch.size();
}

/// All kinds of rays through all kinds of trees of one scene, `rays` in all or a few more.
Count check_scene(Device& device, const ClosedScene& closed, Levels levels, double rays, std::uint64_t seed) {
    Count count;
    std::vector<Tree> trees;
    for (const Kind& kind : kinds_of(levels)) trees.push_back(build_kind(device, closed.scene, kind, levels));
    const double each = rays / static_cast<double>((trees.size() + 1) * test::all_aims.size());
    constexpr double most = 1 << 20;
    for (const test::Aim aim : test::all_aims)
        for (double done = 0; done < each; done += most) {
            const auto size = static_cast<std::size_t>(std::min(most, std::max(each - done, 1.0)));
            check_batch(device, trees, test::rays_from_inside(closed, aim, size, ++seed), count);
        }
    return count;
}

/// Slivers, grazing rays and random bits: what brute force says is asked of every tree.
Count check_extremes(Device& device, const test::ExtremeRays& made, Levels levels) {
    const std::vector<Hit> expected = test::BruteForce(made.scene, levels).closest_hits(made.rays);
    const Buffer<Ray> rays = upload(device, made.rays, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, made.rays.size(), "hits");
    Count count;
    for (const Kind& kind : kinds_of(levels)) {
        closest_hit(device, build_kind(device, made.scene, kind, levels), rays, hits);
        const std::vector<Hit> found = download(device, hits);
        for (std::size_t i = 0; i < found.size(); ++i) count.different += !same(found[i], expected[i]);
        count.rays += found.size();
    }
    return count;
}

/// The scenes of check_extremes with `rays` in all.
std::vector<test::ExtremeRays> extremes(double rays, std::uint64_t seed) {
    const double kinds = 4.0 * static_cast<double>(kinds_of(Levels::one).size() + kinds_of(Levels::two).size());
    const auto each = static_cast<std::size_t>(std::max(rays / kinds, 1.0));
    return {test::sliver_rays(1.0f, 200, each, seed), test::sliver_rays(1e3f, 200, each, seed),
            test::sliver_rays(1e6f, 200, each, seed), test::random_bit_rays(500, each, seed)};
}

void print(const std::string& scene, Levels levels, const Count& count, Count& all) {
    std::printf("%-52s %6s %14llu %8llu %10llu\n", scene.c_str(), std::string(name(levels)).c_str(),
                static_cast<unsigned long long>(count.rays), static_cast<unsigned long long>(count.missed),
                static_cast<unsigned long long>(count.different));
    std::fflush(stdout);
    all.rays += count.rays;
    all.missed += count.missed;
    all.different += count.different;
}

int run(int argc, char** argv) {
    CLI::App app{"Counts rays that get out of closed meshes, and trees that disagree"};
    std::string selector;
    double rays = 1e7;
    std::uint64_t seed = 1;
    app.add_option("--device", selector, "index of a device or a part of its name");
    app.add_option("--rays", rays, "rays in all, about")->check(CLI::Range(1.0, 1e15));
    app.add_option("--seed", seed, "of all random numbers");
    CLI11_PARSE(app, argc, argv);

    Device device(selector);
    std::printf("device: %s\n%-52s %6s %14s %8s %10s\n", device.info().name.c_str(), "", "levels", "rays", "missed",
                "different");
    Count all;
    const std::vector<test::ClosedKind> scenes = test::closed_kinds();
    for (const test::ClosedKind& kind : scenes) {
        const ClosedScene closed = test::make_closed(kind);
        for (const Levels levels : {Levels::one, Levels::two})
            print(kind.name, levels,
                  check_scene(device, closed, levels, 0.9 * rays / static_cast<double>(2 * scenes.size()), seed), all);
    }
    for (const test::ExtremeRays& made : extremes(0.1 * rays, seed))
        for (const Levels levels : {Levels::one, Levels::two})
            print(made.name, levels, check_extremes(device, made, levels), all);
    std::printf("%llu rays: %llu missed, %llu different\n", static_cast<unsigned long long>(all.rays),
                static_cast<unsigned long long>(all.missed), static_cast<unsigned long long>(all.different));
    return all.missed + all.different == 0 ? 0 : 1;
}

} // namespace
} // namespace benchmarks
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-watertight",
                                        [&] { return boxwood::benchmarks::run(argc, argv); });
}
