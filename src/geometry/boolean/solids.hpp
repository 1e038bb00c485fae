#pragma once
// Finds the components of a mesh that are solids which intersect each other or themselves.

#include "geometry/clean/steps.hpp"

namespace facetmill::clean_steps {

/// Clusters are closed components that intersect, directly or through others. They become one solid together,
/// or stay unchanged together.
struct Solids {
    Rings rings;           ///< rings of the mesh, if known; then no two vertices have the same position
    LooseEdges edges;      ///< edges of the mesh
    Components components; ///< faces connected across edges
    std::vector<std::uint8_t> closed; ///< [components] 1 if closed, consistent, finite, all with area
    std::vector<const char*> why_not; ///< [components] reason if not closed
    std::vector<double> six_volumes;  ///< [components] six times the volume
    std::vector<std::uint8_t> inward; ///< [components] 1 if the volume is negative
    std::vector<Index> cluster;       ///< [components] none if it intersects no closed component
    std::vector<NotDone> unfit;       ///< a position for each component that intersects but is not closed
    std::vector<Vec3> at;             ///< [clusters] the first position
    std::vector<std::uint8_t> meets_unfit; ///< [clusters] 1 if the cluster meets an unsuitable component

    std::size_t clusters() const { return at.size(); }
    Index cluster_of_face(Index f) const { return cluster[components.of_face[f]]; }
};

/// found: all pairs of intersecting faces. rings: the rings of the mesh, if known. have_area: all faces are
/// known to have area.
[[nodiscard]] Solids find_solids(const Mesh& mesh, const SelfIntersections& found, Rings rings = {},
                                 bool have_area = false);

} // namespace facetmill::clean_steps
