// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "shared/aabb.h"
#include "shared/influence.h"

namespace boxwood {

struct Scene;

enum class AreaKind { plane, point };

/// A region of a scene where rays are parallel (plane) or come from one point (point): thesis chapter 3, paper section
/// 4. World coordinates. What matters are the lines: rays that run back along them, as shadow rays do towards a light,
/// are the area's too.
struct InfluenceArea {
    AreaKind kind = AreaKind::plane;
    glm::dvec3 origin{0.0};               ///< Plane: centre of the rectangle that rays leave. Point: the eye.
    glm::dvec3 direction{0.0, 0.0, -1.0}; ///< Of the rays, or of the view; need not be normalised.
    double half_width = 1.0; ///< Plane: half extent of the rectangle. Point: tangent of half the field of view.
    double half_height = 1.0;
    double near = 0.0;              ///< Point: distance of the plane that rays leave. Plane: 0.
    double far = 1.0;               ///< How far the region reaches along the direction.
    double tolerance_degrees = 0.5; ///< Largest angle between an affine ray and the area's own.
    std::optional<double> share;    ///< Of all rays, those that follow this area; see influence_records.
};

/// Most areas that there can be.
inline constexpr std::size_t most_areas = 4096;
/// Largest tangent of half a field of view; its inverse is the smallest.
inline constexpr double largest_tangent = 0x1p30;

/// Throws InputError(source, "area I", what) unless every area is finite, has extents above 0, a direction other than
/// 0, near below far (above 0 for point areas), a tolerance in [0, 90] and shares in [0, 1] that add up to at most 1.
/// Coordinates and lengths go to largest_coordinate, lengths down to its inverse. Throws CapacityError for more than
/// most_areas.
void validate(std::span<const InfluenceArea> areas, const std::string& source);

/// The areas as the device sees them, the directions normalised; `up` is the world's +y made perpendicular, or +z where
/// the direction is +-y. Areas without a share divide what the others leave evenly with the rays that follow none: n of
/// them get 1 / (n + 1) of it each. Throws as validate does.
std::vector<InfluenceRecord> influence_records(std::span<const InfluenceArea> areas,
                                               const std::string& source = "influence areas");

/// Reads a JSON list of areas, as shared by the paper's authors: {"kind": "plane", "point", "direction", "half_width",
/// "half_height", "length"} or {"kind": "point", "eye", "direction", "fov_x_degrees", "fov_y_degrees", "near", "far"},
/// both with optional "tolerance_degrees" and "share"; other keys are not read. Throws InputError naming the file and
/// the index of the area.
std::vector<InfluenceArea> load_areas(const std::filesystem::path& file);

/// Most areas that areas_from_lights makes.
inline constexpr std::size_t most_light_areas = 64;

/// Areas that the shadow rays towards a scene's lights follow, backwards; world space, in the order of the lights, then
/// of the instances, up to most_light_areas.
/// - A directional light: a plane area whose box holds the scene.
/// - A point light: six point areas, the faces of a cube about it, as far as the scene and its range; those that miss
///   the box of the scene are left out. A spot light: one around its cone, or the faces that the cone reaches where it
///   is wider than 60 degrees to each side.
/// - A lamp, the emitting triangles of an instance where they lie in one plane to within 2^-10 of their size: a plane
///   area over their bounding rectangle for each side that emits, as far as the scene, whose tolerance (0.5 to 45
///   degrees) is the largest angle that a ray has from its far end to the rectangle. A texture of emission is not
///   looked at.
std::vector<InfluenceArea> areas_from_lights(const Scene& scene);

/// The region of an area (thesis 5.3): closed, in double precision, by the record's floats as they are. A box is closed
/// too.
bool contains(const InfluenceRecord& area, const glm::dvec3& point);
bool encloses(const InfluenceRecord& area, const Aabb& box);
/// Separating axes (thesis A.5) with the axis sets of a box and of a frustum. True also where the gap is too small for
/// double precision to tell.
bool intersects(const InfluenceRecord& area, const Aabb& box);
/// Rounded outwards.
Aabb enclosing_box(const InfluenceRecord& area);
/// The corners: near face, then far face, each (-,-), (+,-), (-,+), (+,+).
std::array<glm::dvec3, 8> corners(const InfluenceRecord& area);

} // namespace boxwood
