#pragma once
// Finds locations where a property fails, for reports and for marked copies of the mesh.

#include "geometry/inspect/inspect.hpp"
#include "mesh/topology.hpp"

#include <functional>

namespace facetmill {

/// A location on a mesh: a face (or none), and a point on it in the mesh's space.
struct Location {
    Index face = none;
    Vec3 at = {};
    Index with = none;      ///< the other face of a pair
    Index attribute = none; ///< the attribute concerned
    /// Identifies the location independently of the numbers and order of faces, corners and vertices. It is
    /// a 64-bit hash of the positions of a face, a pair of faces, an edge or a vertex; for a component, of
    /// its lowest position. 0 and -0 are equal, as are all NaNs.
    std::uint64_t key = 0;
};

/// The options of a location query.
struct LocationQuery {
    std::size_t limit = 10;
    /// Whether a value fails, for properties with a value per face or element. Empty: all values fail.
    std::function<bool(double)> fails = {};
};

/// The first locations that violate a property, in the mesh's own space, in order of edge, face or vertex
/// number. For properties of faces (min_angle): the faces with failing values, the worst first; values are
/// measured in world space. Empty for properties without locations. O(n log n).
[[nodiscard]] std::vector<Location> locations_against(const Mesh& mesh, const Property& property,
                                                      const LocationQuery& query = {});
[[nodiscard]] std::vector<Location> locations_against(const Part& part, const Property& property,
                                                      const LocationQuery& query);

/// Boundary edges connected by their vertices: a loop, or several loops that touch.
struct BoundaryChain {
    std::size_t edges = 0;
    double length = 0;
    Index face = none; ///< the face at the chain's first edge
    Vec3 at;           ///< the middle of this edge
};
/// The chains, sorted by their lowest vertex. O(n log n).
[[nodiscard]] std::vector<BoundaryChain> boundary_chains(const Mesh& mesh);

/// An item of evidence against a property of a scene.
struct Evidence {
    std::string part = {}, material = {};  ///< the part and material concerned; either may be empty
    std::optional<Location> location = {}; ///< its `at` is in world space
    std::string attribute = {};            ///< the attribute concerned
    std::optional<std::size_t> loop = {};  ///< the number of the boundary chain in its part
    BoundaryChain chain = {};              ///< the boundary chain
    std::optional<double> amount = {};     ///< the part's contribution, if there is no location
};

struct EvidenceQuery {
    const Property& property;
    std::function<bool(double)> fails = {};
    Box within = {}; ///< for a box: the required bounds
    std::size_t limit = 10;
};

/// The first evidence, found as the property's row defines.
[[nodiscard]] std::vector<Evidence> evidence_against(const Scene& scene, const EvidenceQuery& query);

/// The location of face f, at the mean of its corners.
[[nodiscard]] Location location_of(const Mesh& mesh, Index f);
/// The location as evidence, converted to world space.
[[nodiscard]] Evidence evidence_of(const Part& part, Location location);

/// [of_face's numbers below count] The key of each component: the key of its lowest position (x first, then y
/// and z).
[[nodiscard]] std::vector<std::uint64_t>
keys_of_components(const Mesh& mesh, const std::vector<Index>& of_face, std::size_t count);

/// Whether face f has exactly zero area, because all its corners are collinear. Exact.
bool is_degenerate(const Mesh& mesh, Index f);
/// Whether three points are collinear. Exact.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

/// [vertices] The number of fans that the vertex's faces form. Faces are in the same fan if edges at the
/// vertex link them. 0 for isolated vertices.
[[nodiscard]] std::vector<Index> fans_at_vertices(const Mesh& mesh, const EdgeTable& edges);

/// The faces that have the same set of vertices as an earlier face, ascending.
[[nodiscard]] std::vector<Index> duplicate_faces(const Mesh& mesh);

} // namespace facetmill
