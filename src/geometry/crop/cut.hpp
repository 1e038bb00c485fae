#pragma once
// Cuts faces at the outline of a footprint. Only crop uses it.

#include "geometry/crop/view.hpp"

namespace facetmill {

/// The mesh after it is cut at the outline.
struct OutlineCut {
    Mesh mesh;                       ///< the faces, in pieces
    std::vector<std::uint8_t> stays; ///< [faces of mesh]
    std::size_t cut_faces = 0;       ///< in the input mesh
    AttributeChanges changes;        ///< empty: no attribute was interpolated
};

/// Each segment cuts every face that it enters by more than rounding, along its line across the whole piece;
/// neighbours get the points. memory: points known to be on planes; new ones are added.
[[nodiscard]] OutlineCut cut_at_outline(const Mesh& mesh, const CropView& view, CutMemory& memory);

} // namespace facetmill
