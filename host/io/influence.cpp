// SPDX-License-Identifier: MIT
// Lists of influence areas in JSON.
#include "io/influence.hpp"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"
#include "io/gltf_document.hpp"

namespace boxwood {

namespace {

using nlohmann::json;

/// The members of one area.
class Reader {
public:
    Reader(const json& object, const std::string& source, std::size_t index)
        : object_(object), source_(source), where_("area " + std::to_string(index)) {
        if (!object.is_object()) fail("is not a JSON object");
    }

    [[noreturn]] void fail(const std::string& what) const { throw InputError(source_, where_, what); }

    const json& member(const std::string& key) const {
        const auto found = object_.find(key);
        if (found == object_.end()) fail(key + " is missing");
        return *found;
    }
    bool has(const std::string& key) const { return object_.contains(key); }

    double number(const std::string& key) const {
        const json& value = member(key);
        if (!value.is_number()) fail(key + " is not a number");
        return value.get<double>();
    }
    glm::dvec3 vector(const std::string& key) const {
        const json& value = member(key);
        glm::dvec3 v;
        if (!value.is_array() || value.size() != 3) fail(key + " is not a list of three numbers");
        for (std::size_t k = 0; k < 3; ++k) {
            if (!value[k].is_number()) fail(key + " is not a list of three numbers");
            v[static_cast<int>(k)] = value[k].get<double>();
        }
        return v;
    }
    /// The tangent of half of an angle.
    double half_tangent(const std::string& key) const {
        const double degrees = number(key);
        if (!(degrees > 0 && degrees < 180)) fail(key + " is not between 0 and 180 degrees");
        return std::tan(glm::radians(0.5 * degrees));
    }

private:
    const json& object_;
    const std::string& source_;
    const std::string where_;
};

InfluenceArea area_of(const Reader& reader) {
    InfluenceArea area;
    const json& kind = reader.member("kind");
    area.direction = reader.vector("direction");
    if (kind == "plane") {
        area.origin = reader.vector("point");
        area.half_width = reader.number("half_width");
        area.half_height = reader.number("half_height");
        area.far = reader.number("length");
    } else if (kind == "point") {
        area.kind = AreaKind::point;
        area.origin = reader.vector("eye");
        area.half_width = reader.half_tangent("fov_x_degrees");
        area.half_height = reader.half_tangent("fov_y_degrees");
        area.near = reader.number("near");
        area.far = reader.number("far");
    } else {
        reader.fail("kind is neither \"plane\" nor \"point\"");
    }
    if (reader.has("tolerance_degrees")) area.tolerance_degrees = reader.number("tolerance_degrees");
    if (reader.has("share")) area.share = reader.number("share");
    return area;
}

} // namespace

std::vector<InfluenceArea> read_areas(std::string_view text, const std::string& source) {
    json list;
    try {
        list = json::parse(text);
    } catch (const json::exception& error) { // broken text, or a number beyond double
        throw InputError(source, "", excerpt(error.what()));
    }
    if (!list.is_array()) throw InputError(source, "", "is not a JSON list of influence areas");
    if (list.size() > most_areas) throw CapacityError("influence areas", list.size(), most_areas);
    std::vector<InfluenceArea> areas;
    areas.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) areas.push_back(area_of(Reader(list[i], source, i)));
    validate(areas, source);
    return areas;
}

std::vector<InfluenceArea> load_areas(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_regular_file(file, file.string(), "");
    return read_areas({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

} // namespace boxwood
