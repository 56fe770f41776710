// SPDX-License-Identifier: MIT
#include "boxwood/raster.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>

#include "boxwood/error.hpp"
#include "boxwood/radix_sort.hpp"
#include "boxwood/scan.hpp"
#include "build/pipeline.hpp"
#include "runtime/launch.hpp"
#include "shared/raster.h"

namespace boxwood {

namespace {

// Placed triangles that are on the way at once, and pairs of a tile and a triangle: about 100 MB of scratch.
constexpr std::uint32_t batch_triangles = 1u << 18;
constexpr std::uint64_t batch_pairs = 1u << 22;

std::vector<std::uint32_t> placed_before(const Scene& scene) {
    std::vector<std::uint32_t> before{0};
    std::uint64_t placed = 0;
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - 1;
    for (const Instance& instance : scene.instances) {
        placed += scene.meshes[instance.mesh].triangles.size();
        if (placed > most) throw CapacityError("placed triangles to rasterise", scene.instanced_triangle_count(), most);
        before.push_back(static_cast<std::uint32_t>(placed));
    }
    return before;
}

/// A picture's rows from that of the first pixel on, in tiles.
struct Tiles {
    std::uint32_t first_pixel, pixels, count;

    Tiles(std::uint32_t width, std::uint32_t first, std::uint32_t pixel_count)
        : first_pixel(first), pixels(pixel_count) {
        const std::uint32_t rows = (first + (pixel_count - 1)) / width - first / width + 1;
        count = ((width - 1) / BOXWOOD_TILE + 1) * ((rows - 1) / BOXWOOD_TILE + 1);
    }
};

/// Scratch of one batch, taken before the first.
struct Batch {
    Buffer<ScreenTriangle> triangles;
    Buffer<std::uint64_t> offsets;
    Buffer<std::uint32_t> keys, values;

    Batch(Device& device, std::uint32_t placed, const Tiles& tiles)
        : triangles(make_scratch<ScreenTriangle>(device, std::min(placed, batch_triangles), "triangles on the screen")),
          offsets(make_scratch<std::uint64_t>(device, triangles.size() + 1, "tiles of triangles")) {
        // A triangle may be in every tile.
        const std::uint64_t pairs =
            std::max<std::uint64_t>(tiles.count, std::min(batch_pairs, std::uint64_t{tiles.count} * triangles.size()));
        keys = make_scratch<std::uint32_t>(device, pairs, "tiles of pairs");
        values = make_scratch<std::uint32_t>(device, pairs, "triangles of pairs");
    }
};

} // namespace

Rasteriser::Rasteriser(Device& device, const Scene& scene, const Tree& tree, const Geometry& geometry)
    : device_(device), geometry_(geometry), sphere_(tree.arrays().sphere),
      instances_(static_cast<std::uint32_t>(scene.instances.size())) {
    const std::vector<std::uint32_t> before = placed_before(scene);
    placed_ = before.back();
    first_placed_ = upload(device, before, "placed triangles");
    flattened_ = tree.levels() == Levels::one;
    if (flattened_ && placed_ != 0 && !is_flat(scene)) flat_ = upload(device, flatten(scene));
}

void Rasteriser::draw(BufferView<const CameraRecord> camera, std::uint32_t width, std::uint32_t height,
                      std::uint32_t first_pixel, BufferView<const Ray> rays, BufferView<Hit> hits) const {
    const std::uint64_t pixels = std::uint64_t{width} * height;
    if (rays.size() != hits.size() || first_pixel + rays.size() > pixels || camera.size() != 1 ||
        pixels > std::numeric_limits<std::uint32_t>::max())
        throw InputError("raster", "rays",
                         std::to_string(rays.size()) + " from pixel " + std::to_string(first_pixel) + " on, for " +
                             std::to_string(hits.size()) + " hits in " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels of " + std::to_string(camera.size()) + " cameras");
    if (rays.size() == 0) return;
    const Stage stage(device_, "raster");
    const Tiles tiles(width, first_pixel, static_cast<std::uint32_t>(rays.size()));
    Batch batch(device_, std::max(placed_, 1u), tiles);
    const Slices clear = cut(device_, hits.size());
    const Defines defines{{"FLATTENED", flattened_ ? "1" : "0"}};
    const Defines drawing{{"FLATTENED", flattened_ ? "1" : "0"}, {"PORTABLE_LANES", "0"}};
    launch(device_, {"render/raster.cl", "clear_hits", drawing}, "clear hits", clear.slices, tiles.pixels, clear.length,
           hits);
    const Geometry& geometry = flat_.positions.size() != 0 ? flat_ : geometry_;
    std::uint32_t most = static_cast<std::uint32_t>(batch.triangles.size());
    for (std::uint32_t done = 0; done < placed_;) {
        const std::uint32_t count = std::min(most, placed_ - done);
        const Slices slices = cut(device_, count);
        launch(device_, {"render/raster_setup.cl", "setup_triangles", defines}, "set up triangles", slices.slices,
               geometry.positions, geometry.triangles, geometry.meshes, geometry.instances, first_placed_, instances_,
               camera, first_pixel, tiles.pixels, done, count, slices.length, batch.triangles, batch.offsets);
        const BufferView<std::uint64_t> offsets = batch.offsets.prefix(count + std::size_t{1});
        exclusive_scan(device_, offsets, Operator::sum, offsets);
        const std::uint64_t pairs = download_element(device_, batch.offsets, count);
        if (pairs > batch.keys.size()) {
            most = count / 2; // one triangle always fits
            continue;
        }
        done += count;
        if (pairs == 0) continue;
        const BufferView<std::uint32_t> keys = batch.keys.prefix(pairs), values = batch.values.prefix(pairs);
        launch(device_, {"render/raster_setup.cl", "list_tiles", defines}, "list tiles", slices.slices, camera,
               first_pixel, tiles.pixels, batch.triangles, batch.offsets, count, slices.length, keys, values);
        radix_sort(device_, keys, values, 0, std::bit_width(tiles.count - 1));
        launch(device_, {"render/raster.cl", "draw_tiles", drawing}, "draw tiles", tiles.count, camera,
               geometry.instances, batch.triangles, keys, values, static_cast<std::uint32_t>(pairs), tiles.count,
               first_pixel, rays, tiles.pixels, sphere_, hits);
    }
}

} // namespace boxwood
