#pragma once
// Locations where a property fails, for people and for marked copies of the mesh.

#include "geometry/inspect/inspect.hpp"
#include "mesh/topology.hpp"

#include <functional>

namespace facetmill {

/// A location on a mesh: a face (or none), and a point of it in the mesh's space.
struct Location {
    Index face = none;
    Vec3 at = {};
    Index with = none;      ///< the other face of a pair
    Index attribute = none; ///< the mesh's attribute that it is about
    /// Identifies the location whatever the numbers and the order of faces, corners and vertices. It is a
    /// hash of the positions of a face, a pair of faces, an edge or a vertex; for a component of its lowest
    /// position. Equal coordinates give equal keys, and different ones different keys (except by chance, at
    /// 64 bits). 0 and -0 are equal, and so are all NaNs.
    std::uint64_t key = 0;
};

/// The options of a location query.
struct LocationQuery {
    std::size_t limit = 10;
    /// Whether a value fails, of properties that each face or element has a value of; empty: all do.
    std::function<bool(double)> fails = {};
};

/// The first locations that speak against a property, in the mesh's (the part's own) space, in order of edge,
/// face or vertex number: those that keep it from holding as a sound mesh has it. Of properties that each
/// face has (min_angle), the worst faces whose value fails, the worst first; values are taken where the part
/// stands. Empty for properties that are not about places. O(n log n).
[[nodiscard]] std::vector<Location> locations_against(const Mesh& mesh, const Property& property,
                                                      const LocationQuery& query = {});
[[nodiscard]] std::vector<Location> locations_against(const Part& part, const Property& property,
                                                      const LocationQuery& query);

/// Edges of the boundary that hang together by their vertices: a loop, or several that touch.
struct BoundaryChain {
    std::size_t edges = 0;
    double length = 0;
    Index face = none; ///< at the chain's first edge
    Vec3 at;           ///< the middle of that edge
};
/// By their lowest vertex. O(n log n).
[[nodiscard]] std::vector<BoundaryChain> boundary_chains(const Mesh& mesh);

/// One thing that speaks against a property of a scene.
struct Evidence {
    std::string part = {}, material = {};  ///< whose it is; one of them may be empty
    std::optional<Location> location = {}; ///< `at` is in the world
    std::string attribute = {};            ///< the location is about it
    std::optional<std::size_t> loop = {};  ///< the number of the boundary chain within its part,
    BoundaryChain chain = {};              ///< ... and it
    std::optional<double> amount = {};     ///< the part's contribution, if there is no location
};

struct EvidenceQuery {
    const Property& property;
    std::function<bool(double)> fails = {};
    Box within = {}; ///< for a box: the required bounds
    std::size_t limit = 10;
};

/// The first evidence, as the property's row finds it.
[[nodiscard]] std::vector<Evidence> evidence_against(const Scene& scene, const EvidenceQuery& query);

/// Face f, in the middle of its corners.
[[nodiscard]] Location location_of(const Mesh& mesh, Index f);
/// The location as evidence, told where the part stands.
[[nodiscard]] Evidence evidence_of(const Part& part, Location location);

/// [of_face's numbers below count] The key of each component: the key of its lowest position (x first, then y
/// and z).
[[nodiscard]] std::vector<std::uint64_t>
keys_of_components(const Mesh& mesh, const std::vector<Index>& of_face, std::size_t count);

/// Whether face f has exactly zero area: all its corners on one line, decided exactly.
bool is_degenerate(const Mesh& mesh, Index f);
/// Whether three points are on one line, exactly.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

/// For each vertex, how many fans its faces form: faces at a vertex are in one fan when edges at it link
/// them. Isolated vertices have none.
[[nodiscard]] std::vector<Index> fans_at_vertices(const Mesh& mesh, const EdgeTable& edges);

/// The faces that have the same set of vertices as an earlier face, ascending.
[[nodiscard]] std::vector<Index> duplicate_faces(const Mesh& mesh);

} // namespace facetmill
