#pragma once
// The help and manual texts of transfer.

namespace facetmill::help::transfer {

inline constexpr const char* about =
    R"(Takes attributes from another mesh: texture coordinates, colours, skin weights and others.)";

inline constexpr const char* details =
    R"(Each vertex, corner and face gets the interpolated value at the nearest point of the other mesh.
Both meshes must be at the same position, so use align before if necessary.
Corners on a seam of the scene get the value of their own side.

By default, transfer takes all attributes except normals, tangents, morph targets and materials.
Use normals: {with: ...} to take normals.
Existing attributes of the same name are replaced.
The vertex attribute `distance` stores the distance of each vertex from the other mesh, in scene units.
To see it, use render: {attribute: distance}.

A face that crosses a seam of the other mesh mixes values from both sides.
W-TRANSFER-SEAMS counts such faces.
To avoid them, cut the scene along the same seams first.
Joint numbers refer to the skin of the other file, so the scene needs the same skin (W-TRANSFER-SKIN).)";

} // namespace facetmill::help::transfer
