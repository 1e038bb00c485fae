#pragma once
// The one rule by which quads are cut in two, for all that cuts them: triangulated, split, files of
// triangles.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Which diagonals of a quad are sound: the triangles on both sides look the same way.
struct QuadDiagonals {
    bool first = false, second = false; ///< from corner 0 to 2; from corner 1 to 3
    bool cut_at_second = false;         ///< the one to take: the sound one, of two (or none) the shorter;
                                        ///< ties: the one at the first corner

    /// Only one diagonal is sound: the quad has a reflex corner, and that diagonal ends there.
    bool concave() const { return first != second; }
};

/// Face f must have four corners.
[[nodiscard]] QuadDiagonals quad_diagonals(const Mesh& mesh, Index f);

/// The diagonal of every quad, 1: from its second corner. Each is the one of quad_diagonals, unless
/// that joins two vertices that an edge or an earlier quad's diagonal joins already while the other one is
/// sound and free. coinciding: quads where neither was free.
struct QuadCuts {
    std::vector<std::uint8_t> at_second; ///< [faces]
    std::size_t coinciding = 0;
};
[[nodiscard]] QuadCuts quad_cuts(const Mesh& mesh);

} // namespace facetmill
