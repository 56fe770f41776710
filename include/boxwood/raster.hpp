// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/geometry.hpp"
#include "boxwood/tree.hpp"
#include "shared/camera.h"
#include "shared/ray.h"

namespace boxwood {

/// Rasterises a scene into the hits that primary rays have (dissertation 2.6): triangles are binned to tiles of pixels
/// by scan, scatter and sort, and a work-item draws a tile. Which pixels a triangle may have is decided by homogeneous
/// edge functions (Olano and Greer 1997), with room for their roundings, so that triangles through the plane of the eye
/// need no clipping; whether it has one, and what the pixel then holds, by traversal's own ray test, in the space that
/// traversal uses.
class Rasteriser {
public:
    /// `tree` is one of `scene`, a valid one (see validate), whose triangles `geometry` holds; all of one device. A
    /// tree of one level over placed meshes makes a copy of the scene flattened. References `geometry`. Throws
    /// CapacityError when the copy does not fit, or for 2^32 - 1 placed triangles and more.
    Rasteriser(Device& device, const Scene& scene, const Tree& tree, const Geometry& geometry);

    /// hits[i] = what closest_hit says about rays[i], the ray of pixel first_pixel + i of a picture of width x height
    /// pixels through `camera` (one record, whose jitter counts). From more than 8 radii of the scene away surfaces may
    /// be closer together than distances can tell; of those the lowest triangle is hit here, the nearest by
    /// closest_hit. The record must be of such a picture, and rays of it; no rays are nothing to do. Throws InputError
    /// for sizes that do not fit each other and pictures of 2^32 pixels and more, and CapacityError, before any work,
    /// when scratch memory does not suffice. O(placed triangles + pixels drawn).
    void draw(BufferView<const CameraRecord> camera, std::uint32_t width, std::uint32_t height,
              std::uint32_t first_pixel, BufferView<const Ray> rays, BufferView<Hit> hits) const;

private:
    Device& device_;
    const Geometry& geometry_;
    SceneSphere sphere_;
    Geometry flat_;                      ///< The scene flattened, for trees of one level.
    Buffer<std::uint32_t> first_placed_; ///< Per instance the placed triangles before it, then all.
    std::uint32_t placed_ = 0;
    std::uint32_t instances_ = 0;
    bool flattened_ = false;
};

} // namespace boxwood
