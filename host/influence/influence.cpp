// SPDX-License-Identifier: MIT
#include "boxwood/influence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boxwood/error.hpp"
#include "boxwood/scene.hpp"
#include "influence/area_fault.hpp"

namespace boxwood {

namespace {

constexpr double largest = largest_coordinate;

double largest_component(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Of any length that is finite and above 0.
glm::dvec3 normalised(const glm::dvec3& v) { return glm::normalize(v / largest_component(v)); }

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// In [low, high], which NaN is not.
bool within(double value, double low, double high) { return value >= low && value <= high; }

} // namespace

std::string area_fault(const InfluenceArea& area) {
    const bool point = area.kind == AreaKind::point;
    if (!is_finite(area.origin) || largest_component(area.origin) > largest)
        return "the origin is not within 2^60 of 0";
    if (!is_finite(area.direction)) return "the direction is not finite";
    if (largest_component(area.direction) == 0) return "the direction is 0";
    const double low = point ? 1 / largest_tangent : 1 / largest, high = point ? largest_tangent : largest;
    if (!within(area.half_width, low, high) || !within(area.half_height, low, high))
        return point ? "a field of view is not between 0 and 180 degrees, or too close to either"
                     : "an extent is not above 0, at least 2^-60 and at most 2^60";
    if (point && !within(area.near, 1 / largest, largest))
        return "near is not above 0, at least 2^-60 and at most 2^60";
    if (!point && !(area.near == 0)) return "near is not 0, where the rectangle of a plane area is";
    if (!within(area.far, 1 / largest, largest))
        return "how far it reaches is not above 0, at least 2^-60 and at most 2^60";
    if (!(static_cast<float>(area.near) < static_cast<float>(area.far))) return "near is not below far";
    if (!within(area.tolerance_degrees, 0, 90)) return "the tolerance is not in 0 to 90 degrees";
    if (area.share && !within(*area.share, 0, 1)) return "the share is not in 0 to 1";
    return {};
}

namespace {

InfluenceRecord record_of(const InfluenceArea& area, double share) {
    const glm::dvec3 forward = normalised(area.direction);
    const glm::dvec3 sideways(-forward.z, 0, forward.x); // forward x (0, 1, 0)
    const glm::dvec3 right = largest_component(sideways) > 0 ? normalised(sideways) : glm::dvec3(forward.y, 0, 0);
    const glm::dvec3 up = glm::cross(right, forward);
    InfluenceRecord record = {};
    for (int k = 0; k < 3; ++k) {
        record.origin[k] = static_cast<float>(area.origin[k]);
        record.right[k] = static_cast<float>(right[k]);
        record.up[k] = static_cast<float>(up[k]);
        record.forward[k] = static_cast<float>(forward[k]);
    }
    record.point = area.kind == AreaKind::point ? 1 : 0;
    record.half_width = static_cast<float>(area.half_width);
    record.half_height = static_cast<float>(area.half_height);
    record.near = static_cast<float>(area.near);
    record.far = static_cast<float>(area.far);
    record.sin_tolerance = static_cast<float>(std::sin(glm::radians(area.tolerance_degrees)));
    record.share = static_cast<float>(share);
    return record;
}

struct Shares {
    double given = 0;
    std::size_t without = 0;
};

Shares shares_of(std::span<const InfluenceArea> areas) {
    Shares shares;
    for (const InfluenceArea& area : areas) {
        if (area.share) shares.given += *area.share;
        if (!area.share) ++shares.without;
    }
    return shares;
}

} // namespace

void validate(std::span<const InfluenceArea> areas, const std::string& source) {
    if (areas.size() > most_areas) throw CapacityError("influence areas", areas.size(), most_areas);
    for (std::size_t i = 0; i < areas.size(); ++i)
        if (const std::string fault = area_fault(areas[i]); !fault.empty())
            throw InputError(source, "area " + std::to_string(i), fault);
    // Decimal shares that add up to 1 need not do so as they are rounded.
    const double rounding = static_cast<double>(areas.size()) * std::numeric_limits<double>::epsilon();
    double sum = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        sum += areas[i].share.value_or(0);
        if (sum > 1 + rounding)
            throw InputError(source, "area " + std::to_string(i), "the shares up to here are above 1");
    }
}

std::vector<InfluenceRecord> influence_records(std::span<const InfluenceArea> areas, const std::string& source) {
    validate(areas, source);
    const Shares shares = shares_of(areas);
    const double even = std::max(1 - shares.given, 0.0) / static_cast<double>(shares.without + 1);
    std::vector<InfluenceRecord> records;
    records.reserve(areas.size());
    for (const InfluenceArea& area : areas) records.push_back(record_of(area, area.share.value_or(even)));
    return records;
}

} // namespace boxwood
