// SPDX-License-Identifier: MIT
// Checks of the JSON type and range of fields, one object at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "io/gltf_document.hpp"

namespace boxwood {

/// One JSON object and the way its fields are checked. `Path` makes the element's name, and only when it is needed.
template <class Path>
class Fields {
public:
    Fields(const nlohmann::json& object, const std::string& file, Path path)
        : object_(object), file_(file), path_(path) {
        if (!object.is_object()) throw InputError(file, path_(), "is not a JSON object");
    }

    std::string path() const { return path_(); }
    std::string member(const char* key) const { return path_().empty() ? key : path_() + "." + key; }

    [[noreturn]] void fail(const char* key, const char* what) const { throw InputError(file_, member(key), what); }

    const nlohmann::json* find(const char* key, bool required = false) const {
        const auto found = object_.find(key);
        if (found != object_.end()) return &*found;
        if (required) fail(key, "is missing");
        return nullptr;
    }

    void integer(const char* key, std::uint64_t largest, bool required = false) const {
        const nlohmann::json* value = find(key, required);
        if (value == nullptr) return;
        if (!value->is_number_unsigned() || value->get<std::uint64_t>() > largest) {
            fail(key, "is not an integer in the range that is possible here");
        }
    }
    void index(const char* key, bool required = false) const {
        integer(key, std::numeric_limits<std::int32_t>::max(), required);
    }
    void size(const char* key, bool required = false) const { integer(key, std::uint64_t{1} << 53, required); }

    void indices(const char* key) const {
        const nlohmann::json* list = find(key);
        if (list == nullptr) return;
        if (!list->is_array()) fail(key, "is not an array");
        for (const nlohmann::json& value : *list) check_index(value, key);
    }

    /// An object whose members are all indices.
    void index_map(const char* key, bool required = false) const {
        const nlohmann::json* map = find(key, required);
        if (map != nullptr) check_index_map(*map, key);
    }

    void check_index_map(const nlohmann::json& map, const char* key) const {
        if (!map.is_object()) fail(key, "is not a JSON object");
        for (const nlohmann::json& value : map) check_index(value, key);
    }

    void one_of(const char* key, std::initializer_list<nlohmann::json> values) const {
        const nlohmann::json* value = find(key, true);
        if (std::find(values.begin(), values.end(), *value) == values.end())
            fail(key, "is not a value that glTF knows");
    }

    void string(const char* key, bool required = false) const {
        const nlohmann::json* value = find(key, required);
        if (value != nullptr && !value->is_string()) fail(key, "is not a string");
    }

    void boolean(const char* key) const {
        const nlohmann::json* value = find(key);
        if (value != nullptr && !value->is_boolean()) fail(key, "is not true or false");
    }

    void number(const char* key, bool required = false) const {
        const nlohmann::json* value = find(key, required);
        if (value != nullptr && !value->is_number()) fail(key, "is not a number");
    }

    void numbers(const char* key, std::size_t count) const {
        const nlohmann::json* list = find(key);
        if (list == nullptr) return;
        const bool right =
            list->is_array() && list->size() == count &&
            std::all_of(list->begin(), list->end(), [](const nlohmann::json& value) { return value.is_number(); });
        if (!right) fail(key, "does not have the right number of numbers");
    }

    /// Fields of the object under `key`, or of an empty object when there is none.
    auto object(const char* key, bool required = false) const {
        static const nlohmann::json empty = nlohmann::json::object();
        const nlohmann::json* value = find(key, required);
        const auto path = [this, key] { return member(key); };
        return Fields<decltype(path)>(value != nullptr ? *value : empty, file_, path);
    }

private:
    void check_index(const nlohmann::json& value, const char* key) const {
        const bool right =
            value.is_number_unsigned() &&
            value.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
        if (!right) fail(key, "holds something that is not an index");
    }

    const nlohmann::json& object_;
    const std::string& file_;
    Path path_;
};

/// Calls check(value, fields) for every element of the array under `key` of `parent`.
template <class Path, class Check>
void for_each(const nlohmann::json& parent, const char* key, const std::string& file, Path path, Check check) {
    const auto found = parent.find(key);
    if (found == parent.end()) return;
    if (!found->is_array()) throw InputError(file, path() + key, "is not an array");
    for (std::size_t i = 0; i < found->size(); ++i) {
        check((*found)[i], Fields((*found)[i], file, [&path, key, i] { return element(path() + key, i); }));
    }
}

} // namespace boxwood
