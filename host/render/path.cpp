// SPDX-License-Identifier: MIT
#include "render/path.hpp"

#include <string>
#include <utility>

#include "boxwood/error.hpp"
#include "boxwood/trace.hpp"
#include "primitives/scan.hpp"
#include "render/scene_arrays.hpp"
#include "shared/path.h"

namespace boxwood {

namespace {

/// Rays with what goes with each.
template <class Record>
struct Queue {
    Buffer<Ray> rays;
    Buffer<Record> records;

    Queue() = default;
    Queue(Device& device, std::size_t size)
        : rays(make_scratch<Ray>(device, size, "rays of paths")), records(make_scratch<Record>(device, size, "paths")) {
    }
};

const char* record_name(const Queue<PathState>&) { return "PathState"; }
const char* record_name(const Queue<ShadowLight>&) { return "ShadowLight"; }

/// The slices of a queue, how many records each keeps at its front, and where these belong.
struct Fronts {
    Slices slices;
    Buffer<std::uint32_t> kept, before; ///< One more than slices; the last of `before` is the sum.

    /// For queues of up to `size` records.
    Fronts(Device& device, std::size_t size)
        : kept(make_scratch<std::uint32_t>(device, most_slices(device, size) + 1, "kept paths")),
          before(make_scratch<std::uint32_t>(device, most_slices(device, size) + 1, "kept paths before")) {}
};

/// The programs of one world and its options.
struct Programs {
    bool next_event;
    KernelRef shade, alpha;

    Programs(const Device& device, const World& world, const LightOptions& options) {
        const ShadingRequirements& needs = world.appearance.requirements;
        const bool towards = options.strategy != Strategy::bsdf;
        const bool lights = world.appearance.lights.size() > 0 && (needs.punctual || towards);
        next_event = lights || (towards && world.environment.kind != EnvironmentKind::none);
        Defines defines = scene_defines(device, world.geometry, needs, options.filter);
        alpha = {"render/path_alpha.cl", "pass_shadows", defines};
        alpha.defines["LANES"] = "1";
        defines["ALPHA"] = flag(needs.alpha);
        defines["SPECULAR"] = flag(needs.specular);
        defines["EMISSION"] = flag(needs.emission);
        defines["LIGHTS"] = flag(lights);
        defines["ENVIRONMENT"] = std::to_string(static_cast<int>(world.environment.kind));
        defines["STRATEGY"] = std::to_string(static_cast<int>(options.strategy));
        defines["SAMPLER"] = std::to_string(2 - static_cast<int>(options.sampler));
        defines["UNIFORM_HEMISPHERE"] = flag(options.hemisphere == Hemisphere::uniform);
        shade = {"render/path.cl", "shade_paths", defines};
    }
};

/// One sample of a batch on its way.
class Batch {
public:
    Batch(Device& device, const World& world, const LightOptions& options, std::uint32_t sample,
          const PrimaryHits& primary, SampleLight light)
        : device_(device), world_(world), options_(options), sample_(sample), primary_(primary), light_(light),
          programs_(device, world, options), paths_(device, primary.rays.size()), moved_(device, primary.rays.size()),
          hits_(make_scratch<Hit>(device, primary.rays.size(), "hits of paths")), fronts_(device, primary.rays.size()) {
        if (!programs_.next_event) return;
        shadows_ = Queue<ShadowLight>(device, primary.rays.size());
        if (!world.appearance.requirements.alpha) {
            blocked_ = make_scratch<std::uint32_t>(device, primary.rays.size(), "blocked shadow rays");
            return;
        }
        moved_shadows_ = Queue<ShadowLight>(device, primary.rays.size());
        shadow_hits_ = make_scratch<Hit>(device, primary.rays.size(), "hits of shadow rays");
    }

    void run() {
        std::size_t count = primary_.rays.size();
        for (std::uint32_t round = 0; count > 0; ++round) {
            shade(count, round == 0);
            if (programs_.next_event) add_shadows(count, round);
            count = close_gaps(paths_, moved_, count);
            if (count == 0) return;
            const Stage stage(device_, "trace");
            closest_hit(device_, world_.tree, paths_.rays.prefix(count), hits_.prefix(count), options_.trace);
        }
    }

private:
    void shade(std::size_t count, bool first) {
        const Stage stage(device_, "shade");
        const Appearance& appearance = world_.appearance;
        const EnvironmentMap& environment = world_.environment;
        const bool compensated = options_.strategy == Strategy::mis;
        const BufferView<const Ray> rays = first ? primary_.rays : BufferView<const Ray>(paths_.rays);
        const BufferView<const Hit> hits = first ? primary_.hits : BufferView<const Hit>(hits_);
        fronts_.slices = cut(device_, count);
        launch_shading(
            device_, programs_.shade, "shade", fronts_.slices.slices, world_.geometry, appearance, appearance.lights,
            appearance.light_nodes, static_cast<std::uint32_t>(appearance.lights.size()), environment.record,
            environment.texels, compensated ? environment.rows_above_floor : environment.rows,
            compensated ? environment.columns_above_floor : environment.columns, primary_.camera, options_.seed,
            sample_, options_.samples, options_.depth, primary_.first_pixel, first ? 1u : 0u, rays, hits,
            static_cast<std::uint32_t>(count), fronts_.slices.length, fronts_.slices.slices, paths_.records,
            paths_.rays, shadows_.rays, shadows_.records, fronts_.kept, light_.direct, light_.indirect);
    }

