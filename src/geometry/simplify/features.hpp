#pragma once
// Finds features, which restrict how vertices move, and open borders with identical positions.

#include "geometry/simplify/state.hpp"

namespace facetmill::simplification {

/// Sets the kinds of the vertices and the flags of the edges. This runs once, because no allowed collapse
/// changes the result. corner_angle: vertices where a boundary turns by more than this angle (radians) stay
/// as well.
void classify(State& s, const Mesh& mesh, const SimplifyLocks& lock, std::optional<double> corner_angle = {});

/// [corners of the mesh] 1 for corners whose edge is a feature now; empty if the mesh has no feature.
[[nodiscard]] std::vector<std::uint8_t> feature_corners(const State& s);

/// Open borders with exactly the same positions, for example of patches or parts that were never welded.
/// Their vertices are joined during the work, and their wedges stay separate. So both borders collapse like
/// the two sides of a seam.
class CoincidentBorders {
  public:
    /// For each vertex of the mesh, the lowest vertex to join it with. Such vertices are ends of boundary
    /// edges whose ends have exactly the same positions. Empty when no borders coincide. The state must be
    /// classified.
    static std::vector<Index> find(const State& s, const Mesh& mesh);
    /// Joins vertices according to the result of `find`. Each wedge stays, so the borders become seams.
    /// Vertices without wedges stay unused. Vertex attributes become wedge attributes.
    CoincidentBorders(Mesh& mesh, const std::vector<Index>& target);

    const std::vector<Index>& sides() const { return sides_; } ///< see Features::side_of_wedge
    /// Separates the vertices of a simplified mesh again. wedges: the surviving wedges of the joined mesh.
    /// sources: for each vertex, its source in the joined mesh; the function replaces them with vertices of
    /// the separate mesh. sources may be empty if not needed.
    void separate(Mesh& mesh, const std::vector<Index>& wedges, AttributeChanges& changes,
                  std::vector<Index>& sources) const;
    /// The number of vertices that separating adds to the state.
    std::size_t doubled(const State& s) const;

  private:
    std::vector<Index> sides_;             ///< [wedges of the joined mesh] original vertices
    std::vector<std::string> of_vertices_; ///< attributes that were in the vertex domain
    bool had_seams_ = false;
};

} // namespace facetmill::simplification
