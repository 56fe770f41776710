// SPDX-License-Identifier: MIT
#include <string>

#include "boxwood/error.hpp"
#include "boxwood/obb.hpp"
#include "boxwood/reduce.hpp"
#include "boxwood/segmented_reduce.hpp"
#include "primitives/element.hpp"
#include "runtime/launch.hpp"
#include "shared/aabb.h"

namespace boxwood {

namespace {

const char* const file = "bounds/fit_obb.cl";
const char* const turn_file = "bounds/turn_obb.cl";

/// Points or triangles in segments. `triangles` is not read for points, and is then any buffer.
struct Elements {
    BufferView<const float> positions;
    BufferView<const std::uint32_t> triangles;
    BufferView<const std::uint32_t> offsets;
    std::uint32_t count;
    Defines defines;
    std::uint32_t segments() const { return static_cast<std::uint32_t>(offsets.size() - 1); }
};

Buffer<Aabb> fit_aabbs(Device& device, const Elements& elements) {
    auto boxes = make_scratch<Aabb>(device, elements.count, "boxes of elements");
    const Slices slices = cut(device, elements.count);
    launch(device, {file, "element_boxes", elements.defines}, "boxes of elements", slices.slices, elements.positions,
           elements.triangles, boxes, elements.count, slices.length, slices.slices);
    auto aabbs = make_scratch<Aabb>(device, elements.segments(), "boxes of segments");
    segmented_reduce(device, boxes, elements.offsets, Operator::sum, aabbs);
    return aabbs;
}

Buffer<cl_float4> sum(Device& device, const Elements& elements, BufferView<const cl_float4> values) {
    auto sums = make_scratch<cl_float4>(device, elements.segments(), "moments of segments");
    segmented_reduce(device, values, elements.offsets, Operator::sum, sums);
    return sums;
}

/// The axes of `boxes`. Returns how many segments have axes that are hardly determined, flagged in `close`.
std::uint32_t fit_axes(Device& device, const Elements& elements, BufferView<const Aabb> aabbs, BufferView<Obb> boxes,
                       BufferView<std::uint32_t> close) {
    auto first = make_scratch<cl_float4>(device, elements.count, "first moments");
    const Slices slices = cut(device, elements.count);
    launch(device, {file, "first_moments", elements.defines}, "first moments", slices.slices, elements.positions,
           elements.triangles, elements.offsets, aabbs, detail::scalars_of(first.view()), elements.count,
           elements.segments(), slices.length, slices.slices);
    const auto means = sum(device, elements, first);
    auto rest = make_scratch<cl_float4>(device, elements.count, "second moments");
    launch(device, {file, "second_moments", elements.defines}, "second moments", slices.slices, elements.positions,
           elements.triangles, elements.offsets, aabbs, detail::scalars_of(means.view()),
           detail::scalars_of(first.view()), detail::scalars_of(rest.view()), elements.count, elements.segments(),
           slices.length, slices.slices);
    const auto first_sums = sum(device, elements, first), rest_sums = sum(device, elements, rest);
    const Slices over_segments = cut(device, elements.segments());
    launch(device, {file, "principal_axes", elements.defines}, "principal axes", over_segments.slices, elements.offsets,
           detail::scalars_of(first_sums.view()), detail::scalars_of(rest_sums.view()), boxes, close,
           elements.segments(), over_segments.length, over_segments.slices);
    auto number = make_scratch<std::uint32_t>(device, 1, "number of close fits");
    reduce(device, close, Operator::sum, number);
    return download_element(device, number, 0);
}

Buffer<Aabb> fit_slabs(Device& device, const Elements& elements, BufferView<const Aabb> aabbs,
                       BufferView<const Obb> axes) {
    auto ends = make_scratch<Aabb>(device, elements.count, "ends of elements");
    const Slices slices = cut(device, elements.count);
    launch(device, {file, "element_slabs", elements.defines}, "ends of elements", slices.slices, elements.positions,
           elements.triangles, elements.offsets, aabbs, axes, ends, elements.count, elements.segments(), slices.length,
           slices.slices);
    auto slabs = make_scratch<Aabb>(device, elements.segments(), "ends of segments");
    segmented_reduce(device, ends, elements.offsets, Operator::sum, slabs);
    return slabs;
}

/// Other axes for the segments flagged in `close`: those of a small box of their extreme vertices. The axes of `boxes`
/// for all others.
Buffer<Obb> turn_axes(Device& device, const Elements& elements, BufferView<const Aabb> aabbs,
                      BufferView<const std::uint32_t> close, BufferView<const Obb> boxes) {
    constexpr std::uint32_t passes = 7; // of two directions each, as in cl/bounds/turn_obb.cl
    auto keys = make_scratch<cl_ulong4>(device, elements.count, "keys of elements");
    auto extremes = make_scratch<cl_ulong4>(device, elements.segments(), "extreme elements");
    auto vertices =
        make_scratch<std::uint32_t>(device, std::size_t(4) * passes * elements.segments(), "extreme vertices");
    const Slices slices = cut(device, elements.count), over_segments = cut(device, elements.segments());
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
        launch(device, {turn_file, "extreme_keys", elements.defines}, "extreme vertices", slices.slices,
               elements.positions, elements.triangles, elements.offsets, aabbs, close, detail::scalars_of(keys.view()),
               pass, elements.count, elements.segments(), slices.length, slices.slices);
        segmented_reduce(device, keys, elements.offsets, Operator::max, extremes);
        launch(device, {turn_file, "take_extremes", elements.defines}, "extreme vertices: take", over_segments.slices,
               detail::scalars_of(extremes.view()), close, vertices, pass, elements.segments(), over_segments.length,
               over_segments.slices);
    }
    auto turned = make_scratch<Obb>(device, elements.segments(), "turned axes");
    launch(device, {turn_file, "turn_axes", elements.defines}, "turn axes", elements.segments(), elements.positions,
           aabbs, vertices, close, boxes, turned, elements.segments());
    return turned;
}

void fit(Device& device, const Elements& elements, BufferView<Obb> boxes) {
    if (elements.segments() == 0) return;
    const auto aabbs = fit_aabbs(device, elements);
    auto close = make_scratch<std::uint32_t>(device, elements.segments(), "close fits");
    const std::uint32_t number = fit_axes(device, elements, aabbs, boxes, close);
    const auto slabs = fit_slabs(device, elements, aabbs, boxes);
    const Slices slices = cut(device, elements.segments());
    const auto finish = [&](BufferView<const Aabb> turned_slabs, BufferView<const Obb> turned) {
        launch(device, {file, "finish_fits", elements.defines}, "finish fits", slices.slices, elements.offsets, aabbs,
               slabs, turned_slabs, turned, boxes, elements.segments(), slices.length, slices.slices);
    };
    if (number == 0) return finish(slabs, boxes);
    const auto turned = turn_axes(device, elements, aabbs, close, boxes);
    finish(fit_slabs(device, elements, aabbs, turned), turned);
}

Defines defines_of(int corners) {
    return {{"CORNERS", std::to_string(corners)}, {"LANES", "1"}, {"MEASURE_AREA", "1"}, {"FALLBACK", "0"}};
}

} // namespace

void fit_obbs(Device& device, BufferView<const float> positions, BufferView<const std::uint32_t> offsets,
              BufferView<Obb> boxes) {
    if (offsets.size() != boxes.size() + 1)
        throw InputError("arguments", "offsets", "needs one entry more than there are boxes");
    fit(device, {positions, offsets, offsets, static_cast<std::uint32_t>(positions.size() / 3), defines_of(1)}, boxes);
}

void fit_mesh_obbs(Device& device, const Geometry& geometry, BufferView<Obb> boxes) {
    if (boxes.size() != geometry.meshes.size()) throw InputError("arguments", "boxes", "needs one element per mesh");
    auto offsets = make_scratch<std::uint32_t>(device, boxes.size() + 1, "triangles of meshes");
    const auto count = static_cast<std::uint32_t>(geometry.triangle_count());
    launch(device, {"bounds/mesh_offsets.cl", "mesh_offsets"}, "triangles of meshes", boxes.size() + 1, geometry.meshes,
           offsets, count, static_cast<std::uint32_t>(boxes.size()));
    fit(device, {geometry.positions, geometry.triangles, offsets, count, defines_of(3)}, boxes);
}

} // namespace boxwood
