#pragma once
// Where a property fails: the places that a person (or a marked copy of the mesh) is shown.

#include "mesh/topology.hpp"

namespace facetmill {

/// A place on a mesh: a face (or none), and a point of it in the mesh's space.
struct Place {
    Index face = none;
    Vec3 at;
    Index with = none;      ///< the other face of a pair
    Index attribute = none; ///< the mesh's attribute that it is about
    /// What it is, whatever the numbers and the order of faces, corners and vertices: a hash of the positions
    /// that it is about (of a face, a pair of faces, an edge, a vertex; of a piece its lowest position).
    std::uint64_t key = 0;
};

/// The first places, in order of edge, face or vertex number, that keep the property (a name of
/// property_table) from holding as a sound mesh has it: for closed, boundary_edges and boundary_loops the
/// edges whose directions do not cancel; for edge_manifold edges with more than two faces; for oriented edges
/// that two faces run along the same way; for vertex_manifold vertices of several fans; for degenerate_faces,
/// duplicate_faces and isolated_vertices these themselves; for self_intersections and touching the faces of
/// each pair, in the middle of the lower one; for euler as for edge_manifold and vertex_manifold; for
/// components the first face of each. Empty for properties that are not about places. O(n log n).
std::vector<Place> places_against(const Mesh& mesh, std::string_view property, std::size_t limit = 10);

/// Face f, in the middle of its corners.
Place place_of(const Mesh& mesh, Index f);
/// The first pairs of faces, in the middle of the first of each.
std::vector<Place> places_of_pairs(const Mesh& mesh, const std::vector<std::pair<Index, Index>>& pairs,
                                   std::size_t limit);

/// Whether face f has exactly zero area: all its corners on one line, decided exactly.
bool is_degenerate(const Mesh& mesh, Index f);
/// Whether three points are on one line, exactly.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

/// For each vertex, how many fans its faces form: faces at a vertex are in one fan when edges at it link
/// them. Isolated vertices have none.
std::vector<Index> fans_at_vertices(const Mesh& mesh, const EdgeTable& edges);

/// The faces that have the same set of vertices as an earlier face, ascending.
std::vector<Index> duplicate_faces(const Mesh& mesh);

} // namespace facetmill
