#pragma once
// Puts one side of a cut together: kept faces, pieces, cap, attributes. For clip only.

#include "geometry/cap.hpp"
#include "geometry/clip.hpp"

namespace facetmill {

struct ClippedSide {
    Mesh mesh;
    Fates fates;
};

/// The face attributes that number caps.
inline constexpr std::string_view cut_id_attribute = "cut_id", group_attribute = "group";

/// What the faces of a cap get.
struct CapPaint {
    std::optional<Primitive> primitive; ///< none: primitive 0
    Index cut_id = 0, group = 0;        ///< 0: these attributes are not made
};

/// side: 1 front, -1 back. Expects flat faces settled.
ClippedSide assemble(const PlaneCut& cut, int side, const Pieces& pieces, const Cap& cap,
                     const CapPaint& paint);

/// Sets the attributes that a cap has of its own: the face attributes of faces from first_face on, and the
/// normals, tangents and first texture coordinates of wedges (empty: the cap shares the walls').
void paint_cap(Mesh& mesh, std::size_t first_face, std::span<const Index> wedges, const Plane& plane,
               const CapPaint& paint);

} // namespace facetmill
