// SPDX-License-Identifier: MIT
// Tables of the words that name the values of an enumeration.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "boxwood/error.hpp"

namespace boxwood {

template <class Value, std::size_t size>
using Words = std::array<std::pair<std::string_view, Value>, size>;

template <class Value, std::size_t size>
std::string_view word_of(const Words<Value, size>& table, Value value) {
    const auto found = std::ranges::find(table, value, [](const auto& entry) { return entry.second; });
    return found == table.end() ? std::string_view("unknown") : found->first;
}

/// Throws InputError(option, word, ...) listing the words.
template <class Value, std::size_t size>
Value value_of(const Words<Value, size>& table, std::string_view option, std::string_view word) {
    const auto found = std::ranges::find(table, word, [](const auto& entry) { return entry.first; });
    if (found != table.end()) return found->second;
    std::string words;
    for (const auto& entry : table) words.append(words.empty() ? "" : ", ").append(entry.first);
    throw InputError(std::string(option), std::string(word), "unknown word; use one of " + words);
}

} // namespace boxwood
