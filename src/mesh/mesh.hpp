#pragma once
// The mesh that flows from stage to stage: a plain value of flat arrays with three index levels.
//
//   corner --corners[c]--> wedge --wedge_vertex[w]--> vertex --positions[v]--> point face f
//   --face_offsets[f] .. face_offsets[f+1]--> its corners, in order line l --lines[2 l], lines[2 l + 1]-->
//   its two ends, which are wedges; a mesh has faces, or lines, or neither
//
// Topology is defined by vertices: two faces are neighbours if they share two vertices, regardless of their
// wedges. A wedge is one attribute tuple at a vertex (a vertex in glTF): a UV seam is a vertex with two
// wedges. Open, non-manifold, flipped, degenerate and self-intersecting meshes are all representable; see
// mesh/topology.hpp for derived data and mesh/invariants.hpp for the invariants.

#include "base/math/vec.hpp"
#include "mesh/attribute_changes.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

using Index = std::uint32_t;
inline constexpr Index none = UINT32_MAX;

/// An entry of the table that the face attribute "primitive" indexes: a glTF primitive. Faces of one glTF
/// mesh are merged for geometry, and separated again by primitive on writing.
struct Primitive {
    Index material = none;               ///< index in Scene::materials
    std::vector<std::string> attributes; ///< names of its wedge attributes; empty: all
    std::string json;                    ///< the source's extras and extensions (a JSON object), or empty

    /// Whether `attributes` lists the attribute explicitly; an empty list means all.
    bool lists(std::string_view attribute) const {
        return std::find(attributes.begin(), attributes.end(), attribute) != attributes.end();
    }
    /// Whether it has the wedge attribute, if the mesh has it.
    bool has(std::string_view attribute) const { return attributes.empty() || lists(attribute); }
    bool operator==(const Primitive&) const = default;
};

/// See the head of this file. Meshes are moved, not shared; only small meshes are cheap to copy.
struct Mesh {
    std::vector<Vec3> positions;     ///< [vertices] positions
    std::vector<Index> wedge_vertex; ///< [wedges] vertices; empty: wedge w is vertex w
    std::vector<Index> corners;      ///< [corners] wedges, face by face
    std::vector<Index> face_offsets; ///< [faces + 1] offsets into corners; empty: all faces are triangles
    std::vector<Attribute> attributes;
    std::vector<Primitive>
        primitives; ///< empty: a single primitive without material; otherwise the face attribute "primitive"
                    ///< indexes this (if absent, all faces use primitive 0)
    std::vector<Index> lines;          ///< [2 * lines] wedges: straight lines, in a mesh without faces
    std::vector<Index> line_primitive; ///< [lines] primitives; empty: all lines use primitive 0

    std::size_t vertex_count() const { return positions.size(); }
    std::size_t wedge_count() const { return wedge_vertex.empty() ? positions.size() : wedge_vertex.size(); }
    std::size_t corner_count() const { return corners.size(); }
    std::size_t face_count() const {
        return face_offsets.empty() ? corners.size() / 3 : face_offsets.size() - 1;
    }
    std::size_t line_count() const { return lines.size() / 2; }
    std::size_t count(Domain domain) const;

    bool all_triangles() const { return face_offsets.empty(); }
    bool has_seams() const { return !wedge_vertex.empty(); }

    Index face_begin(Index f) const { return face_offsets.empty() ? 3 * f : face_offsets[f]; }
    Index face_end(Index f) const { return face_offsets.empty() ? 3 * f + 3 : face_offsets[f + 1]; }
    Index face_size(Index f) const { return face_end(f) - face_begin(f); }
    /// The wedges of a face, in order.
    std::span<const Index> face_wedges(Index f) const {
        return {corners.data() + face_begin(f), corners.data() + face_end(f)};
    }
    Index vertex_of_wedge(Index w) const { return wedge_vertex.empty() ? w : wedge_vertex[w]; }
    Index vertex(Index corner) const { return vertex_of_wedge(corners[corner]); }
    const Vec3& point(Index corner) const { return positions[vertex(corner)]; }

    const Attribute* find(std::string_view name, Domain domain) const;
    Attribute* find(std::string_view name, Domain domain);
    /// Removes the attribute. Returns false if it does not exist.
    bool drop(std::string_view name, Domain domain);
    /// The index of the primitive of face f.
    Index primitive_of(Index f) const;
    /// The index of the primitive of line l.
    Index primitive_of_line(std::size_t l) const { return line_primitive.empty() ? 0 : line_primitive[l]; }

    Box bounds() const; ///< the box of all positions
};

/// The box around points, in parallel.
[[nodiscard]] Box box_of(std::span<const Vec3> points);

/// The name of the face attribute (Role::index, uint32, 1 component) that indexes Mesh::primitives.
inline constexpr std::string_view primitive_attribute = "primitive";

/// Appends a face given by its wedges. Keeps face_offsets empty while all faces are triangles.
void add_face(Mesh& mesh, std::span<const Index> wedges);

/// Removes face_offsets if all faces are triangles (the canonical form of an all-triangle mesh).
void normalise_offsets(Mesh& mesh);

/// Removes wedge_vertex if every wedge is its vertex (the canonical form of a mesh without seams).
void normalise_wedges(Mesh& mesh);

/// Drops vertices and wedges that no face and no line uses. Attributes follow.
void drop_unused(Mesh& mesh);
/// Drops unused vertices and wedges only among the marked vertices. marked: [vertices].
void drop_unused(Mesh& mesh, std::span<const std::uint8_t> marked);

/// Merges vertices at exactly the same position (-0 is 0); wedges stay separate, so attributes survive.
/// Vertices keep the order of their first occurrence. All faces stay, even degenerate faces. Returns the
/// number of removed vertices.
std::size_t weld_exact(Mesh& mesh);

/// The mesh with every face of four or more corners cut into triangles. Quads are cut along the shorter
/// diagonal (ties: the diagonal at the first corner). Larger faces become a fan if they are convex from some
/// corner; otherwise ears are clipped in the plane of the polygon's normal. Face attributes are copied, and
/// wedges are unchanged. Faces with fewer than three corners are dropped. The stage triangulate has more
/// methods.
[[nodiscard]] Mesh triangulated(const Mesh& mesh);

/// Appends b to a: vertices, wedges, faces, lines, primitives. If only one has an attribute, see append.cpp.
void append(Mesh& a, const Mesh& b);

/// Sets wedge attribute NORMAL, if present, to the area-weighted normal over the faces that meet at the
/// wedge's vertex and share its normal direction group. Wedges separated by a normal seam stay separate.
/// Returns the change of the attribute, or none if the mesh has no normals.
std::optional<AttributeChange> recompute_normals(Mesh& mesh);

/// Applies t to positions, normals, tangents and morph vectors; flips faces if t mirrors.
void apply(Mesh& mesh, const Transform& t);

} // namespace facetmill

// Compiled once, in instantiated.cpp.
extern template class std::vector<facetmill::Attribute>;
extern template class std::vector<facetmill::Primitive>;
