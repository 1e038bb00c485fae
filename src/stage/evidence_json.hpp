#pragma once
// What speaks against a property, as checks carry it.

#include "geometry/inspect.hpp"

#include "base/json.hpp"

namespace facetmill {

/// The first places in the world, ten at most: [{part, at, face}], of pairs of faces that meet
/// also {with}. Against closedness and about borders, one
/// entry for each open chain: [{part, at, face, loop, edges, length}], the loops numbered from 0 by their
/// lowest vertex, at the middle of their first edge.
Json evidence_against(const Scene& scene, const Property& property);

} // namespace facetmill
