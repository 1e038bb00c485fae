#pragma once
// Finds wedges that are equal after rounding.

#include "io/gltf/encode/encode.hpp"

namespace facetmill::io::gltf {

/// Merges wedges of the table with the same position and the same quantised attributes, including morph
/// targets, into the first of them. Triangles and their corners' order stay unchanged, so the file renders
/// the same.
void merge_alike(const Mesh& mesh, Table& table, const std::vector<Column>& columns,
                 const EncodeSettings& settings);

} // namespace facetmill::io::gltf
