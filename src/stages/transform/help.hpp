#pragma once
// The help and manual texts of transform.

namespace facetmill::help::transform {

inline constexpr const char* about = R"(Moves, rotates and scales parts. Converts units and the up axis.)";

inline constexpr const char* details =
    R"(The operations run in this order, whatever the order of the options: unit and up (of the whole
scene), scale, rotate, matrix, fit, translate, centre, ground. All are in world space: the nodes of
the parts move and their meshes stay as they are, unless bake is on. Faces of a mirrored part keep
their front, as glTF requires. The ground is at 0 along the up axis, or along +Z if the up axis is
unknown. A skinned part is moved in its bind pose and keeps its skin: its skeleton moves along. Cameras and
lights of a glTF file move along if all of its parts do.)";

} // namespace facetmill::help::transform
