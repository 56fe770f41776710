// SPDX-License-Identifier: MIT
#include "render/appearance_textures.hpp"

#include <algorithm>
#include <new>
#include <span>

#include "boxwood/error.hpp"
#include "render/texture_levels.hpp"
#include "scene/materials_in_use.hpp"

namespace boxwood {

namespace {

constexpr std::uint32_t grey_texel = 0xff808080u;
const glm::dvec3 grey_mean(0.21586); // of 128 / 255 in sRGB

bool is_color(std::size_t place) { return place == BOXWOOD_BASE_COLOR || place == BOXWOOD_EMISSION; }

std::uint32_t wrap_number(Wrap wrap) { return wrap == Wrap::repeat ? 0 : wrap == Wrap::mirror ? 1 : 2; }

/// "images[2] (wood.png): REASON; shown as grey", once for all uses of the image.
void warn(const Scene& scene, std::uint32_t image, const std::string& reason, std::vector<std::string>& warnings) {
    const std::string line =
        "images[" + std::to_string(image) + "] (" + scene.images[image].name + "): " + reason + "; shown as grey";
    if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) warnings.push_back(line);
}

/// What is wrong with an image, without its name.
std::string reason_of(const InputError& error) {
    const std::string text = error.what(), name = error.file + ": ";
    return text.starts_with(name) ? text.substr(name.size()) : text;
}

} // namespace

TextureSet::TextureSet(const Scene& scene, const std::vector<bool>& used, std::vector<std::string>& warnings)
    : scene_(scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!used[i]) continue;
        const auto uses = texture_uses(scene.materials[i]);
        for (std::size_t place = 0; place < uses.size(); ++place)
            if (uses[place]->used()) add(uses[place]->texture, is_color(place), warnings);
    }
}

void TextureSet::add(std::uint32_t texture, bool srgb, std::vector<std::string>& warnings) {
    const auto [known, added] =
        records_by_texture_.try_emplace({texture, srgb}, static_cast<std::uint32_t>(records_.size()));
    if (!added) return;
    const Texture& from = scene_.textures[texture];
    source_of_record_.push_back(add_source(from.image, srgb, warnings));
    TextureRecord record{};
    record.wrap_u = wrap_number(from.wrap_u);
    record.wrap_v = wrap_number(from.wrap_v);
    record.nearest = from.nearest ? 1u : 0u;
    records_.push_back(record);
    set_record(records_.size() - 1);
}

std::size_t TextureSet::add_source(std::uint32_t image, bool srgb, std::vector<std::string>& warnings) {
    const auto [known, added] = sources_by_image_.try_emplace({image, srgb}, sources_.size());
    if (!added) return known->second;
    Source source{image, srgb, word_count_};
    source.replace();
    try {
        Source whole = source;
        whole.size = picture_size(scene_.images[image]);
        whole.wide = is_wide(scene_.images[image]);
        whole.replaced = false;
        const std::uint64_t pixels = std::uint64_t{whole.size.width} * whole.size.height;
        // Each replaced picture behind this one has its texel, too.
        if (pixels > most_texels || word_count_ + whole.words() > most_texels)
            warn(scene_, image,
                 std::to_string(whole.size.width) + " x " + std::to_string(whole.size.height) +
                     (whole.wide ? " pixels of 16 bits" : " pixels") +
                     " are more than there is room for in all textures, 2^28 of 8 bits",
                 warnings);
        else
            source = whole;
    } catch (const InputError& error) {
        warn(scene_, image, reason_of(error), warnings);
    }
    word_count_ += source.words();
    sources_.push_back(source);
    return sources_.size() - 1;
}

std::uint64_t TextureSet::Source::words() const { return level_texels(size) * (wide ? 2 : 1); }

void TextureSet::Source::replace() {
    replaced = true;
    size = {1, 1};
    wide = false;
    mean = grey_mean;
}

void TextureSet::set_record(std::size_t index) {
    const Source& source = sources_[source_of_record_[index]];
    TextureRecord& record = records_[index];
    record.first_texel = static_cast<std::uint32_t>(source.first_word);
    record.format = (source.srgb ? BOXWOOD_SRGB : 0u) | (source.wide ? BOXWOOD_WIDE : 0u);
    record.width = source.size.width;
    record.height = source.size.height;
    record.levels = level_count(source.size);
}

void TextureSet::decode(Device& device, BufferView<std::uint32_t> texels, std::vector<std::string>& warnings) {
    for (Source& source : sources_) {
        std::vector<std::uint32_t> levels{grey_texel};
        const auto replace = [&](const std::string& reason) {
            warn(scene_, source.image, reason, warnings);
            source.replace();
        };
        try {
            if (!source.replaced) {
                const Picture picture = decode_picture(scene_.images[source.image]);
                source.mean = mean_color(picture, source.srgb);
                levels = texture_levels(picture, source.srgb);
            }
        } catch (const InputError& error) {
            replace(reason_of(error));
        } catch (const std::bad_alloc&) {
            replace("needs more memory than there is");
        }
        write(device, std::span<const std::uint32_t>(levels), texels, source.first_word);
    }
    for (std::size_t i = 0; i < records_.size(); ++i) set_record(i);
}

TextureInput TextureSet::input(const TextureUse& use, std::size_t place) const {
    TextureInput input{};
    input.texture = BOXWOOD_NONE;
    if (!use.used()) return input;
    const std::uint32_t record = records_by_texture_.at({use.texture, is_color(place)});
    if (place == BOXWOOD_NORMAL && sources_[source_of_record_[record]].replaced) return input;
    input.texture = record;
    input.uv_set = use.uv_set;
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 3; ++column) input.rows[3 * row + column] = use.transform[column][row];
    return input;
}

glm::dvec3 TextureSet::mean(const TextureUse& use) const {
    if (!use.used()) return glm::dvec3(1.0);
    return sources_[source_of_record_[records_by_texture_.at({use.texture, true})]].mean;
}

} // namespace boxwood
