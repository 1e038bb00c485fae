#pragma once
// Triangles of a solid, shell or loose faces.

#include "helper.hpp"

#include <TopoDS_Shape.hxx>
#include <map>

namespace importers {

/// The triangles of the faces of one colour.
struct FaceGroup {
    std::vector<float> positions, normals, faces; ///< faces: the number of the face of the solid
    std::vector<std::uint32_t> corners;
};

/// [material] the groups of the shape, which has been triangulated. Points of an edge that several faces
/// share are equal, so exact welding joins the faces. material: the material of a face.
[[nodiscard]] std::map<int, FaceGroup>
groups_of(const TopoDS_Shape& shape, const std::function<int(const TopoDS_Shape&)>& material, Notes& notes);

/// The greatest distance between the shape and its triangles, at the middles of triangles and of their sides.
[[nodiscard]] double deviation_of(const TopoDS_Shape& shape);

} // namespace importers
