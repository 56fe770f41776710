// SPDX-License-Identifier: MIT
// Pieces of the JSON text that the glTF writer puts together.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace boxwood {

/// The shortest decimal that reads back as the same float, also through a reader that goes by way of double.
inline void append_number(std::string& text, float value) {
    if (value == 0.0f) { // "-0" would be read as an integer, which has no negative zero
        text += std::signbit(value) ? "-0.0" : "0";
        return;
    }
    std::array<char, 32> digits{};
    char* end = std::to_chars(digits.begin(), digits.end(), value).ptr;
    double read = 0.0;
    std::from_chars(digits.begin(), end, read);
    if (static_cast<float>(read) != value) {
        end = std::to_chars(digits.begin(), digits.end(), static_cast<double>(value)).ptr;
    }
    text.append(digits.data(), end);
}

inline std::string quoted(const std::string& name) {
    return nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// One element after another of a JSON array, with the commas between them.
class Array {
public:
    Array(std::string& text, const char* key) : text_(text) { text_ += std::string(",\"") + key + "\":["; }
    std::string& next() {
        if (!std::exchange(first_, false)) text_ += ',';
        return text_;
    }
    void end() { text_ += ']'; }

private:
    std::string& text_;
    bool first_ = true;
};

/// [x,y,...]
template <class Vector>
void append_vector(std::string& text, const Vector& value) {
    for (int axis = 0; axis < Vector::length(); ++axis) {
        text += axis == 0 ? '[' : ',';
        append_number(text, value[axis]);
    }
    text += ']';
}

} // namespace boxwood
