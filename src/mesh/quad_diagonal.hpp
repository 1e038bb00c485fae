#pragma once
// The common rule for cutting quads in two, used by triangulated(), split and triangle formats.

#include "mesh/mesh.hpp"

namespace facetmill {

/// The sound diagonals of a quad: the triangles on both sides face the same direction.
struct QuadDiagonals {
    bool first = false, second = false; ///< from corner 0 to 2; from corner 1 to 3
    bool cut_at_second = false; ///< the diagonal to use: the sound diagonal, or the shorter if both or
                                ///< neither are sound; ties: the diagonal at the first corner

    /// True if only one diagonal is sound. It ends at the quad's reflex corner.
    bool concave() const { return first != second; }
};

/// Face f must have four corners.
[[nodiscard]] QuadDiagonals quad_diagonals(const Mesh& mesh, Index f);

/// The diagonal of every quad. It is the diagonal of quad_diagonals, with an exception. The other diagonal
/// is used if it is sound and free, and an edge or an earlier diagonal already joins the two vertices of the
/// first. coinciding: quads where neither was free.
struct QuadCuts {
    std::vector<std::uint8_t> at_second; ///< [faces] 1: the diagonal from the second corner
    std::size_t coinciding = 0;
};
[[nodiscard]] QuadCuts quad_cuts(const Mesh& mesh);

} // namespace facetmill
