#pragma once
// Which components of a mesh are solids that pass through each other or themselves.

#include "geometry/clean/steps.hpp"

namespace facetmill::clean_steps {

/// Closed components that intersect, directly or by way of others: what becomes one solid, or is left,
/// together.
struct Solids {
    Rings rings;           ///< of the mesh, where they are known; then no vertices are at one place
    LooseEdges edges;      ///< of the mesh
    Components components; ///< faces that hang together over edges
    std::vector<std::uint8_t> closed; ///< [components] and consistent, finite and without faces of no area
    std::vector<const char*> why_not; ///< [components] are they not closed
    std::vector<double> six_volumes;  ///< [components]
    std::vector<std::uint8_t> inward; ///< [components] the volume is negative
    std::vector<Index> cluster;       ///< [components] none for those that intersect no closed component
    std::vector<NotDone>
        unfit;            ///< the places where components intersect that are not closed, one per component
    std::vector<Vec3> at; ///< [clusters] the first place
    std::vector<std::uint8_t> meets_unfit; ///< [clusters]

    std::size_t clusters() const { return at.size(); }
    Index cluster_of_face(Index f) const { return cluster[components.of_face[f]]; }
};

/// found: all pairs of faces that intersect. rings: those of the mesh, if they are known. have_area: all
/// faces are known to have an area.
Solids find_solids(const Mesh& mesh, const SelfIntersections& found, Rings rings = {},
                   bool have_area = false);

} // namespace facetmill::clean_steps
