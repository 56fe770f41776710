// SPDX-License-Identifier: MIT
#include "render/aovs.hpp"

#include <algorithm>
#include <string>
#include <type_traits>

#include "boxwood/gbuffer.hpp"
#include "common/words.hpp"
#include "render/camera.hpp"
#include "runtime/launch.hpp"
#include "scene/materials_in_use.hpp"

namespace boxwood {

namespace {

constexpr Words<Aov, 14> aov_words = {{{"direct", Aov::direct},
                                       {"indirect", Aov::indirect},
                                       {"ambient", Aov::ambient},
                                       {"ao", Aov::ao},
                                       {"variance", Aov::variance},
                                       {"samples", Aov::samples},
                                       {"depth", Aov::depth},
                                       {"normal", Aov::normal},
                                       {"position", Aov::position},
                                       {"albedo", Aov::albedo},
                                       {"instance", Aov::instance},
                                       {"primitive", Aov::primitive},
                                       {"material", Aov::material},
                                       {"cost", Aov::cost}}};

bool asked(const std::vector<Aov>& aovs, Aov aov) { return std::find(aovs.begin(), aovs.end(), aov) != aovs.end(); }

/// Planes of a batch of pixels on the device, empty where they are not asked for.
struct Planes {
    Buffer<float> depths, normals, positions, albedos;
    Buffer<std::uint32_t> instances, primitives, materials, volumes, tested;

    Planes(Device& device, const std::vector<Aov>& aovs, std::uint32_t pixels) {
        const auto make = [&](Aov aov, std::size_t components, auto& plane) {
            using Plane = std::remove_reference_t<decltype(plane)>;
            if constexpr (std::is_same_v<Plane, Buffer<float>>) {
                if (asked(aovs, aov)) plane = make_scratch<float>(device, components * pixels, "AOV");
            } else {
                if (asked(aovs, aov)) plane = make_scratch<std::uint32_t>(device, components * pixels, "AOV");
            }
        };
        make(Aov::depth, 1, depths);
        make(Aov::normal, 3, normals);
        make(Aov::position, 3, positions);
        make(Aov::albedo, 3, albedos);
        make(Aov::instance, 1, instances);
        make(Aov::primitive, 1, primitives);
        make(Aov::material, 1, materials);
        make(Aov::cost, 1, volumes);
        make(Aov::cost, 1, tested);
    }

