// SPDX-License-Identifier: MIT
#include "io/gltf_export_materials.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "io/gltf_text.hpp"
#include "scene/picture.hpp"

namespace boxwood {

namespace {

/// A colour of components up to 1 and what it is to be multiplied with, exactly: a power of two.
struct Scaled {
    glm::vec3 color;
    float strength;
};

Scaled scaled(const glm::vec3& value) {
    const float largest = std::max({value.x, value.y, value.z});
    if (largest <= 1.0f) return {value, 1.0f};
    // The largest radiance is a power of two, and so is its strength then.
    int exponent = 0;
    const float fraction = std::frexp(largest, &exponent);
    const float strength = std::ldexp(1.0f, fraction == 0.5f ? exponent - 1 : exponent);
    return {value / strength, strength};
}

/// Members of a JSON object that differ from what glTF takes without them.
class Object {
public:
    std::string& member(const char* key) {
        text_ += std::string(text_.empty() ? "\"" : ",\"") + key + "\":";
        return text_;
    }
    void number(const char* key, float value, float otherwise) {
        if (value != otherwise) append_number(member(key), value);
    }
    template <class Vector>
    void vector(const char* key, const Vector& value, const Vector& otherwise) {
        if (value != otherwise) append_vector(member(key), value);
    }
    void raw(const char* key, const std::string& value) { member(key) += value; }
    void object(const char* key, const Object& value) {
        if (!value.text_.empty()) raw(key, value.text());
    }
    void name(const std::string& value) {
        if (!value.empty()) raw("name", quoted(value));
    }
    std::string text() const { return "{" + text_ + "}"; }

private:
    std::string text_;
};

class MaterialWriter {
public:
    explicit MaterialWriter(std::string& text) : text_(text) {}

    void append(const Scene& scene, const std::vector<std::size_t>& image_views) {
        append_list("materials", scene.materials, [this](const Material& m) { return material_text(m); });
        append_textures(scene.textures);
        std::size_t next = 0;
        append_list("images", scene.images, [&](const EncodedImage& image) {
            const bool png = picture_format(image.bytes) == PictureFormat::png;
            Object object;
            object.raw("bufferView", std::to_string(image_views[next++]));
            object.raw("mimeType", png ? "\"image/png\"" : "\"image/jpeg\"");
            object.name(image.name);
            return object.text();
        });
        append_lights(scene.lights);
        if (used_.empty()) return;
        Array list(text_, "extensionsUsed");
        for (const std::string& name : used_) list.next() += quoted(name);
        list.end();
    }

private:
    template <class T, class Text>
    void append_list(const char* key, const std::vector<T>& elements, Text element_text) {
        if (elements.empty()) return;
        Array list(text_, key);
        for (const T& element : elements) list.next() += element_text(element);
        list.end();
    }

    /// `own` are members of the kind of input.
    void add_use(Object& owner, const char* key, const TextureUse& use, Object own = {}) {
        if (!use.used()) return;
        own.raw("index", std::to_string(use.texture));
        if (use.uv_set != 0) own.raw("texCoord", std::to_string(use.uv_set));
        const glm::vec2 u(use.transform[0]), v(use.transform[1]), offset(use.transform[2]);
        Object transform;
        transform.vector("offset", offset, glm::vec2(0.0f));
        if (u.y == 0.0f && v.x == 0.0f) {
            transform.vector("scale", glm::vec2(u.x, v.y), glm::vec2(1.0f));
        } else { // as load_transform makes it of turn and scale; glTF has no shear
            const double turn = std::atan2(-double{u.y}, double{u.x});
            const double across = double{v.x} * std::sin(turn) + double{v.y} * std::cos(turn);
            transform.number("rotation", static_cast<float>(turn), 0.0f);
            transform.vector("scale", glm::vec2(glm::length(glm::dvec2(u)), across), glm::vec2(1.0f));
        }
        if (transform.text() != "{}") {
            Object extensions;
            extensions.object(note("KHR_texture_transform"), transform);
            own.object("extensions", extensions);
        }
        owner.object(key, own);
    }

