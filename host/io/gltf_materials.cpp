// SPDX-License-Identifier: MIT
#include "io/gltf_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"
#include "io/gltf_accessor.hpp"
#include "io/gltf_extensions.hpp"
#include "io/gltf_numbers.hpp"
#include "scene/picture.hpp"

namespace boxwood {

namespace {

using nlohmann::json;

constexpr Range share{0.0f, 1.0f};
constexpr Range any{-largest_coordinate, largest_coordinate};

/// Places in the scene of what the file has, by index in the file.
using Places = std::vector<std::optional<std::uint32_t>>;

class MaterialLoader {
public:
    MaterialLoader(const GltfDocument& document, Scene& scene, Warnings& warnings)
        : document_(document), appearance_(document.appearance), scene_(scene), warnings_(warnings) {}

    void load() {
        for (std::size_t i = 0; i < appearance_["images"].size(); ++i)
            images_.push_back(load_image(appearance_["images"][i], element("images", i)));
        for (std::size_t i = 0; i < appearance_["textures"].size(); ++i)
            textures_.push_back(load_texture(appearance_["textures"][i], element("textures", i)));
        for (std::size_t i = 0; i < appearance_["materials"].size(); ++i)
            scene_.materials.push_back(load_material(appearance_["materials"][i], element("materials", i)));
    }

private:
    /// Elements that name the same bytes share one image.
    std::optional<std::uint32_t> load_image(const json& from, const std::string& where) {
        const std::string source = from.contains("bufferView") ? "view " + std::to_string(from["bufferView"].get<int>())
                                                               : "uri " + from.value("uri", std::string());
        if (const auto known = sources_.find(source); known != sources_.end()) return known->second;
        return sources_[source] = read_image(from, where);
    }

    std::optional<std::uint32_t> read_image(const json& from, const std::string& where) {
        EncodedImage image;
        image.name = from.value("name", std::string());
        try {
            if (from.contains("bufferView")) {
                const auto bytes = view_bytes(document_, from["bufferView"].get<int>(), where + ".bufferView");
                image.bytes.assign(bytes.begin(), bytes.end());
            } else if (from.contains("uri")) {
                const auto& uri = from["uri"].get_ref<const std::string&>();
                image.bytes = load_uri(document_, uri, where + ".uri", warnings_);
                if (image.name.empty() && !is_data_uri(uri)) image.name = excerpt(uri);
            } else {
                document_.fail(where, "has neither a uri nor a bufferView");
            }
            if (!picture_format(image.bytes)) document_.fail(where, "is neither PNG nor JPEG");
        } catch (const InputError& error) {
            const std::string prefix = error.file + ": " + error.where + ": ";
            warnings_.add(error.where, std::string(error.what()).substr(prefix.size()) +
                                           "; left out with the textures that show it");
            return std::nullopt;
        }
        scene_.images.push_back(std::move(image));
        return static_cast<std::uint32_t>(scene_.images.size() - 1);
    }

    static Wrap wrap_of(const json& sampler, const char* key) {
        const int mode = sampler.value(key, TINYGLTF_TEXTURE_WRAP_REPEAT);
        if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
        return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
    }

    std::optional<std::uint32_t> load_texture(const json& from, const std::string& where) {
        Texture texture;
        if (from.contains("sampler")) {
            const auto index = from["sampler"].get<std::size_t>();
            if (index >= appearance_["samplers"].size())
                document_.fail(where + ".sampler", "names a sampler that does not exist");
            const json& sampler = appearance_["samplers"][index];
            texture.wrap_u = wrap_of(sampler, "wrapS");
            texture.wrap_v = wrap_of(sampler, "wrapT");
            texture.nearest = sampler.value("magFilter", 0) == TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        if (!from.contains("source")) {
            warnings_.add(where, "has no image that can be read, left out");
            return std::nullopt;
        }
        const auto source = from["source"].get<std::size_t>();
        if (source >= images_.size()) document_.fail(where + ".source", "names an image that does not exist");
        if (!images_[source]) return std::nullopt;
        texture.image = *images_[source];
        scene_.textures.push_back(texture);
        return static_cast<std::uint32_t>(scene_.textures.size() - 1);
    }

    /// The texture of an input; none when it was left out.
    TextureUse load_use(const json& owner, const char* key, const std::string& owner_name) {
        TextureUse use;
        if (!owner.contains(key)) return use;
        const json& info = owner[key];
        const std::string where = owner_name + "." + key;
        const auto index = info["index"].get<std::size_t>();
        if (index >= textures_.size()) document_.fail(where + ".index", "names a texture that does not exist");
        if (!textures_[index]) return use;
        const json& transform = object_at(object_at(info, "extensions"), "KHR_texture_transform");
        const auto set = transform.value("texCoord", info.value("texCoord", 0u));
        if (set > 1) {
            warnings_.add(where, "reads TEXCOORD_" + std::to_string(set) +
                                     "; there are two sets of texture coordinates, so that it is left out");
            return use;
        }
        use.texture = *textures_[index];
        use.uv_set = set;
        if (!transform.empty()) use.transform = load_transform(transform, where + ".extensions.KHR_texture_transform");
        return use;
    }

    /// Scale first, then the turn, then the offset. Coordinates turn counter-clockwise as one sees them with v growing
    /// downwards, as glTF's own viewer and three.js have it (the listing in older texts of the extension turns the
    /// other way).
    glm::mat3 load_transform(const json& from, const std::string& where) {
        const auto offset = vector_at(from, "offset", glm::vec2(0.0f), any, where, warnings_);
        const auto scale = vector_at(from, "scale", glm::vec2(1.0f), any, where, warnings_);
        const double turn = number_at(from, "rotation", 0.0f, any, where, warnings_);
        const double c = std::cos(turn), s = std::sin(turn);
        const glm::dmat3 rotation(c, -s, 0, s, c, 0, 0, 0, 1);
        const glm::dmat3 matrix = rotation * glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, 1);
        return {glm::vec3(matrix[0]), glm::vec3(matrix[1]), glm::vec3(offset, 1.0f)};
    }

