#pragma once
// Whether a union left anything to tidy up, by a look at what is new in it.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <vector>

namespace facetmill::clean_steps {

/// Whether the mesh is one of triangles in which no two vertices are at one place, no face has no area or is
/// there twice, each edge has two faces, which run along it both ways, and the faces around each vertex are
/// one fan. False says nothing. The first `uncut` faces, and all around settled vertices (United::settled),
/// is as it was in a mesh whose faces all have area; settled: [vertices], or empty: nothing is known.
///
/// Only faces at vertices that are not settled are looked at, and that is enough. Around a settled vertex v
/// the faces are the ring that they were: one fan, and each edge at v has two faces, which run along it both
/// ways. No face there is there twice: the two would have the same vertex second. So what is not as it should
/// be is at a vertex that is not settled, and all faces of that are looked at.
bool is_tidy(const Mesh& mesh, const std::vector<std::uint8_t>& settled, std::size_t uncut);

} // namespace facetmill::clean_steps
