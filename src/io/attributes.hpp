#pragma once
// What codecs share about attributes: roles by name, numbers from one array type to another, finite values.

#include "io/codec.hpp"

namespace facetmill::io {

/// The role that glTF gives the name (NORMAL, TANGENT, TEXCOORD_n, COLOR_n, JOINTS_n, WEIGHTS_n) when
/// components and type fit it. Else integers of 16 bits and more are identifiers (Role::index), other numbers
/// generic.
Role role_of(const std::string& name, int components, const AttributeData& data);

/// Adds the attribute, under a name of its own: "quality_2" when there is a quality already in that domain,
/// and another name than those that the mesh keeps for itself ("primitive").
void add_attribute(Mesh& mesh, Attribute attribute);

/// Gives the wedges behind the first `vertices` the values of the vertex they are at.
void extend_to_wedges(Attribute& attribute, std::span<const Index> wedge_vertex, std::size_t vertices);

/// The attribute with the elements [kept] only, in that order.
Attribute selected(const Attribute& attribute, std::span<const Index> kept);

/// Replaces attribute values that are not finite by 0, since no format and no stage can use them, and warns
/// (W-NAN).
void mend_attributes(Part& part, const std::string& file, ReadLog& log);

/// Drops faces of fewer than three corners (face attributes follow) and warns (W-FACES).
void drop_short_faces(Mesh& mesh, const std::string& file, ReadLog& log);

} // namespace facetmill::io
