#pragma once
// The help and manual texts of orient.

namespace facetmill::help::orient {

inline constexpr const char* about = R"(Makes neighbouring faces consistent and turns their front outward.)";

inline constexpr const char* details =
    R"(Orientation is propagated across edges with exactly two faces; edges with more faces separate the
surface into components. The outside of a closed component is determined by its volume and by how
many closed components it lies in: one inside another is a cavity and faces inward, one inside a
cavity faces outward again. Components that touch or intersect are not cavities of each other. This
is decided exactly, by rays along an axis that never hit an edge. The outside of an open component
is the side from which more rays escape; where both sides are equal (a flat sheet) the component is
only made consistent (W-ORIENT-OPEN). A component that cannot be oriented, such as a Moebius strip,
is left as it was and reported (W-ORIENT).

A part whose node mirrors it is examined in its local space, as glTF requires. The first corner of a
reversed face stays first. Normals that then point against their faces are reversed, and so is the
handedness of their tangents; everything else is kept.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992).)";

} // namespace facetmill::help::orient
