#pragma once
// The qualities of geometry/inspect/qualities.hpp that are about attributes.

#include "geometry/inspect/qualities.hpp"

namespace facetmill {

/// uvs_in_range, finite_attributes, unit_normals, weights_sum and joints.
bool is_of_attributes(Quality quality);

/// As `measure`, for these. Parallel.
std::optional<double> measure_attributes(const Mesh& mesh, Quality quality);

/// The first elements that keep a truth from holding, or whose number of joints fails, attribute by
/// attribute: where their vertex is, with the lowest face at it, or in the middle of their face. What they
/// are known by depends on the position and on the attribute's name.
std::vector<Place> places_against_attributes(const Mesh& mesh, Quality quality, std::size_t limit,
                                             const std::function<bool(double)>& fails);

} // namespace facetmill
