#pragma once
// The help and manual texts of wrap.

namespace facetmill::help::wrap {

inline constexpr const char* about = R"(Wraps a closed surface around anything: soup, open sheets, points.)";

inline constexpr const char* details =
    R"(The wrap enters no gap that is narrower than alpha, and stays at the distance offset from the input.
Smaller values give more detail and more faces. Half the alpha gives about four times as many faces, and
takes about four times as long.
Any input works: open sheets, crossing and duplicate faces, faces without area, shells inside others.
Sheets get two sides. Cavities and shells that cannot be reached from outside disappear.
Parts without faces are wrapped by their lines or points. To wrap several parts together, use merge first.

Exact predicates test the result before it is used. It is closed, oriented and manifold.
No two of its faces intersect. No face meets the input, and every point of the input is inside.
If a test fails, the stage fails (E-WRAP).

The stage first estimates the number of faces. If it is far above max_faces, the stage fails at once
(E-WRAP-LARGE).

By default, the wrap has no attributes. With attributes: nearest, it takes colours, weights and other
numbers from the nearest point of the input.
Each face then takes the material of the input face that is nearest to its centre.
Texture coordinates, normals, tangents and morph targets are dropped.

Source: P. Alliez, D. Cohen-Steiner, M. Hemmer, C. Portaneri and M. Rouxel-Labbe, 'Alpha wrapping with an
offset' (2022).)";

} // namespace facetmill::help::wrap
