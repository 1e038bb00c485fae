#pragma once
// Decides whether a union needs tidying, by checking only its new parts.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <vector>

namespace facetmill::clean_steps {

/// True if the mesh is a triangle mesh with distinct vertex positions, without zero-area or double faces.
/// Each edge must have two faces in opposite directions, and the faces around each vertex must form one fan.
/// False proves nothing.
///
/// The first `uncut` faces, and all faces around settled vertices (United::settled), must be unchanged from a
/// mesh whose faces all have area. settled: [vertices], or empty: unknown.
///
/// It is enough to check the faces at unsettled vertices. A settled vertex v has its original ring of faces.
/// The ring is one fan, and each edge at v has two faces in opposite directions. It has no double face,
/// because two equal faces would have the same second vertex. So any defect is at an unsettled vertex, and
/// all faces there are checked.
bool is_tidy(const Mesh& mesh, const std::vector<std::uint8_t>& settled, std::size_t uncut);

} // namespace facetmill::clean_steps
