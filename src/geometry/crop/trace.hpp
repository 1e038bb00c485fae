#pragma once
// Tells which elements of two meshes were one before something was done to each of them.

#include "mesh/provenance.hpp"

namespace facetmill {

/// The name of the attributes that hold the numbers. They are never mixed: what is made new has the number of
/// its first parent, but stands elsewhere.
inline constexpr std::string_view trace_attribute = "#trace";

/// Numbers all vertices and wedges from 0. attribute: where the numbers are kept; another one traces what is
/// traced already.
void trace(Mesh& mesh, std::string_view attribute = trace_attribute);
/// Removes the numbers.
void untrace(Mesh& mesh, std::string_view attribute = trace_attribute);

/// The faces in that order, and what they use. Attributes follow.
Mesh select_faces(const Mesh& mesh, std::span<const Index> faces);

/// Both meshes in one, b's faces behind a's. Vertices with the same number at the same place are one, and so
/// are wedges with the same number at them. Both are traced; the result still is.
Mesh join_traced(Mesh a, const Mesh& b, std::string_view attribute = trace_attribute);

} // namespace facetmill
