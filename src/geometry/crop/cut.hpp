#pragma once
// Cuts faces at the outline of a footprint. For crop only.

#include "geometry/crop/view.hpp"

namespace facetmill {

/// What the outline does to the faces of a mesh.
struct OutlineCut {
    Mesh mesh;                       ///< the faces in their pieces
    std::vector<std::uint8_t> stays; ///< [faces of mesh]
    std::size_t cut_faces = 0;       ///< of the old mesh
    AttributeChanges changes;        ///< empty: nothing was mixed
};

/// Every face that a segment enters, by more than rounding, is cut along the segment's line, all across the
/// piece; its neighbours get the points. memory: points known to be on planes, and what becomes known.
OutlineCut cut_at_outline(const Mesh& mesh, const CropView& view, CutMemory& memory);

} // namespace facetmill
