#pragma once
// Wedges that are the same once their attributes are rounded.

#include "io/gltf/encode/encode.hpp"

namespace facetmill::io::gltf {

/// Makes one of the table's wedges that stand at one position and whose attributes, morph targets among them,
/// have the same bytes when they are quantised; the first of them stays. The triangles and their corners'
/// order stay what they are, and the file shows what it would have shown with all of them.
void merge_alike(const Mesh& mesh, Table& table, const std::vector<Column>& columns,
                 const EncodeSettings& settings);

} // namespace facetmill::io::gltf
