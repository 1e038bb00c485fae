#pragma once
// Faces that cross themselves, into triangles that cover what is inside.

#include "mesh/surface.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace facetmill {

/// Of a planar polygon whose outline crosses itself: triangles over what the outline winds around, each point
/// once (nonzero rule), that all turn the way that its normal says. None of any other polygon, at little more
/// than the cost of seeing whether it is convex.
std::vector<std::array<Vec3, 3>> covering_triangles(std::span<const Vec3> corners);

/// The area of a polygon: of what it winds around when it crosses itself in its plane (covering_triangles),
/// else the length of its area vector. O(n) for convex and small ones, else O(n log n).
double covered_area(std::span<const Vec3> corners);

struct CrossingFaces {
    std::optional<Mesh> mesh;    ///< none: no face was to be filled
    AttributeChanges changes;    ///< of mesh
    std::size_t filled = 0;      ///< faces that became triangles
    std::size_t overlapping = 0; ///< among them, those whose triangles lie over each other
    /// Faces of five or more corners that cross themselves in no plane (seen along the axis nearest to their
    /// normal), and those that could not be filled: their triangles may overlap.
    std::size_t fans = 0;
};

/// Faces whose outline crosses or touches itself in its plane become triangles that cover what it winds
/// around (nonzero rule), and face the other way where it winds clockwise. The even-odd rule would leave a
/// hole where a face lies over itself, which drawings and the union of solids do not have. Where an outline
/// crosses itself there is a new vertex, interpolated along the edges, on all faces along them; so what was
/// closed stays closed, and other faces may get corners more. What the outline winds around several times is
/// covered once when the face has no neighbours; else as many times, since the surface would be open
/// otherwise (overlapping). Constrained Delaunay, exact. Only planar faces are filled (within a millionth of
/// their perimeter, as in face_kinds). Faces that cannot be filled so (whose crossings round to other
/// crossings) stay as they are. Each face is looked at once where none is filled; no face of three corners
/// is.
CrossingFaces fill_crossing_faces(const Mesh& mesh);

/// CrossingFaces::fans, without the mesh.
std::size_t count_fans(const Mesh& mesh);

/// triangulated, after fill_crossing_faces: the triangles that a file or a picture shows.
Mesh triangles_of(const Mesh& mesh);

/// surface_of, after fill_crossing_faces: what the faces cover, for distances, rays and samples. New vertices
/// follow those of the mesh.
Surface filled_surface(const Mesh& mesh);

} // namespace facetmill
