#pragma once
// Sets the attributes of caps for the stages that cap, and recognises caps by these attributes.

#include "mesh/mesh.hpp"
#include "mesh/plane.hpp"

namespace facetmill {

/// The face attributes that number caps.
inline constexpr std::string_view cut_id_attribute = "cut_id", group_attribute = "group";

/// The attributes of the faces of a cap.
struct CapPaint {
    std::optional<Primitive> primitive; ///< empty: primitive 0
    Index cut_id = 0, group = 0;        ///< 0: these attributes are not made
};

/// The largest number in a face attribute; 0 without it.
[[nodiscard]] Index largest_number(const Mesh& mesh, std::string_view name);

/// [faces] 1 if the face closes a cut with a number above `last`; empty: no such face. Faces that a boolean
/// operation took from another part also have such a number, but no group; they are not caps.
[[nodiscard]] std::vector<std::uint8_t> later_caps(const Mesh& mesh, Index last);

/// Whether a cap needs its own wedges: for normals, tangents or texture coordinates.
bool caps_have_own_wedges(const Mesh& mesh);

/// The sum of the area vectors of the triangles.
[[nodiscard]] Vec3 area_of_triangles(const Mesh& mesh, Index first_corner, Index last_corner);

/// The faces from `first` to before `last`.
struct FaceRange {
    std::size_t first = 0, last = 0;
};

/// Sets the attributes of a cap: face attributes, and the normals, tangents and first texture coordinates of
/// wedges (empty: the cap shares the walls' wedges). The plane's normal points outward. Texture coordinates
/// are planar, scaled so that the cap's larger extent is 1.
void paint_cap(Mesh& mesh, FaceRange faces, std::span<const Index> wedges, const Plane& plane,
               const CapPaint& paint);

} // namespace facetmill