    void add_shadows(std::size_t count, std::uint32_t round) {
        if (world_.appearance.requirements.alpha) return add_shadows_through(count, round);
        {
            const Stage stage(device_, "shadow");
            any_hit(device_, world_.tree, shadows_.rays.prefix(count), blocked_.prefix(count), options_.trace);
        }
        const Stage stage(device_, "accumulate");
        const Slices slices = cut(device_, count);
        launch(device_, {"render/path_queue.cl", "add_unblocked", {{"RECORD", "ShadowLight"}}}, "accumulate",
               slices.slices, blocked_, shadows_.records, static_cast<std::uint32_t>(count), slices.length,
               light_.direct, light_.indirect);
    }

    /// Surface by surface, with the paths' own slices set aside. It ends: rays pass each surface once.
    void add_shadows_through(std::size_t count, std::uint32_t round) {
        Fronts of_paths = std::exchange(fronts_, Fronts(device_, count));
        for (std::uint32_t layer = 0; count > 0; ++layer) {
            {
                const Stage stage(device_, "shadow");
                closest_hit(device_, world_.tree, shadows_.rays.prefix(count), shadow_hits_.prefix(count),
                            options_.trace);
            }
            {
                const Stage stage(device_, "accumulate");
                fronts_.slices = cut(device_, count);
                launch_shading(device_, programs_.alpha, "pass shadows", fronts_.slices.slices, world_.geometry,
                               world_.appearance, options_.seed, sample_, primary_.first_pixel, round, layer,
                               shadow_hits_, static_cast<std::uint32_t>(count), fronts_.slices.length,
                               fronts_.slices.slices, shadows_.rays, shadows_.records, fronts_.kept, light_.direct,
                               light_.indirect);
            }
            count = close_gaps(shadows_, moved_shadows_, count);
        }
        fronts_ = std::move(of_paths);
    }

    /// Moves what each slice kept together; returns how many there are. O(n).
    template <class Record>
    std::size_t close_gaps(Queue<Record>& queue, Queue<Record>& moved, std::size_t count) {
        const Stage stage(device_, "compact");
        const Slices slices = fronts_.slices;
        detail::exclusive_sums(device_, fronts_.kept.prefix(slices.slices + 1),
                               fronts_.before.prefix(slices.slices + 1), fronts_.kept.size());
        const std::size_t kept = download_element(device_, fronts_.before, slices.slices);
        if (kept == 0 || kept == count) return kept;
        launch(device_, {"render/path_queue.cl", "move_kept", {{"RECORD", record_name(queue)}}}, "move kept",
               slices.slices, queue.rays, queue.records, fronts_.before, fronts_.kept, slices.length, slices.slices,
               moved.rays, moved.records);
        std::swap(queue, moved);
        return kept;
    }

    Device& device_;
    const World& world_;
    const LightOptions& options_;
    std::uint32_t sample_;
    PrimaryHits primary_;
    SampleLight light_;
    Programs programs_;
    Queue<PathState> paths_, moved_;
    Buffer<Hit> hits_;
    Queue<ShadowLight> shadows_, moved_shadows_;
    Buffer<std::uint32_t> blocked_;
    Buffer<Hit> shadow_hits_;
    Fronts fronts_;
};

} // namespace

void trace_paths(Device& device, const World& world, const LightOptions& options, std::uint32_t sample,
                 const PrimaryHits& primary, SampleLight light) {
    const std::size_t pixels = primary.rays.size();
    if (primary.hits.size() != pixels || light.direct.size() != 3 * pixels || light.indirect.size() != 3 * pixels)
        throw InputError("trace_paths", "arrays",
                         std::to_string(pixels) + " rays, " + std::to_string(primary.hits.size()) + " hits, light of " +
                             std::to_string(light.direct.size()) + " and " + std::to_string(light.indirect.size()));
    constexpr std::size_t most = (std::size_t{1} << 30) - 1;
    if (pixels > most) throw CapacityError("pixels in one batch", pixels, most);
    if (pixels > 0) Batch(device, world, options, sample, primary, light).run();
}

} // namespace boxwood
