// SPDX-License-Identifier: MIT
// Values, texts and lists in a section: a list is a 64-bit count and then its elements, a text a list of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include <glm/glm.hpp>

#include "boxwood/error.hpp"

namespace boxwood::detail::bxw {

/// Appends values and lists to a section.
class Encoder {
public:
    template <class T>
    void put(const T& value) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> ||
                      std::is_same_v<T, glm::mat4> || std::is_same_v<T, glm::mat3> || std::is_same_v<T, glm::vec3> ||
                      std::is_same_v<T, glm::vec4>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void put_count(std::size_t count) { put(static_cast<std::uint64_t>(count)); }
    void put_text(std::string_view text) {
        put_count(text.size());
        bytes_.append(text);
    }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Reads them back; no count can make it take more memory than the section has.
class Decoder {
public:
    Decoder(std::span<const char> bytes, const char* section, const std::string& file)
        : rest_(bytes), section_(section), file_(file) {}

    template <class T>
    T get() {
        if (rest_.size() < sizeof(T)) fail("ends too early");
        T value;
        std::memcpy(&value, rest_.data(), sizeof value);
        rest_ = rest_.subspan(sizeof value);
        return value;
    }

    /// A list's count, refused when the rest of the section cannot hold that many elements of `least` bytes each.
    std::size_t get_count(std::size_t least) {
        const auto count = get<std::uint64_t>();
        if (count > rest_.size() / least) fail("counts more elements than it holds");
        return static_cast<std::size_t>(count);
    }

    /// An index below `count`, as a word.
    std::uint32_t get_word(std::uint32_t count, const char* fault) {
        const auto word = get<std::uint32_t>();
        if (word >= count) fail(fault);
        return word;
    }

    std::string get_text() {
        const std::size_t size = get_count(1);
        std::string text(rest_.data(), size);
        rest_ = rest_.subspan(size);
        return text;
    }

    void finish() const {
        if (!rest_.empty()) fail("has bytes behind its last element");
    }

    [[noreturn]] void fail(const char* what) const { throw InputError(file_, section_, what); }

private:
    std::span<const char> rest_;
    const char* section_;
    const std::string& file_;
};

/// Least bytes of a text.
inline constexpr std::size_t text_bytes = sizeof(std::uint64_t);

} // namespace boxwood::detail::bxw