    GBuffer g_buffer(std::uint32_t pixels) {
        const auto first = [pixels](auto& plane, std::size_t components) {
            return plane.prefix(plane.size() == 0 ? 0 : components * pixels);
        };
        GBuffer planes;
        planes.positions = first(positions, 3);
        planes.shading_normals = first(normals, 3);
        planes.albedos = first(albedos, 3);
        planes.depths = first(depths, 1);
        planes.materials = first(materials, 1);
        planes.instances = first(instances, 1);
        planes.primitives = first(primitives, 1);
        return planes;
    }
};

/// Where the channel `name` of an image is, made with one sample per pixel when it is not there.
template <class T>
std::vector<T>& channel(Image& image, const std::string& name) {
    for (Channel& each : image.channels)
        if (each.name == name) return std::get<std::vector<T>>(each.samples);
    image.channels.push_back({name, std::vector<T>(std::size_t{image.width} * image.height)});
    return std::get<std::vector<T>>(image.channels.back().samples);
}

/// Copies a plane of `parts.size()` components per pixel to as many channels, from the pixel `first` on.
template <class T>
void store(Device& device, const Buffer<T>& plane, const std::string& layer, std::string_view parts,
           std::uint32_t first, std::uint32_t count, Image& image) {
    if (plane.size() == 0) return;
    const std::vector<T> values = download(device, plane.prefix(parts.size() * count));
    for (std::size_t c = 0; c < parts.size(); ++c) {
        std::vector<T>& target = channel<T>(image, layer + parts[c]);
        for (std::uint32_t i = 0; i < count; ++i) target[first + i] = values[parts.size() * i + c];
    }
}

template <class T>
void store(Device& device, const Buffer<T>& plane, const std::string& name, std::uint32_t first, std::uint32_t count,
           Image& image) {
    if (plane.size() == 0) return;
    const std::vector<T> values = download(device, plane.prefix(count));
    std::copy(values.begin(), values.end(), channel<T>(image, name).begin() + first);
}

/// In the order of the enumeration.
void store_all(Device& device, const Planes& planes, std::uint32_t first, std::uint32_t count, Image& image) {
    store(device, planes.depths, "depth.Z", first, count, image);
    store(device, planes.normals, "normal.", "XYZ", first, count, image);
    store(device, planes.positions, "position.", "XYZ", first, count, image);
    store(device, planes.albedos, "albedo.", "RGB", first, count, image);
    store(device, planes.instances, "instance.id", first, count, image);
    store(device, planes.primitives, "primitive.id", first, count, image);
    store(device, planes.materials, "material.id", first, count, image);
    store(device, planes.volumes, "cost.volumes", first, count, image);
    store(device, planes.tested, "cost.primitives", first, count, image);
}

/// Of the scene; an Appearance that needs one material has no other.
void number_material(const Scene& scene, const Appearance& appearance, Image& image) {
    if (appearance.requirements.materials) return;
    const std::vector<bool> used = materials_in_use(scene);
    const auto only = static_cast<std::uint32_t>(std::find(used.begin(), used.end(), true) - used.begin());
    for (std::uint32_t& id : channel<std::uint32_t>(image, "material.id"))
        if (id != BOXWOOD_NONE) id = std::min(only, static_cast<std::uint32_t>(scene.materials.size()));
}

} // namespace

std::string_view name(Aov aov) { return word_of(aov_words, aov); }

std::vector<Aov> all_aovs() {
    std::vector<Aov> all;
    for (const auto& entry : aov_words) all.push_back(entry.second);
    return all;
}

Aov to_aov(std::string_view word) { return value_of(aov_words, "aov", word); }

bool has(Integrator integrator, Aov aov) {
    const bool ambient = integrator == Integrator::ambient;
    switch (aov) {
    case Aov::direct:
    case Aov::indirect:
        return ambient || integrator == Integrator::path || integrator == Integrator::direct;
    case Aov::ambient:
        return ambient;
    case Aov::ao:
        return ambient || integrator == Integrator::ao;
    default:
        return true;
    }
}

std::uint32_t channel_count(Aov aov) {
    switch (aov) {
    case Aov::direct:
    case Aov::indirect:
    case Aov::ambient:
    case Aov::normal:
    case Aov::position:
    case Aov::albedo:
        return 3;
    case Aov::cost:
        return 2;
    default:
        return 1;
    }
}

bool is_light(Aov aov) { return aov < Aov::depth; }

std::vector<Aov> without_repetition(std::vector<Aov> aovs) {
    std::sort(aovs.begin(), aovs.end());
    aovs.erase(std::unique(aovs.begin(), aovs.end()), aovs.end());
    return aovs;
}

void add_centre_channels(Device& device, const Scene& scene, const World& world, const Camera& camera,
                         const RenderOptions& options, const std::vector<Aov>& aovs, Image& image) {
    if (std::all_of(aovs.begin(), aovs.end(), is_light)) return;
    const Stage stage(device, "channels");
    const Buffer<CameraRecord> record = upload_camera(device, camera, options.width, options.height);
    const std::uint32_t pixels = options.width * options.height, most = std::min(options.batch, pixels);
    Buffer<Ray> all_rays = make_scratch<Ray>(device, most, "rays");
    Buffer<Hit> all_hits = make_scratch<Hit>(device, most, "hits");
    Planes planes(device, aovs, most);
    for (std::uint32_t first = 0, count = 0; first < pixels; first += count) {
        count = std::min(most, pixels - first);
        const BufferView<Ray> rays = all_rays.prefix(count);
        const BufferView<Hit> hits = all_hits.prefix(count);
        primary_rays(device, record, first, rays);
        if (asked(aovs, Aov::cost)) {
            auto statistics = make_scratch<RayStatistics>(device, count, "ray statistics");
            closest_hit(device, world.tree, rays, hits, statistics, options.light.trace);
            const Slices slices = cut(device, count);
            launch(device, {"render/views.cl", "cost_planes"}, "AOV costs", slices.slices, statistics, count,
                   slices.length, planes.volumes, planes.tested);
        } else {
            closest_hit(device, world.tree, rays, hits, options.light.trace);
        }
        g_buffer(device, world.geometry, world.appearance, record, rays, hits, options.light.filter, 1,
                 planes.g_buffer(count));
        store_all(device, planes, first, count, image);
    }
    if (asked(aovs, Aov::material)) number_material(scene, world.appearance, image);
}

} // namespace boxwood
