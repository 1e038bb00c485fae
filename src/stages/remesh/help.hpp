#pragma once
// The help and manual texts of remesh.

namespace facetmill::help::remesh {

inline constexpr const char* about =
    R"(Makes even triangles of a given edge length, or of lengths that follow the curvature.)";

inline constexpr const char* details =
    R"(In each iteration, edges longer than 4/3 of the length are split, and edges shorter than 4/5 are
collapsed.
Then edges are flipped so that most vertices get six edges, and vertices move to make triangles even.

With length, all edges have nearly this length.
With tolerance, strongly curved areas get short edges, and flat areas get long edges.
Faces then stay within about this distance of the surface.
The report gives the measured deviation, and W-REMESH-TOLERANCE warns if it is larger.

Every vertex of the result is on the input surface.
Boundaries, sharp edges (feature_angle), seams of attributes and borders of materials are kept.
Their vertices only move along such a line, and the line moves by at most a 20th of the length.
Vertices where such lines end or meet do not move.
A line of sharp edges counts as noise if it is shorter than twice the length and shorter than 5% of the
diagonal.
Edges with more than two faces, or with two faces in conflicting directions, are split and not otherwise
changed.

A closed mesh stays closed, and a manifold mesh stays manifold.
No step turns a face by more than 60 degrees.
Walls and gaps that are thinner than the length can make faces intersect.
If no faces of the input intersect, the stage then starts again with half the length near these faces.
After three retries, W-REMESH-INTERSECTS warns about faces that still intersect.

Polygons are triangulated first.
Attributes are interpolated at the nearest points of the input, on the same side of seams.
Face attributes are copied from the nearest faces.
Seams where only normals differ are merged if the edge is not sharper than feature_angle.
Flat shading stays flat.
Vertices without faces are removed.

The result has triangles only: quads are not available.

Sources: M. Botsch and L. Kobbelt, 'A remeshing approach to multiresolution modeling' (2004);
M. Dunyach et al., 'Adaptive remeshing for real-time mesh deformation' (2013); D. Cohen-Steiner and
J.-M. Morvan, 'Restricted Delaunay triangulations and normal cycle' (2003).)";

} // namespace facetmill::help::remesh
