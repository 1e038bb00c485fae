#pragma once
// Relaxation: vertices move towards the mean of their neighbours, all at the same time.

#include "base/refusal.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace facetmill {

struct RelaxSettings {
    enum class Method {
        laplacian, ///< towards the mean of the neighbours
        taubin,    ///< an inward and an outward step: hardly shrinks
        cotangent, ///< towards the mean weighted by angles: vertices do not drift along the surface
        implicit,  ///< a linear system per iteration: any lambda is stable
        hc,        ///< towards the mean, then pushed back by the moves of the neighbours: keeps the volume
    };
    enum class Neighbours {
        faces, ///< all vertices of the faces at the vertex, each once, including a quad's far corner
        edges, ///< the vertices joined to the vertex by an edge
    };
    enum class Boundary {
        fixed, ///< boundary vertices stay
        slide, ///< averaged only with their neighbours along the boundary, so corners become round unless
               ///< feature_angle holds them
        free,  ///< moved like all others, so an open surface shrinks
    };
    Method method = Method::laplacian;
    std::int64_t iterations = 1;       ///< at least 0
    std::optional<double> lambda = {}; ///< share of the way to the mean; empty: 1, or 0.5 for taubin. 0 <
                                       ///< lambda <= 1; taubin: below 0.7; implicit: above 0
    Neighbours neighbours = Neighbours::faces;
    Boundary boundary = Boundary::fixed;
    std::optional<double> feature_angle = {}; ///< in radians: edges whose faces meet at a larger angle are
                                              ///< kept; vertices on them only move along them
    double pass_band = 0.1;                   ///< taubin: the surface frequencies to keep, between 0 and 1
    double alpha = 0;                         ///< hc: weight of the original surface, 0 to 1
    double beta = 0.5;                        ///< hc: the vertex's own share of the pull-back, 0 to 1
    std::vector<double> mask = {};            ///< [vertices] share of the move, 0 to 1; empty: 1
    /// Stops when no vertex moves farther than this in an iteration, in world units; 0: never. If the surface
    /// keeps shrinking, relaxation stops before a third of its area is lost, because it would end as a point.
    /// The loss counts from the area after the first iteration, because that iteration may remove noise.
    double until = 0;
    Transform to_world = {}; ///< from the part's space to the world, where angles and moves are measured
};

struct RelaxResult {
    Mesh mesh;
    AttributeChanges changes;
    std::int64_t iterations = 0; ///< completed iterations
    bool settled = false;        ///< stopped by `until`
    bool shrank = false;         ///< stopped because of the area, with `until`
    double largest_move = 0; ///< the farthest distance of a vertex from its original position, in world units
    double last_move = 0;    ///< the largest move in the last iteration; only if `until` was given
    std::size_t moved = 0;   ///< vertices that moved
    std::size_t held = 0;    ///< vertices that had to stay: boundary, corners of features, mask 0
};

/// P' = P + lambda (mean of the neighbours - P) per iteration, simultaneously for all vertices.
///
/// - laplacian takes the plain mean (P. Bourke, "Surface Relaxation and Smoothing", 1997).
/// - taubin (G. Taubin, "A signal processing approach to fair surface design", 1995) follows each step by a
///   step of mu = 1 / (pass_band - 1 / lambda), which is negative.
/// - cotangent weights each neighbour by the cotangents of the two angles opposite to the edge (U. Pinkall
///   and K. Polthier, "Computing discrete minimal surfaces and their conjugates", 1993). The weights are
///   recomputed in every iteration. Obtuse angles count 0, slivers at most 10^6 and triangles without area 0,
///   so the mean stays among the neighbours.
/// - implicit (M. Desbrun et al., "Implicit fairing of irregular meshes using diffusion and curvature flow",
///   1999) solves P' = P + lambda (mean' - P') with Eigen's conjugate gradients to a relative residual of
///   1e-10.
/// - hc (J. Vollmer, R. Mencl and H. Mueller, "Improved Laplacian smoothing of noisy surface meshes", 1999)
///   takes the laplacian step and then pushes back. Each vertex has a target, alpha * first + (1 - alpha) *
///   previous position. The push is beta of the vertex's difference from its target, plus 1 - beta of the
///   neighbours' mean difference from their targets.
///
/// A boundary edge has exactly one face; edges with three and more faces are features. A vertex with exactly
/// two feature (or, sliding, boundary) edges moves along them. A vertex with one feature edge or more than
/// two stays, and so does a vertex where the line turns by more than the angle. Vertices without neighbours
/// stay. Faces, wedges and topology are unchanged. NORMAL is recomputed, TANGENT made perpendicular to it.
/// Morph targets of positions are relaxed like the surface if the wedges of a vertex agree. All other
/// attributes stay; the result lists the changes. The result does not depend on the frame for similar
/// transforms; angles and until are measured in the world. Throws a usage error (E-RANGE) if a setting is
/// out of range, a stage error (E-SOLVE) if the linear system cannot be solved. O(iterations * corners),
/// parallel. The result does not depend on the number of threads.
[[nodiscard]] RelaxResult relax(Mesh mesh, const RelaxSettings& settings = {});

/// The refusal (E-RANGE) of a setting out of range. relax throws it first.
[[nodiscard]] std::optional<Refusal> check_relax_settings(const RelaxSettings& settings);

struct Neighbourhoods {
    VertexLists lists; ///< neighbours of each vertex, in a fixed order, each once; empty for fixed vertices
    std::size_t held = 0; ///< number of vertices with an empty list, because they are on a fixed boundary, or
                          ///< features meet or end at them
    std::vector<std::uint8_t>
        along; ///< [vertices] 1 if the vertex only moves along its boundary or feature; may be empty
};

/// Uses only neighbours, boundary, feature_angle, to_world, and whether the mask is 0. Parallel, O(corners)
/// for faces of bounded size. Throws a limit error (E-LIMIT) for polygons whose neighbours cannot be
/// counted.
[[nodiscard]] Neighbourhoods neighbourhoods(const Mesh& mesh, const RelaxSettings& settings);

/// [vertices] 1 if the vertex is the end of an edge with exactly one face.
[[nodiscard]] std::vector<std::uint8_t> boundary_vertices(const Mesh& mesh);

} // namespace facetmill
