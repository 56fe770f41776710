// SPDX-License-Identifier: MIT
#include "render/checkpoint.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "boxwood/error.hpp"
#include "io/bxw_format.hpp"
#include "layout/tree_arrays.hpp"
#include "render/environment.hpp"

namespace boxwood {

namespace {

/// A byte that is not ASCII, the name, and line ends that a text-mode copy would change.
constexpr std::array<char, 8> magic = {'\x89', 'B', 'X', 'R', '\r', '\n', '\x1a', '\n'};
/// Of this format, and of what a sample is: a change of either makes another.
constexpr std::uint32_t version = 3;

/// What the file begins with; the film's floats follow. Little-endian.
struct Header {
    std::array<char, 8> magic;
    std::uint32_t version;
    std::uint32_t samples;
    std::uint64_t fingerprint;
    std::uint64_t floats;
    std::uint64_t checksum; ///< XXH64 of the header with this field zero, followed by the floats.
};
static_assert(sizeof(Header) == 40 && std::endian::native == std::endian::little);

std::uint64_t checksum(Header header, std::span<const std::byte> floats) {
    header.checksum = 0;
    detail::bxw::Checksum sum;
    sum.add(&header, sizeof header);
    sum.add(floats.data(), floats.size());
    return sum.value();
}

template <class T>
void add_value(detail::bxw::Checksum& sum, const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    sum.add(&value, sizeof value);
}

void add_text(detail::bxw::Checksum& sum, std::string_view text) {
    add_value(sum, text.size());
    sum.add(text.data(), text.size());
}

template <class T>
void add_array(detail::bxw::Checksum& sum, const std::vector<T>& array) {
    add_value(sum, array.size());
    sum.add(array.data(), array.size() * sizeof(T));
}

template <class T>
void add_array(detail::bxw::Checksum& sum, Device& device, const Buffer<T>& array) {
    if (array.size() == 0)
        add_value(sum, std::size_t{0});
    else
        add_array(sum, download(device, array));
}

void add_world(detail::bxw::Checksum& sum, Device& device, const World& world) {
    const Geometry& geometry = world.geometry;
    const Appearance& appearance = world.appearance;
    add_array(sum, device, geometry.positions);
    add_array(sum, device, geometry.triangles);
    add_array(sum, device, geometry.meshes);
    add_array(sum, device, geometry.instances);
    add_array(sum, device, appearance.attributes);
    add_array(sum, device, appearance.triangle_materials);
    add_array(sum, device, appearance.materials);
    add_array(sum, device, appearance.textures);
    add_array(sum, device, appearance.texels);
    add_array(sum, device, appearance.lights);
    add_array(sum, device, appearance.light_nodes);
    add_value(sum, static_cast<std::uint32_t>(world.environment.kind));
    add_array(sum, device, world.environment.record);
    add_array(sum, device, world.environment.texels);
}

/// What the cost of a ray depends on: kinds, counts and nodes.
void add_tree(detail::bxw::Checksum& sum, Device& device, const Tree& tree) {
    for (const std::uint32_t kind :
         {static_cast<std::uint32_t>(tree.layout()), static_cast<std::uint32_t>(tree.levels()),
          static_cast<std::uint32_t>(tree.bounds())})
        add_value(sum, kind);
    visit_layout(tree.arrays(), [&](const auto& bottom, const auto& top) {
        add_array(sum, device, bottom.nodes);
        add_array(sum, device, top.nodes);
    });
}

void add_camera(detail::bxw::Checksum& sum, const Camera& camera) {
    sum.add(&camera.to_world, sizeof camera.to_world);
    add_value(sum, std::uint32_t{camera.perspective});
    add_value(sum, camera.vertical_fov);
    add_value(sum, camera.half_height);
}

void add_options(detail::bxw::Checksum& sum, const RenderOptions& options) {
    const LightOptions& light = options.light;
    for (const std::string_view word :
         {name(light.integrator), name(light.primary), name(light.sampler), name(light.strategy),
          name(light.hemisphere), name(light.filter), name(light.trace.intersector)})
        add_text(sum, word);
    for (const std::uint32_t number : {light.samples, light.depth, options.width, options.height})
        add_value(sum, number);
    add_value(sum, light.seed);
    add_value(sum, options.ao_distance);
}

} // namespace

std::uint64_t render_fingerprint(Device& device, const World& world, const Camera& camera,
                                 const RenderOptions& options) {
    detail::bxw::Checksum sum;
    const DeviceInfo& info = device.info();
    for (const std::string_view text : {std::string_view(BOXWOOD_VERSION), std::string_view(info.platform),
                                        std::string_view(info.name), std::string_view(info.driver)})
        add_text(sum, text);
    add_world(sum, device, world);
    if (options.light.integrator == Integrator::cost) add_tree(sum, device, world.tree);
    add_camera(sum, camera);
    add_options(sum, options);
    return sum.value();
}

std::vector<std::byte> encode_checkpoint(const Checkpoint& checkpoint, std::uint64_t fingerprint) {
    Header header{magic, version, checkpoint.samples, fingerprint, checkpoint.film.size(), 0};
    const auto floats = std::as_bytes(std::span(checkpoint.film));
    header.checksum = checksum(header, floats);
    std::vector<std::byte> bytes(sizeof header + floats.size());
    std::memcpy(bytes.data(), &header, sizeof header);
    if (!floats.empty()) std::memcpy(bytes.data() + sizeof header, floats.data(), floats.size());
    return bytes;
}

Checkpoint decode_checkpoint(std::span<const std::byte> bytes, std::uint64_t fingerprint, std::size_t floats,
                             std::uint32_t most_samples, std::string_view file) {
    const auto fail = [&](const std::string& what) -> InputError { return {std::string(file), "", what}; };
    Header header;
    if (bytes.size() < sizeof header) throw fail("is no checkpoint of a render: too short");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != magic) throw fail("is no checkpoint of a render");
    if (header.version != version)
        throw fail("is a checkpoint of version " + std::to_string(header.version) + ", not " + std::to_string(version) +
                   ": begin anew");
    const auto rest = bytes.subspan(sizeof header);
    if (rest.size() / sizeof(float) != header.floats || rest.size() % sizeof(float) != 0)
        throw fail("is cut off or has bytes behind its end: begin anew");
    if (checksum(header, rest) != header.checksum) throw fail("is damaged (its checksum differs): begin anew");
    if (header.fingerprint != fingerprint || header.floats != floats || header.samples > most_samples)
        throw fail("is of another render: scene, camera, options of light (and the tree, for cost), resolution, device "
                   "and version of Boxwood must be "
                   "those it was begun with");
    Checkpoint checkpoint{header.samples, std::vector<float>(floats)};
    if (floats > 0) std::memcpy(checkpoint.film.data(), rest.data(), rest.size());
    return checkpoint;
}

} // namespace boxwood
