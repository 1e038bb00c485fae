#pragma once
// The help and manual texts of orient.

namespace facetmill::help::orient {

inline constexpr const char* about = R"(Makes neighbouring faces consistent and turns their front outward.)";

inline constexpr const char* details =
    R"(Orientation spreads across edges with exactly two faces.
Edges with more faces divide the surface into components.

For a closed component, the outside follows from its volume and from the number of closed components
around it.
A component inside another is a cavity and faces inward.
A component inside a cavity faces outward again.
Components that touch or intersect are not cavities of each other.
These decisions are exact. They use rays along an axis, and these rays never hit an edge.

For an open component, the outside is the side from which more rays escape.
If both sides are equal, as for a flat sheet, the component is only made consistent (W-ORIENT-OPEN).
A component that cannot be oriented, such as a Moebius strip, stays unchanged and is reported
(W-ORIENT).

A part whose node mirrors it is oriented in its local space, as glTF requires.
The first corner of a reversed face stays first.
Normals that then point against their faces are reversed, and so is the handedness of their
tangents.
All other data is kept.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992).)";

} // namespace facetmill::help::orient
