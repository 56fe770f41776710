// SPDX-License-Identifier: MIT
// Checks of the JSON type and range of fields, one object at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_warnings.hpp"

namespace boxwood {

/// Where the checks of a file's fields say what they found.
struct FieldReport {
    const std::string& file; ///< For messages.
    Warnings& warnings;      ///< Of what was mended.
};

/// One JSON object, the way its fields are checked, and what exporters get wrong without harm put right: members that
/// are null or empty are taken out, as are references of -1. `Path` makes the element's name, and only when it is
/// needed.
template <class Path>
class Fields {
public:
    /// Without an object, every field is absent.
    Fields(nlohmann::json* object, const FieldReport& report, Path path)
        : object_(object), report_(report), path_(path) {
        if (object_ == nullptr) return;
        if (!object_->is_object()) throw InputError(report_.file, path_(), "is not a JSON object");
        for (auto member = object_->begin(); member != object_->end();) {
            const bool is_empty = member->empty() && (member->is_array() || member.key() == "extensions");
            if (!is_empty && !member->is_null()) {
                ++member;
                continue;
            }
            warn(member.key(), is_empty ? "is empty; taken as absent" : "is null; taken as absent");
            member = object_->erase(member);
        }
    }

    std::string path() const { return path_(); }
    std::string member(const std::string& key) const { return path_().empty() ? key : path_() + "." + key; }

    [[noreturn]] void fail(const char* key, const char* what) const {
        throw InputError(report_.file, member(key), what);
    }
    void warn(const std::string& key, const std::string& what) const {
        report_.warnings.add_repeated(member(excerpt(key)), what);
    }

    nlohmann::json* find(const char* key, bool required = false) const {
        if (object_ != nullptr)
            if (const auto found = object_->find(key); found != object_->end()) return &*found;
        if (required) fail(key, "is missing");
        return nullptr;
    }
    void erase(const char* key) const { object_->erase(key); }

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
    /// An index of something that need not be there: some exporters write -1 for none.
    void reference(const char* key) const {
        const nlohmann::json* value = find(key);
        if (value != nullptr && *value == -1) {
            warn(key, none);
            erase(key);
        }
        index(key);
    }
    void size(const char* key, bool required = false) const { integer(key, std::uint64_t{1} << 53, required); }

    void indices(const char* key) const {
        nlohmann::json* list = find(key);
        if (list == nullptr) return;
        if (!list->is_array()) fail(key, "is not an array");
        take_out_none(*list, key);
        for (const nlohmann::json& value : *list) check_index(value, key);
    }

    /// Indices that others count by their places, so that none may be left out.
    void numbered_indices(const char* key) const {
        const nlohmann::json* list = find(key, true);
        if (!list->is_array()) fail(key, "is not an array");
        for (const nlohmann::json& value : *list) check_index(value, key);
    }

    /// An object whose members are all indices.
    void index_map(const char* key, bool required = false) const {
        nlohmann::json* map = find(key, required);
        if (map != nullptr) check_index_map(*map, key);
    }

    void check_index_map(nlohmann::json& map, const char* key) const {
        if (!map.is_object()) fail(key, "is not a JSON object");
        take_out_none(map, key);
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

    void numbers(const char* key, std::optional<std::size_t> count = std::nullopt) const {
        const nlohmann::json* list = find(key);
        if (list == nullptr) return;
        const bool right =
            list->is_array() && (!count || list->size() == *count) &&
            std::all_of(list->begin(), list->end(), [](const nlohmann::json& value) { return value.is_number(); });
        if (!right) fail(key, "does not have the right number of numbers");
    }

    /// Fields of the object under `key`, or of none.
    auto object(const char* key, bool required = false) const {
        const auto path = [this, key] { return member(key); };
        return Fields<decltype(path)>(find(key, required), report_, path);
    }

private:
    static constexpr const char* none = "is -1, which is no index; taken as absent";

    /// Takes out the values of -1 of an array or an object.
    void take_out_none(nlohmann::json& values, const char* key) const {
        const std::size_t before = values.size();
        if (values.is_array())
            std::erase(values.get_ref<nlohmann::json::array_t&>(), nlohmann::json(-1));
        else
            std::erase_if(values.get_ref<nlohmann::json::object_t&>(),
                          [](const auto& each) { return each.second == -1; });
        if (values.size() != before) warn(key, "holds -1, which is no index; left out");
    }

    void check_index(const nlohmann::json& value, const char* key) const {
        const bool right =
            value.is_number_unsigned() &&
            value.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
        if (!right) fail(key, "holds something that is not an index");
    }

    nlohmann::json* object_;
    const FieldReport& report_;
    Path path_;
};

/// The part of check_gltf_fields about materials, textures, images, samplers and lights.
void check_gltf_materials(nlohmann::json& root, const FieldReport& report);

/// Calls check(value, fields) for every element of the array under `key` of `parent`.
template <class Path, class Check>
void for_each(nlohmann::json& parent, const char* key, const FieldReport& report, Path path, Check check) {
    const auto found = parent.find(key);
    if (found == parent.end()) return;
    if (!found->is_array()) throw InputError(report.file, path() + key, "is not an array");
    for (std::size_t i = 0; i < found->size(); ++i) {
        check((*found)[i], Fields(&(*found)[i], report, [&path, key, i] { return element(path() + key, i); }));
    }
}

} // namespace boxwood
