// SPDX-License-Identifier: MIT
// boxwood-peers SCENE: Boxwood beside Embree 3. Same triangles, same rays, one process, alternating runs, medians.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/trace.hpp"
#include "common/median.hpp"
#include "embree_peer.hpp"
#include "io/atomic_file.hpp"
#include "workload.hpp"

namespace boxwood::peers {
namespace {

using Json = nlohmann::json;

struct Report {
    Json ratios = Json::object(), ours = Json::object(), embree = Json::object();

    void add(const std::string& key, double our_rate, double their_rate, const char* unit) {
        ratios[key] = our_rate / their_rate;
        ours[key] = our_rate;
        embree[key] = their_rate;
        std::printf("%-26s %6.2fx   ours %8.2f   Embree %8.2f %s\n", key.c_str(), our_rate / their_rate, our_rate,
                    their_rate, unit);
    }
};

/// Lets the threads of one side go to sleep before the other is timed: both pools spin for a while after their work.
void settle() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

/// A builder of ours and Embree's that makes trees of about the same quality.
struct Match {
    Builder builder;
    RTCBuildQuality quality;
    const char* suffix; ///< Of the names in the report.
    bool robust = false;
};
std::vector<Match> matches_of(bool robust) {
    std::vector<Match> matches{{Builder::lbvh, RTC_BUILD_QUALITY_LOW, ""},
                               {Builder::sah, RTC_BUILD_QUALITY_MEDIUM, "_sah"}};
    if (robust) {
        matches.push_back({Builder::lbvh, RTC_BUILD_QUALITY_LOW, "_robust", true});
        matches.push_back({Builder::sah, RTC_BUILD_QUALITY_MEDIUM, "_sah_robust", true});
    }
    return matches;
}

BuildOptions options_of(const Match& match) {
    return {.levels = Levels::one, .layout = Layout::wide8, .builder = match.builder};
}

/// Builds by both, alternating, each from triangles that it already holds, by wall clock on both sides. `ready` is up
/// to a tree that can be traversed; the build alone is without what the device takes to collapse it, but with all
/// waits, which keep ours from looking faster than it is. The tree that is left in `peer` is that of the match.
void measure_builds(Device& device, const Scene& flat, EmbreePeer& peer, const Match& match, int runs, Report& report) {
    std::vector<double> theirs, to_volumes, ready;
    BuildReport built;
    const auto build_ours = [&] { build(device, flat, options_of(match), &built); };
    build_ours(); // compiles
    peer.build(flat.meshes[0], match.quality, match.robust);
    for (int run = 0; run < runs; ++run) {
        settle();
        theirs.push_back(peer.build(flat.meshes[0], match.quality, match.robust));
        settle();
        build_ours();
        ready.push_back(built.total_ms - built.upload_ms);
        to_volumes.push_back(ready.back() - built.profile.stage_ms("collapse"));
    }
    const double kilo_triangles = static_cast<double>(flat.triangle_count()) * 1e-3; // per ms: millions per second
    const auto rate = [&](const std::vector<double>& ms) { return kilo_triangles / median(ms); };
    const bool low = match.quality == RTC_BUILD_QUALITY_LOW;
    report.add(std::string(low ? "build_low" : "build_medium") + (match.robust ? "_robust" : ""), rate(to_volumes),
               rate(theirs), "Mtri/s");
    report.add(std::string("ready") + match.suffix, rate(ready), rate(theirs), "Mtri/s");
    std::printf("SAH cost %.2f\n", built.sah);
}

/// Prints how many answers agree; a hit agrees when the distances do to 1e-4, or the triangles do.
void compare(const std::string& name, const std::vector<Hit>& ours, const std::vector<Hit>& theirs) {
    std::size_t same = 0, hits = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const bool both = ours[i].primitive != BOXWOOD_NONE && theirs[i].primitive != BOXWOOD_NONE;
        const bool near = both && std::fabs(ours[i].t - theirs[i].t) <= 1e-4f * theirs[i].t;
        same += ours[i].primitive == theirs[i].primitive || near;
        hits += ours[i].primitive != BOXWOOD_NONE;
    }
    std::printf("%s: %zu rays, %zu hits, %zu agree with Embree\n", name.c_str(), ours.size(), hits, same);
}

void measure_batch(Device& device, const Tree& tree, const EmbreePeer& peer, const Batch& batch,
                   const std::string& suffix, int runs, Report& report) {
    const std::size_t count = batch.rays.size();
    if (count == 0) return;
    const Buffer<Ray> rays = upload(device, batch.rays, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, count, "hits");
    Buffer<std::uint32_t> flags = make_buffer<std::uint32_t>(device, count, "flags");
    std::vector<Hit> their_hits(count);
    std::vector<std::uint32_t> their_flags(count);
    std::vector<double> times[6]; // theirs, ours, ours portable: closest, then any
    for (int run = -1; run < runs; ++run) {
        double ms[6];
        settle();
        ms[0] = peer.closest_hit(batch.rays, their_hits);
        ms[3] = peer.any_hit(batch.rays, their_flags);
        settle();
        for (const int portable : {0, 1}) {
            const TraceOptions options{.portable_lanes = portable == 1};
            ms[1 + portable] = milliseconds([&] { closest_hit(device, tree, rays, hits, options), device.finish(); });
            ms[4 + portable] = milliseconds([&] { any_hit(device, tree, rays, flags, options), device.finish(); });
        }
        if (run < 0) continue; // compiles and warms
        for (int i = 0; i < 6; ++i) times[i].push_back(ms[i]);
    }
    const auto rate = [&](int i) { return static_cast<double>(count) * 1e-3 / median(times[i]); };
    compare(batch.name, download(device, hits), their_hits);
    if (batch.name != "shadow") {
        report.add("closest_" + batch.name + suffix, rate(1), rate(0), "Mray/s");
        report.add("closest_" + batch.name + "_portable" + suffix, rate(2), rate(0), "Mray/s");
    }
    report.add("any_" + batch.name + suffix, rate(4), rate(3), "Mray/s");
    report.add("any_" + batch.name + "_portable" + suffix, rate(5), rate(3), "Mray/s");
}

int run(int argc, char** argv) {
    CLI::App app{"Boxwood beside Embree 3 on one scene"};
    std::string name, file, selector;
    int runs = 5;
    app.add_option("scene", name, "glTF file or procedural kind")->required();
    app.add_option("--report", file, "JSON file to write");
    app.add_option("--runs", runs, "timed runs of each side")->check(CLI::Range(1, 1000));
    bool robust = false;
    app.add_flag("--robust", robust, "also beside Embree's robust mode, which is watertight at edges as Boxwood is");
    app.add_option("--device", selector, "OpenCL device, by index or name");
    CLI11_PARSE(app, argc, argv);

    Device device(selector);
    const Scene flat = load_flat(name);
    if (flat.instances.empty()) throw InputError(name, "scene", "has no triangles to measure");
    std::printf("%s: %llu triangles, %s\n", name.c_str(), static_cast<unsigned long long>(flat.triangle_count()),
                device.info().name.c_str());
    EmbreePeer peer;
    Report report;
    for (const Match& match : matches_of(robust)) {
        std::printf("\n%s against Embree's %s tree%s\n", std::string(boxwood::name(match.builder)).c_str(),
                    match.quality == RTC_BUILD_QUALITY_LOW ? "LOW" : "MEDIUM", match.robust ? ", robust" : "");
        measure_builds(device, flat, peer, match, runs, report);
        const Tree tree = build(device, flat, options_of(match));
        for (const Batch& batch : make_batches(device, flat, tree))
            measure_batch(device, tree, peer, batch, match.suffix, runs, report);
    }

    if (file.empty()) return 0;
    const Json json{{"scene", name},       {"triangles", flat.triangle_count()},
                    {"runs", runs},        {"ratios", report.ratios},
                    {"ours", report.ours}, {"embree", report.embree}};
    AtomicFile out(file);
    out.stream() << json.dump(2) << '\n';
    out.commit();
    return 0;
}

} // namespace
} // namespace boxwood::peers

int main(int argc, char** argv) {
    try {
        return boxwood::peers::run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "boxwood-peers: " << error.what() << '\n';
        return 1;
    }
}
