#pragma once
// Cuts faces at the outline of a footprint. Only crop uses it.

#include "geometry/crop/view.hpp"

namespace facetmill {

/// The mesh after it is cut at the outline.
struct OutlineCut {
    Mesh mesh;                       ///< the mesh of the pieces
    std::vector<std::uint8_t> stays; ///< [faces of mesh] 1 for faces on the kept side
    std::size_t cut_faces = 0;       ///< the number of faces of the input that were cut
    AttributeChanges changes;        ///< empty if no attribute was interpolated
};

/// Each segment cuts every face that it enters by more than rounding, along its line across the whole piece.
/// Neighbours get the new points. memory: points known to be on planes; new ones are added.
[[nodiscard]] OutlineCut cut_at_outline(const Mesh& mesh, const CropView& view, CutMemory& memory);

} // namespace facetmill
