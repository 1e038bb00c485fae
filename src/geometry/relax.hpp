#pragma once
// Relaxation: every vertex moves towards the mean of its neighbours, all at the same time.

#include "mesh/mesh.hpp"

namespace facetmill {

struct RelaxSettings {
    enum class Neighbours {
        faces, ///< all vertices of the faces that share the vertex, each once: a quad's far corner counts
        edges, ///< the vertices joined to it by an edge
    };
    enum class Boundary {
        fixed, ///< boundary vertices stay
        slide, ///< averaged with their neighbours along the boundary only
        free,  ///< as all others: an open surface shrinks
    };
    std::int64_t iterations = 1; ///< 0 and more
    double factor = 1;           ///< share of the way to the mean: 0 < factor <= 1
    Neighbours neighbours = Neighbours::faces;
    Boundary boundary = Boundary::fixed;
};

struct RelaxResult {
    Mesh mesh;
    Fates fates;
    double largest_move = 0; ///< the farthest that a vertex came from its place, in the mesh's units
    std::size_t moved = 0;   ///< vertices that are elsewhere than before
    std::size_t held = 0;    ///< boundary vertices that were held
};

/// P' = P + factor / n * sum(Pj - P) per iteration, simultaneously for all vertices, over the n neighbours
/// Pj.
///
/// A boundary edge is one with exactly one face; edges with three and more faces are not boundary. Vertices
/// without neighbours stay. Faces, wedges and topology are untouched; NORMAL is recomputed, TANGENT made
/// perpendicular to it, all else kept. The map is affine-invariant, so part and world space give the same
/// surface. Throws usage (E-RANGE) when a setting is out of range. O(iterations * corners), parallel; the
/// same bytes for any number of threads. Source: the note 'Surface relaxation and smoothing' (1997); it is
/// the umbrella-weighted Laplacian.
RelaxResult relax(Mesh mesh, const RelaxSettings& settings = {});

} // namespace facetmill
