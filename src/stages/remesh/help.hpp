#pragma once
// The help and manual texts of remesh.

namespace facetmill::help::remesh {

inline constexpr const char* about =
    R"(Makes even triangles of a given edge length, or of lengths that follow the curvature.)";

inline constexpr const char* details =
    R"(In each iteration, edges longer than 4/3 of the length are split, and edges shorter than 4/5 are
collapsed.
Then edges are flipped towards six edges at each vertex, and vertices move to even places.

With length, all edges have nearly this length.
With tolerance, strongly curved places get short edges and flat places long ones, so that faces stay
within about this distance of the surface.
The report gives the measured deviation, and W-REMESH-TOLERANCE warns if it is larger.

Every vertex of the result is on the input surface.
Boundaries, sharp edges (feature_angle), seams of attributes and borders of materials are kept.
Their vertices only move along them, and their lines move by at most a 20th of the length.
Vertices where such lines end or meet stay.
Sharp edges in lines shorter than two lengths and than 5% of the diagonal count as noise.
Edges with more than two faces, or with two faces in conflicting directions, are only split.

A closed mesh stays closed, and a manifold mesh stays manifold.
No step turns a face by more than 60 degrees, but parts that are thinner than the length can intersect
afterwards: `validate: {self_intersections: 0}` checks this.

Polygons are triangulated first.
Attributes are interpolated at the nearest points of the input, on the same side of seams.
Face attributes are copied from there.
Seams that only normals make are merged below the feature angle, and flat shading stays flat.
Vertices without faces are removed.

The result has triangles only: quads are not available.

Sources: M. Botsch and L. Kobbelt, 'A remeshing approach to multiresolution modeling' (2004);
M. Dunyach et al., 'Adaptive remeshing for real-time mesh deformation' (2013); D. Cohen-Steiner and
J.-M. Morvan, 'Restricted Delaunay triangulations and normal cycle' (2003).)";

} // namespace facetmill::help::remesh
