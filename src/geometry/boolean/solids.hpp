#pragma once
// Finds the components of a mesh that are solids which intersect each other or themselves.

#include "geometry/clean/steps.hpp"

namespace facetmill::clean_steps {

/// Clusters are closed components that intersect, directly or through others. They become one solid together,
/// or stay unchanged together.
struct Solids {
    Rings rings;                      ///< of the mesh, if known; then no vertices have the same position
    LooseEdges edges;                 ///< of the mesh
    Components components;            ///< faces connected across edges
    std::vector<std::uint8_t> closed; ///< [components] 1 if closed, consistent, finite, all with area
    std::vector<const char*> why_not; ///< [components] reason if not closed
    std::vector<double> six_volumes;  ///< [components]
    std::vector<std::uint8_t> inward; ///< [components] 1 if the volume is negative
    std::vector<Index> cluster;       ///< [components] none if it intersects no closed component
    std::vector<NotDone>
        unfit;            ///< where components intersect that are not closed, one position per component
    std::vector<Vec3> at; ///< [clusters] the first position
    std::vector<std::uint8_t> meets_unfit; ///< [clusters]

    std::size_t clusters() const { return at.size(); }
    Index cluster_of_face(Index f) const { return cluster[components.of_face[f]]; }
};

/// found: all pairs of intersecting faces. rings: of the mesh, if known. have_area: all faces are known to
/// have an area.
[[nodiscard]] Solids find_solids(const Mesh& mesh, const SelfIntersections& found, Rings rings = {},
                                 bool have_area = false);

} // namespace facetmill::clean_steps
