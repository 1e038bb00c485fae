#pragma once
// Attribute and corner helpers of the codecs: roles by name, conversion between array types, finite values,
// and wedges. Wedges come from corners that name a vertex and a key, which identifies the texture point and
// the normal. Corners with the same vertex and key share a wedge.

#include "io/codec.hpp"
#include "mesh/mesh.hpp"

#include <cstdint>
#include <map>
#include <span>

namespace facetmill::io {

/// The face attribute with the attribute bytes of an STL that are no colours.
inline constexpr const char* stl_attribute = "attribute";

/// The role that glTF gives the name (NORMAL, TANGENT, TEXCOORD_n, COLOR_n, JOINTS_n, WEIGHTS_n), if
/// components and type fit it. Otherwise integers of 16 bits and more are identifiers (Role::index) and
/// other numbers are generic.
[[nodiscard]] Role role_of(const std::string& name, int components, const AttributeData& data);

/// Adds the attribute under a unique name: "quality_2" if the domain already has a "quality". Names that the
/// mesh reserves ("primitive") are changed too.
void add_attribute(Mesh& mesh, Attribute attribute);

/// The elements, of three components each, as vectors. Parallel.
[[nodiscard]] std::vector<Vec3> to_vectors(const Attribute& attribute);

/// Gives the wedges after the first `vertices` the values of their vertices.
void extend_to_wedges(Attribute& attribute, std::span<const Index> wedge_vertex, std::size_t vertices);

/// The attribute with only the elements [kept], in that order.
[[nodiscard]] Attribute selected(const Attribute& attribute, std::span<const Index> kept);

/// NaN marks a missing value in generic attributes and stays; infinite values become NaN. In attributes that
/// draw or move a surface, values that are not finite become 0. Warns of the changes (W-NAN).
void fix_attributes(Part& part, const std::string& file, ReadLog& log);

/// The number of NaN values by attribute name.
using NanCounts = std::map<std::string, std::size_t>;
/// Sets NaN attribute values to 0, for formats that cannot hold them.
NanCounts zero_nan(Mesh& mesh);
/// NaN values in attributes that primitives have, for formats that write attributes per primitive.
[[nodiscard]] NanCounts nan_of_primitives(const Mesh& mesh);
bool has_nan(const Mesh& mesh);
/// Warns (W-NAN) of values that the format cannot hold.
void warn_of_nan(const NanCounts& counts, const char* format, std::vector<Diagnostic>& warnings);

/// Drops faces of fewer than three corners (face attributes follow) and warns (W-FACES).
void drop_short_faces(Mesh& mesh, const std::string& file, ReadLog& log);

/// Whether faces have colours (COLOR_0), and wedges have none.
bool has_colours_of_faces_only(const Mesh& mesh);
/// Moves them to wedges, for a format without attributes of faces. Wedges between faces of different colours
/// split. Does nothing if there are none.
void move_colours_to_wedges(Mesh& mesh);

inline constexpr std::uint64_t no_key = UINT64_MAX;

struct Wedges {
    std::vector<Index> corners;      ///< [corners] wedges
    std::vector<Index> wedge_vertex; ///< [wedges] vertices; empty without seams
    std::vector<std::uint64_t> keys; ///< [wedges] keys; no_key for vertices that no corner uses
};

/// Wedge v is the first wedge of vertex v; further wedges follow in the order of their first corner.
/// O(corners).
[[nodiscard]] Wedges make_wedges(std::size_t vertices, std::vector<Index> corner_vertex,
                                 std::span<const std::uint64_t> corner_key);

} // namespace facetmill::io
