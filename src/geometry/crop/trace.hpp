#pragma once
// Finds elements of two meshes that were the same element before each mesh was changed.

#include "mesh/provenance.hpp"

namespace facetmill {

/// The name of the attributes with the numbers. They are never interpolated: a new element has the number of
/// its first parent, but another position.
inline constexpr std::string_view trace_attribute = "#trace";

/// Numbers all vertices and wedges from 0. attribute: where the numbers are stored; use another name for a
/// mesh that is already traced.
void trace(Mesh& mesh, std::string_view attribute = trace_attribute);
/// Removes the numbers.
void untrace(Mesh& mesh, std::string_view attribute = trace_attribute);

/// The listed faces in that order, with the vertices, wedges and attributes that they use.
[[nodiscard]] Mesh select_faces(const Mesh& mesh, std::span<const Index> faces);

/// Joins both meshes, b's faces after a's. Merges vertices with the same number and position, and wedges
/// with the same number at such vertices. Both must be traced, and the result is traced too.
[[nodiscard]] Mesh join_traced(Mesh a, const Mesh& b, std::string_view attribute = trace_attribute);

} // namespace facetmill
