// SPDX-License-Identifier: MIT
// The textures of the materials in use, as shading reads them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/buffer.hpp"
#include "boxwood/scene.hpp"
#include "scene/picture.hpp"
#include "shared/material.h"

namespace boxwood {

/// The most texels of all textures of a scene; those of 16 bits count twice.
inline constexpr std::uint64_t most_texels = std::uint64_t{1} << 28;

/// Plans first, so that capacity is known before anything is decoded. A picture that several textures show is there
/// once, twice when some input reads it as colour and another as numbers.
class TextureSet {
public:
    /// Of the materials marked in `used`. Pictures that cannot be read, or do not fit any more, are replaced by one
    /// grey texel, with a line in `warnings`.
    TextureSet(const Scene& scene, const std::vector<bool>& used, std::vector<std::string>& warnings);

    /// Words of all texels.
    std::uint64_t word_count() const { return word_count_; }
    const std::vector<TextureRecord>& records() const { return records_; }

    /// Decodes into `texels`, of word_count() elements. What fails is replaced as above.
    void decode(Device& device, BufferView<std::uint32_t> texels, std::vector<std::string>& warnings);

    /// What an input of a material reads, after decode(). Of a normal texture that is replaced: none.
    TextureInput input(const TextureUse& use, std::size_t place) const;

    /// Mean of an emission texture, after decode(); (1, 1, 1) where there is none.
    glm::dvec3 mean(const TextureUse& use) const;

private:
    /// A picture as one kind of input reads it.
    struct Source {
        std::uint32_t image;
        bool srgb;
        std::uint64_t first_word;
        bool replaced = true;
        PictureSize size{1, 1};
        bool wide = false;
        glm::dvec3 mean{0.0};

        std::uint64_t words() const;
        void replace();
    };

    void add(std::uint32_t texture, bool srgb, std::vector<std::string>& warnings);
    std::size_t add_source(std::uint32_t image, bool srgb, std::vector<std::string>& warnings);
    void set_record(std::size_t record);

    const Scene& scene_;
    std::vector<Source> sources_;
    std::vector<TextureRecord> records_;
    std::vector<std::size_t> source_of_record_;
    std::map<std::pair<std::uint32_t, bool>, std::size_t> sources_by_image_;
    std::map<std::pair<std::uint32_t, bool>, std::uint32_t> records_by_texture_;
    std::uint64_t word_count_ = 0;
};

} // namespace boxwood
