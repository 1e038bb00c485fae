#pragma once
// The help and manual texts of normals.

namespace facetmill::help::normals {

inline constexpr const char* about =
    R"(Computes normals and tangents, and repairs normals, tangents and joint weights.)";

inline constexpr const char* details =
    R"(The method sets how the normals of a vertex are computed from its faces.
Faces share a normal if their edge is not sharper than feature_angle.
At sharper edges, the corners of a vertex get separate normals.
With `with`, each corner gets the interpolated normal at the nearest point of another mesh.
This makes a simplified mesh look like the original.

tangents computes the tangents that viewers and baking programs expect (MikkTSpace).
It needs normals and texture coordinates, and cuts polygons into triangles.

With every method, the stage then repairs values that glTF does not accept.
Normals and tangents get length 1, and the sign of tangents becomes 1 or -1.
A normal without a direction gets the mean of its faces.
Joint weights get the sum 1, negative weights become 0, and repeated joints of a vertex are merged.
With normals: keep, it makes only these repairs.

Positions and faces do not change.
All other attributes are kept.

Sources: G. Thuermer and C. Wuethrich, 'Computing vertex normals from polygonal facets' (1998);
M. S. Mikkelsen, 'Simulation of Wrinkled Surfaces Revisited' (2008).)";

} // namespace facetmill::help::normals
