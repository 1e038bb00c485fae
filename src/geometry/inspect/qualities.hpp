#pragma once
// Properties of a mesh that cost more than one look, or are about shape and attributes: measured when asked
// for.

#include "geometry/inspect/evidence.hpp"

#include <functional>
#include <optional>
#include <span>

namespace facetmill {

enum class Quality {
    min_angle,
    max_angle,
    aspect_ratio,
    shortest_edge,
    longest_edge,
    planarity,
    folded_faces,
    t_vertices,
    boundary_length,
    longest_boundary,
    outward,
    coplanar_overlaps,
    wall_thickness,
    uvs_in_range,
    uv_overlaps,
    finite_attributes,
    unit_normals,
    weights_sum,
    joints,
    extent,
};
inline constexpr std::size_t quality_count = 20;

/// How the values of several parts become one: truths hold for all.
enum class Join { sum, least, most, all };

/// What a quality that is no truth is measured in.
enum class Measure { number, length, angle, count };

struct QualityInfo {
    const char* name; ///< as users write it
    Join join;
    const char* help;
    Measure measure = Measure::number;
};

const QualityInfo& info_of(Quality quality);

/// The value for a mesh in world space; truths as 0 and 1; none when it does not apply (no faces, no such
/// attribute). What each means is told by its help; aspect_ratio is the longest edge over twice the square
/// root of three times the inner radius (1 for an equilateral triangle). Angles in degrees. Polygons are
/// taken as their triangles for angles and ratios. Decided exactly: folded_faces, t_vertices,
/// coplanar_overlaps, uv_overlaps. Parallel.
std::optional<double> measure(const Mesh& mesh, Quality quality);

/// Whether it is the least or the most of a value that every face has (min_angle, wall_thickness ...).
bool is_by_face(Quality quality);

/// The worst places first, of those that are by face only faces whose own value fails; for those that are
/// decided one by one, the first by face.
std::vector<Place> places_against(const Mesh& mesh, Quality quality, std::size_t limit,
                                  const std::function<bool(double)>& fails = {});

} // namespace facetmill