    Material load_material(const json& from, const std::string& where) {
        Material material;
        material.name = from.value("name", std::string());
        const json& pbr = object_at(from, "pbrMetallicRoughness");
        const std::string inside = where + ".pbrMetallicRoughness";
        material.base_color = vector_at(pbr, "baseColorFactor", glm::vec4(1.0f), share, inside, warnings_);
        material.metallic = number_at(pbr, "metallicFactor", 1.0f, share, inside, warnings_);
        material.roughness = number_at(pbr, "roughnessFactor", 1.0f, share, inside, warnings_);
        material.base_color_texture = load_use(pbr, "baseColorTexture", inside);
        material.metallic_roughness_texture = load_use(pbr, "metallicRoughnessTexture", inside);
        material.normal_texture = load_use(from, "normalTexture", where);
        material.normal_scale =
            number_at(object_at(from, "normalTexture"), "scale", 1.0f, any, where + ".normalTexture", warnings_);
        material.occlusion_texture = load_use(from, "occlusionTexture", where);
        material.occlusion_strength = number_at(object_at(from, "occlusionTexture"), "strength", 1.0f, share,
                                                where + ".occlusionTexture", warnings_);
        material.emission_texture = load_use(from, "emissiveTexture", where);
        const std::string mode = from.value("alphaMode", std::string("OPAQUE"));
        material.alpha_mode = mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
        material.alpha_cutoff = number_at(from, "alphaCutoff", 0.5f, {0.0f, largest_coordinate}, where, warnings_);
        material.double_sided = from.value("doubleSided", false);
        if (!from.contains("pbrMetallicRoughness")) load_specular_glossiness(from, where, material);
        load_extensions(from, where, material);
        return material;
    }

    /// The diffuse part stands in for the whole: base colour of a surface that is no metal, and as rough as the
    /// default.
    void load_specular_glossiness(const json& from, const std::string& where, Material& material) {
        const json& extensions = object_at(from, "extensions");
        if (!extensions.contains(specular_glossiness)) return;
        const json& glossy = extensions[specular_glossiness];
        const std::string inside = where + ".extensions." + specular_glossiness;
        material.base_color = vector_at(glossy, "diffuseFactor", glm::vec4(1.0f), share, inside, warnings_);
        material.base_color_texture = load_use(glossy, "diffuseTexture", inside);
        material.metallic = 0.0f;
    }

    void load_extensions(const json& from, const std::string& where, Material& material) {
        const json& extensions = object_at(from, "extensions");
        const std::string inside = where + ".extensions.";
        material.unlit = extensions.contains("KHR_materials_unlit");
        material.specular = number_at(object_at(extensions, "KHR_materials_specular"), "specularFactor", 1.0f, share,
                                      inside + "KHR_materials_specular", warnings_);
        const glm::vec3 factor = vector_at(from, "emissiveFactor", glm::vec3(0.0f), share, where, warnings_);
        material.emission =
            factor * number_at(object_at(extensions, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0f,
                               {0.0f, largest_radiance}, inside + "KHR_materials_emissive_strength", warnings_);
    }

    const GltfDocument& document_;
    const json& appearance_;
    Scene& scene_;
    Warnings& warnings_;
    Places images_;
    Places textures_;
    std::map<std::string, std::optional<std::uint32_t>> sources_; ///< By what names its bytes: an image.
};

} // namespace

void load_materials(const GltfDocument& document, Scene& scene, Warnings& warnings) {
    MaterialLoader(document, scene, warnings).load();
}

} // namespace boxwood
