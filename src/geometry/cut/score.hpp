#pragma once
// Scores a mesh along a plane: faces are cut there, and nothing is taken away.

#include "mesh/cut_memory.hpp"
#include "mesh/provenance.hpp"

#include <cstdint>

namespace facetmill {

/// Which side faces in the plane count to.
enum class FlatSide {
    by_normal, ///< the one that the face looks away from; without area: the back
    front,
    back,
};

struct ScoreSettings {
    Plane plane;                         ///< in the mesh's own space
    std::span<const std::uint8_t> faces; ///< 1 for those that may be cut; empty: all
    FlatSide flat = FlatSide::by_normal;
    double snap = 0; ///< as OnPlane::snap
};

struct ScoreResult {
    Mesh mesh;
    AttributeChanges changes;
    std::vector<Index> source; ///< [faces] the face of the old mesh that each is a piece of
    std::vector<std::int8_t>
        sides; ///< [faces] 1 in front, -1 behind, 0 on both (faces that were not to be cut)
    std::size_t cut_faces = 0, on_plane = 0, snapped = 0, remembered = 0;
};

/// The faces asked for that have vertices strictly on both sides become their pieces, in front first, in
/// their place, as clip would cut them; the others stay, but get the points that are on their edges, so that
/// no crack opens. Vertices and wedges keep their numbers, new ones follow. Attributes as for clip. memory:
/// what is known of points on planes, and what becomes known.
ScoreResult score(const Mesh& mesh, const ScoreSettings& settings, CutMemory& memory);

} // namespace facetmill
