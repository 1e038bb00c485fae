#pragma once
// Scores a mesh along a plane: faces are cut, and all pieces stay.

#include "geometry/cut/cut.hpp"
#include "mesh/cut_memory.hpp"
#include "mesh/provenance.hpp"

#include <cstdint>

namespace facetmill {

/// The side to which faces in the plane belong.
enum class FlatSide {
    by_normal, ///< the side that the face's normal points away from; the back for faces without area
    front,
    back,
};

struct ScoreSettings {
    Plane plane;                         ///< in the mesh's own space
    std::span<const std::uint8_t> faces; ///< 1 if the face may be cut; empty: all
    FlatSide flat = FlatSide::by_normal;
    CoordinateErrors snap = {}; ///< as OnPlane::snap
};

struct ScoreResult {
    Mesh mesh;
    AttributeChanges changes;
    std::vector<Index> source;      ///< [faces] source face in the old mesh
    std::vector<std::int8_t> sides; ///< [faces] 1 in front, -1 on the back, 0 on both (excluded faces)
    std::size_t cut_faces = 0, on_plane = 0, snapped = 0, remembered = 0;
};

/// Replaces each selected face with vertices strictly on both sides by its pieces, front first, cut as clip
/// does. Other faces stay, but gain the points on their edges, so that no crack opens. Vertices and wedges
/// keep their numbers; new elements follow. Attributes follow the rules of clip. memory: known points on
/// planes, which it updates.
[[nodiscard]] ScoreResult score(const Mesh& mesh, const ScoreSettings& settings, CutMemory& memory);

} // namespace facetmill
