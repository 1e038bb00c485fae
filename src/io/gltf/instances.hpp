#pragma once
// EXT_mesh_gpu_instancing spelled out: a node for each place.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "io/gltf/json.hpp"

namespace facetmill::io::gltf {

/// Gives each instance of EXT_mesh_gpu_instancing a node of its own, a child of the one that had them all,
/// whose mesh it has. Attributes of instances other than their places are dropped, and said (W-INSTANCING).
/// Throws malformed (E-GLTF), limit (E-MEMORY).
void expand_instances(Json& document, const std::vector<Bytes>& buffers, ReadLog& log);

} // namespace facetmill::io::gltf
