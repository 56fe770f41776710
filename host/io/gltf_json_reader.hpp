// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace boxwood {

/// Builds a JSON document from parser events and leaves out, key by key, what Boxwood never reads: animations and the
/// like never take memory, and no kept value is nested so deeply that a recursive pass over it could run out of stack.
/// A whole number is kept as an integer however it is written: 4, 4.0 and 4e0 are the same number in JSON.
/// The parser itself does not recurse. Every failure is thrown as an InputError.
class GltfJsonReader : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit GltfJsonReader(const std::string& file) : file_(file) {}

    /// The document, after a parse that succeeded.
    nlohmann::json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override;
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& value) override { return add(std::move(value)); }
    bool start_object(std::size_t) override { return open(nlohmann::json::object()); }
    bool start_array(std::size_t) override { return open(nlohmann::json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& key) override;
    bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) override;

private:
    /// An "extensions" object that is open.
    struct Extensions {
        std::size_t depth;        ///< Where its keys are: names of extensions.
        bool has_foreign = false; ///< Some extension in it was left out.
    };

    bool keep(const std::string& key);
    bool skips();
    bool add(nlohmann::json value);
    bool open(nlohmann::json value);
    bool close();
    nlohmann::json* place(nlohmann::json value);

    const std::string& file_;
    nlohmann::json root_;
    std::vector<nlohmann::json*> open_;  ///< The kept objects and arrays around the next value.
    std::string key_;                    ///< Of the next value, when it goes into an object.
    std::string section_;                ///< Key in the root that we are under.
    std::vector<Extensions> extensions_; ///< The "extensions" around the next value.
    bool skip_next_ = false;
    std::size_t skipped_depth_ = 0; ///< Objects and arrays open inside a value that is left out.
};

} // namespace boxwood