    std::string material_text(const Material& material) {
        Object object, pbr, extensions, normal, occlusion;
        object.name(material.name);
        pbr.vector("baseColorFactor", material.base_color, glm::vec4(1.0f));
        pbr.number("metallicFactor", material.metallic, 1.0f);
        pbr.number("roughnessFactor", material.roughness, 1.0f);
        add_use(pbr, "baseColorTexture", material.base_color_texture);
        add_use(pbr, "metallicRoughnessTexture", material.metallic_roughness_texture);
        object.object("pbrMetallicRoughness", pbr);
        normal.number("scale", material.normal_scale, 1.0f);
        add_use(object, "normalTexture", material.normal_texture, normal);
        occlusion.number("strength", material.occlusion_strength, 1.0f);
        add_use(object, "occlusionTexture", material.occlusion_texture, occlusion);
        const Scaled emission = scaled(material.emission);
        object.vector("emissiveFactor", emission.color, glm::vec3(0.0f));
        add_use(object, "emissiveTexture", material.emission_texture);
        if (material.alpha_mode != AlphaMode::opaque)
            object.raw("alphaMode", material.alpha_mode == AlphaMode::mask ? "\"MASK\"" : "\"BLEND\"");
        if (material.alpha_mode == AlphaMode::mask) object.number("alphaCutoff", material.alpha_cutoff, 0.5f);
        if (material.double_sided) object.raw("doubleSided", "true");
        add_extension(extensions, "KHR_materials_emissive_strength", "emissiveStrength", emission.strength);
        add_extension(extensions, "KHR_materials_specular", "specularFactor", material.specular);
        if (material.unlit) extensions.raw(note("KHR_materials_unlit"), "{}");
        object.object("extensions", extensions);
        return object.text();
    }

    /// One of a single number, 1 without it.
    void add_extension(Object& extensions, const char* name, const char* key, float value) {
        if (value == 1.0f) return;
        Object object;
        object.number(key, value, 1.0f);
        extensions.object(note(name), object);
    }

    /// Every texture that does not simply repeat has a sampler of its own.
    void append_textures(const std::vector<Texture>& textures) {
        std::vector<std::string> samplers;
        append_list("textures", textures, [&](const Texture& texture) {
            Object object, sampler;
            object.raw("source", std::to_string(texture.image));
            const auto add_wrap = [&sampler](const char* key, Wrap wrap) {
                if (wrap != Wrap::repeat) sampler.raw(key, wrap == Wrap::mirror ? "33648" : "33071");
            };
            add_wrap("wrapS", texture.wrap_u);
            add_wrap("wrapT", texture.wrap_v);
            if (texture.nearest) sampler.raw("magFilter", "9728");
            if (sampler.text() != "{}") {
                object.raw("sampler", std::to_string(samplers.size()));
                samplers.push_back(sampler.text());
            }
            return object.text();
        });
        append_list("samplers", samplers, [](const std::string& sampler) { return sampler; });
    }

    void append_lights(const std::vector<Light>& lights) {
        if (lights.empty()) return;
        text_ += std::string(",\"extensions\":{\"") + note("KHR_lights_punctual") + "\":{\"lights\":[";
        for (std::size_t i = 0; i < lights.size(); ++i) text_ += (i > 0 ? "," : "") + light_text(lights[i]);
        text_ += "]}}";
    }

    static std::string light_text(const Light& light) {
        Object object, spot;
        const bool is_spot = light.kind == LightKind::spot;
        object.raw("type", light.kind == LightKind::point ? "\"point\"" : is_spot ? "\"spot\"" : "\"directional\"");
        const Scaled intensity = scaled(light.intensity);
        object.vector("color", intensity.color, glm::vec3(1.0f));
        object.number("intensity", intensity.strength, 1.0f);
        if (light.kind != LightKind::directional && std::isfinite(light.range))
            append_number(object.member("range"), light.range);
        if (is_spot) {
            append_number(spot.member("innerConeAngle"), light.inner_cone);
            append_number(spot.member("outerConeAngle"), light.outer_cone);
            object.object("spot", spot);
        }
        return object.text();
    }

    const char* note(const char* extension) {
        used_.insert(extension);
        return extension;
    }

    std::string& text_;
    std::set<std::string> used_;
};

} // namespace

void append_materials(std::string& text, const Scene& scene, const std::vector<std::size_t>& image_views) {
    MaterialWriter(text).append(scene, image_views);
}

glm::mat4 placement(const Light& light) {
    glm::mat4 matrix(1.0f);
    if (light.kind != LightKind::point) {
        const glm::vec3 back = -light.direction, size = glm::abs(back);
        // The axis that is farthest from it.
        const glm::vec3 other = size.x <= size.y && size.x <= size.z ? glm::vec3(1, 0, 0)
                                : size.y <= size.z                   ? glm::vec3(0, 1, 0)
                                                                     : glm::vec3(0, 0, 1);
        const glm::vec3 right = glm::normalize(glm::cross(other, back));
        matrix = {glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0), glm::vec4(back, 0), matrix[3]};
    }
    if (light.kind != LightKind::directional) matrix[3] = glm::vec4(light.position, 1.0f);
    return matrix;
}

} // namespace boxwood
