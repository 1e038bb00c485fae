#pragma once
// Quantities of a face: neighbours in the ring of corners, area vector, mean, and box.

#include "mesh/mesh.hpp"

namespace facetmill {

/// The corners after and before c in a face with the corners [begin, end).
[[nodiscard]] inline Index next_corner(Index c, Index begin, Index end) {
    return c + 1 == end ? begin : c + 1;
}
[[nodiscard]] inline Index previous_corner(Index c, Index begin, Index end) {
    return c == begin ? end - 1 : c - 1;
}

/// The corners after and before c in face f, which must contain c.
[[nodiscard]] inline Index next_corner(const Mesh& mesh, Index f, Index c) {
    return next_corner(c, mesh.face_begin(f), mesh.face_end(f));
}
[[nodiscard]] inline Index previous_corner(const Mesh& mesh, Index f, Index c) {
    return previous_corner(c, mesh.face_begin(f), mesh.face_end(f));
}

/// A vector along the normal of face f, with twice its area as length (Newell's sum, relative to the first
/// corner: I. E. Sutherland, R. F. Sproull and R. A. Schumacker, "A characterization of ten hidden-surface
/// algorithms", 1974). place(corner) returns the position of a corner.
template <class Place>
[[nodiscard]] Vec3 area_vector_at(const Mesh& mesh, Index f, Place&& place) {
    Vec3 sum;
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    const Vec3 first = place(begin);
    for (Index c = begin + 1; c + 1 < end; ++c) sum += cross(place(c) - first, place(c + 1) - first);
    return sum;
}

[[nodiscard]] inline Vec3 area_vector(const Mesh& mesh, Index f) {
    return area_vector_at(mesh, f, [&](Index c) { return mesh.point(c); });
}

/// The area vector in world space. A mirroring transform reverses it.
[[nodiscard]] inline Vec3 area_vector(const Mesh& mesh, Index f, const Transform& to_world) {
    const Vec3& first = mesh.point(mesh.face_begin(f));
    return area_vector_at(mesh, f, [&](Index c) { return to_world.vector(mesh.point(c) - first); });
}

/// Whether the angle between two normals with this dot product exceeds the feature angle with this cosine.
/// An excess by rounding (1e-12 of the cosine) does not count, so a right angle does not exceed 90 degrees.
inline bool exceeds_feature_angle(double dot_product, double cosine) { return dot_product < cosine - 1e-12; }

/// The sum of the corners of face f. place(corner) returns the position of a corner.
template <class Place>
[[nodiscard]] Vec3 corner_sum_at(const Mesh& mesh, Index f, Place&& place) {
    Vec3 sum;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) sum += place(c);
    return sum;
}

/// The mean of the corners of face f, at points[vertex].
[[nodiscard]] inline Vec3 corner_mean(const Mesh& mesh, Index f, const std::vector<Vec3>& points) {
    return corner_sum_at(mesh, f, [&](Index c) { return points[mesh.vertex(c)]; }) / mesh.face_size(f);
}
[[nodiscard]] inline Vec3 corner_mean(const Mesh& mesh, Index f) {
    return corner_mean(mesh, f, mesh.positions);
}

/// Widens the box by the corners of face f.
inline void add_corners(Box& box, const Mesh& mesh, Index f) {
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) box.add(mesh.point(c));
}

} // namespace facetmill
