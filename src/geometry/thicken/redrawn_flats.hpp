#pragma once
// Flat parts of a surface that turn over in their plane while it moves, triangulated again.

#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace facetmill {

/// The positions after a move by a distance. ways: [vertices] the move for a distance of 1.
[[nodiscard]] std::vector<Vec3> moved_positions(const Mesh& surface, const std::vector<Vec3>& ways,
                                                double distance);

/// Other triangles for the faces of flat patches. A patch is a set of neighbours in one plane, with equal
/// face attributes and without seams between them.
struct RedrawnFlats {
    std::vector<std::uint8_t> replaced;          ///< [faces] 1: the triangles cover it; empty: none
    std::vector<std::array<Index, 3>> triangles; ///< wedges of the surface, facing as its faces do
    std::vector<Index> source;                   ///< [triangles] a face of the same patch

    bool empty() const { return triangles.empty(); }
};

/// The outline of a flat patch may move apart and stay sound although its triangles turn over. For example,
/// the hole of a ring grows past the chords that its triangles use. Such a patch is triangulated again
/// between the moved vertices (constrained Delaunay, exact), so its outline does not change. Vertices inside
/// the patch that are not inside the moved outline lose their faces. A patch is not changed if its moved
/// outline crosses or touches itself, or if one of its edges is reversed.
///
/// Coplanar means within a millionth of twice the patch's diagonal (float32 resolution, as in face_kinds).
/// moved: [vertices]. turned: the flags of turned_faces; the function clears them for sound patches.
[[nodiscard]] RedrawnFlats redrawn_flats(const Mesh& surface, const std::vector<Vec3>& moved,
                                         std::vector<std::uint8_t>& turned);

/// Calls face(wedges, source) for each face of the surface after the change: first the faces that stay, in
/// order, followed by the triangles.
template <class Body>
void for_each_face(const Mesh& surface, const RedrawnFlats& flats, Body&& face) {
    for (Index f = 0; f < surface.face_count(); ++f)
        if (flats.replaced.empty() || flats.replaced[f] == 0) face(surface.face_wedges(f), f);
    for (std::size_t t = 0; t < flats.triangles.size(); ++t)
        face(std::span<const Index>(flats.triangles[t]), flats.source[t]);
}

} // namespace facetmill
