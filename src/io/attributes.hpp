#pragma once
// What codecs share about attributes and corners: roles by name, numbers from one array type to another,
// finite values, and wedges from corners that name a vertex and a key (what else the corner has: indices of a
// texture point and a normal): corners that agree in both share one.

#include "io/codec.hpp"
#include "mesh/mesh.hpp"

#include <cstdint>
#include <map>
#include <span>

namespace facetmill::io {

/// The role that glTF gives the name (NORMAL, TANGENT, TEXCOORD_n, COLOR_n, JOINTS_n, WEIGHTS_n) when
/// components and type fit it. Else integers of 16 bits and more are identifiers (Role::index), other numbers
/// generic.
Role role_of(const std::string& name, int components, const AttributeData& data);

/// Adds the attribute, under a name of its own: "quality_2" when there is a quality already in that domain,
/// and another name than those that the mesh keeps for itself ("primitive").
void add_attribute(Mesh& mesh, Attribute attribute);

/// The elements of three components as vectors, in parallel.
std::vector<Vec3> to_vectors(const Attribute& attribute);

/// Gives the wedges behind the first `vertices` the values of the vertex they are at.
void extend_to_wedges(Attribute& attribute, std::span<const Index> wedge_vertex, std::size_t vertices);

/// The attribute with the elements [kept] only, in that order.
Attribute selected(const Attribute& attribute, std::span<const Index> kept);

/// Values that are no number (NaN) say of generic attributes that there is none, and stay; infinite ones
/// become so, too. In attributes that draw or move a surface what is not finite becomes 0. Warns of what
/// changes (W-NAN).
void fix_attributes(Part& part, const std::string& file, ReadLog& log);

/// How many values there were, by the name of the attribute.
using NanCounts = std::map<std::string, std::size_t>;
/// Sets attribute values that are no number to 0, for formats that cannot hold them.
NanCounts zero_nan(Mesh& mesh);
/// Those of them that a format gets which writes of each primitive the attributes that it has.
NanCounts nan_of_primitives(const Mesh& mesh);
bool has_nan(const Mesh& mesh);
/// Warns (W-NAN) of values that the format cannot hold.
void warn_of_nan(const NanCounts& counts, const char* format, std::vector<Diagnostic>& warnings);

/// Drops faces of fewer than three corners (face attributes follow) and warns (W-FACES).
void drop_short_faces(Mesh& mesh, const std::string& file, ReadLog& log);

inline constexpr std::uint64_t no_key = UINT64_MAX;

struct Wedges {
    std::vector<Index> corners;      ///< [corners] -> wedge
    std::vector<Index> wedge_vertex; ///< [wedges] -> vertex; empty when there are no seams
    std::vector<std::uint64_t> keys; ///< [wedges]; no_key for vertices that no corner uses
};

/// Wedge v is the first one of vertex v; further ones follow in the order of their first corner. O(corners).
Wedges make_wedges(std::size_t vertices, std::vector<Index> corner_vertex,
                   std::span<const std::uint64_t> corner_key);

} // namespace facetmill::io
