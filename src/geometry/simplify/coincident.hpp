#pragma once
// Borders that touch, while a mesh is simplified.

#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

/// For each vertex of the mesh the lowest one that it is joined with: the ends of open edges whose ends are
/// at exactly the same places. Empty when no borders touch. The work must be classified.
std::vector<Index> touching_vertices(const Work& s, const Mesh& mesh);

/// The sides of borders that were joined, to part them again.
class Touching {
  public:
    bool any() const { return !sides_.empty(); }
    const std::vector<Index>& sides() const { return sides_; } ///< see Work::sides
    /// Joins vertices as touching_vertices says; each wedge stays, so the borders become seams. Vertices that
    /// lost their wedges stay unused. Vertex attributes go to the wedges.
    void join(Mesh& mesh, const std::vector<Index>& target);
    /// Parts the vertices of a simplified mesh as they were. wedges: those of the joined mesh that are left.
    void part(Mesh& mesh, const std::vector<Index>& wedges, Fates& fates) const;
    /// How many more vertices the work has once it is parted.
    std::size_t doubled(const Work& s) const;

  private:
    std::vector<Index> sides_;             ///< [wedges of the joined mesh] the vertex that each was at
    std::vector<std::string> of_vertices_; ///< attributes that were in the domain of vertices
    bool plain_ = false;                   ///< there were no seams before
};

} // namespace facetmill::simplification
