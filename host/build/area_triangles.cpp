// SPDX-License-Identifier: MIT
#include "build/area_triangles.hpp"

#include <vector>

#include "boxwood/compact.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

Buffer<std::uint32_t> area_triangles(Device& device, BufferView<const float> positions,
                                     BufferView<const std::uint32_t> triangles, const InfluenceRecord& area) {
    const std::size_t count = triangles.size() / 3;
    if (count == 0) return make_buffer<std::uint32_t>(device, 0, "triangles of an area");
    auto flags = make_scratch<std::uint32_t>(device, count, "triangles that are in an area");
    auto indices = make_scratch<std::uint32_t>(device, count, "numbers of triangles");
    auto found = make_scratch<std::uint32_t>(device, count, "triangles in an area");
    auto total = make_scratch<std::uint32_t>(device, 1, "number of triangles in an area");
    launch(device, {"build/area_triangles.cl", "area_triangles"}, "triangles of an area", count,
           upload(device, std::vector<InfluenceRecord>{area}, "influence area"), positions, triangles, flags, indices,
           static_cast<cl_uint>(count));
    compact(device, indices, flags, found, total);
    const std::uint32_t size = download_element(device, total, 0);
    Buffer<std::uint32_t> result = make_buffer<std::uint32_t>(device, size, "triangles of an area");
    copy(device, found.prefix(size), result);
    return result;
}

} // namespace boxwood
