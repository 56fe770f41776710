// SPDX-License-Identifier: MIT
#include "boxwood/gbuffer.hpp"

#include <cmath>
#include <string>

#include "boxwood/error.hpp"
#include "render/scene_arrays.hpp"

namespace boxwood {

namespace {

/// The bits of PLANES (cl/render/gbuffer.cl). Throws unless every plane is empty or holds `pixels` pixels.
class PlaneSet {
public:
    explicit PlaneSet(std::size_t pixels) : pixels_(pixels) {}

    template <class T>
    void add(const char* name, const BufferView<T>& plane, std::size_t components) {
        if (plane.size() != 0) {
            if (plane.size() != components * pixels_)
                throw InputError("g_buffer", name,
                                 std::to_string(plane.size()) + " elements for " + std::to_string(pixels_) +
                                     " pixels of " + std::to_string(components));
            bits_ |= next_;
        }
        next_ <<= 1;
    }
    unsigned bits() const { return bits_; }

private:
    std::size_t pixels_;
    unsigned bits_ = 0, next_ = 1;
};

unsigned planes_in(const GBuffer& planes, std::size_t pixels) {
    PlaneSet set(pixels);
    set.add("positions", planes.positions, 3);
    set.add("geometric_normals", planes.geometric_normals, 3);
    set.add("shading_normals", planes.shading_normals, 3);
    set.add("albedos", planes.albedos, 3);
    set.add("depths", planes.depths, 1);
    set.add("uv_derivatives", planes.uv_derivatives, 4);
    set.add("materials", planes.materials, 1);
    set.add("instances", planes.instances, 1);
    set.add("primitives", planes.primitives, 1);
    return set.bits();
}

} // namespace

void g_buffer(Device& device, const Geometry& geometry, const Appearance& appearance,
              BufferView<const CameraRecord> camera, BufferView<const Ray> rays, BufferView<const Hit> hits,
              TextureFilter filter, std::uint32_t samples, const GBuffer& planes) {
    if (rays.size() != hits.size())
        throw InputError("g_buffer", "rays",
                         std::to_string(rays.size()) + " elements for " + std::to_string(hits.size()) + " hits");
    const std::size_t materials = appearance.triangle_materials.size();
    if (materials != 0 && materials != geometry.triangle_count())
        throw InputError("g_buffer", "appearance",
                         "is of " + std::to_string(materials) + " triangles, the geometry of " +
                             std::to_string(geometry.triangle_count()));
    if (camera.size() != 1 || samples == 0) throw InputError("g_buffer", "camera", "needs one record and a sample");
    const unsigned bits = planes_in(planes, hits.size());
    if (bits == 0) return;
    Defines defines = scene_defines(device, geometry, appearance.requirements, filter);
    defines["PLANES"] = std::to_string(bits);
    const Slices slices = cut(device, hits.size());
    const float fraction = 1.0f / std::sqrt(static_cast<float>(samples));
    launch_shading(device, {"render/gbuffer.cl", "g_buffer", defines}, "g-buffer", slices.slices, geometry, appearance,
                   camera, rays, hits, static_cast<std::uint32_t>(hits.size()), slices.length, fraction,
                   planes.positions, planes.geometric_normals, planes.shading_normals, planes.albedos, planes.depths,
                   planes.uv_derivatives, planes.materials, planes.instances, planes.primitives);
}

} // namespace boxwood
