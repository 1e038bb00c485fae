#pragma once
// Features: which vertices may move how, and open borders that run along each other.

#include "geometry/simplify/state.hpp"

namespace facetmill::simplification {

/// Sets the kinds of the vertices and the flags of the edges. Found once, since every collapse that is
/// allowed keeps the answer.
/// corner_angle: vertices where a boundary turns by more than this stay, too (radians).
void classify(State& s, const Mesh& mesh, const SimplifyLocks& lock, std::optional<double> corner_angle = {});

/// Which corners' edges are features now, by the corners of the mesh; empty when none is.
std::vector<std::uint8_t> feature_corners(const State& s);

/// Open borders that run along each other at exactly the same places, as of patches and parts that were never
/// welded: for the work their vertices are joined and the wedges stay apart, so that both sides collapse as
/// the two sides of a seam do.
class CoincidentBorders {
  public:
    /// For each vertex of the mesh the lowest one that it is to be joined with: the ends of boundary edges
    /// whose ends are at exactly the same places. Empty when there are none. The state must be classified.
    static std::vector<Index> find(const State& s, const Mesh& mesh);
    /// Joins vertices as `find` says; each wedge stays, so the borders become seams. Vertices that lost their
    /// wedges stay unused. Vertex attributes go to the wedges.
    CoincidentBorders(Mesh& mesh, const std::vector<Index>& target);

    const std::vector<Index>& sides() const { return sides_; } ///< see Features::side_of_wedge
    /// Separates the vertices of a simplified mesh as they were. wedges: those of the joined mesh that are
    /// left. sources: of its vertices, those of the joined mesh; they become those of the separate one.
    /// Empty: not asked for.
    void separate(Mesh& mesh, const std::vector<Index>& wedges, AttributeChanges& changes,
                  std::vector<Index>& sources) const;
    /// How many more vertices the state has once they are separated.
    std::size_t doubled(const State& s) const;

  private:
    std::vector<Index> sides_;             ///< [wedges of the joined mesh] the vertex that each was at
    std::vector<std::string> of_vertices_; ///< attributes that were in the domain of vertices
    bool had_seams_ = false;
};

} // namespace facetmill::simplification
