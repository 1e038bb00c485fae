// The properties that each face has: angles, edges, aspect ratio and planarity.
#include "base/math/angle.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/inspect/measures.hpp"
#include "mesh/aspect_ratio.hpp"
#include "mesh/face.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

std::vector<double> face_values(const Mesh& mesh, const Property& property) {
    const PowerScale scale = even_scale(mesh.bounds());
    if (scale.none()) return property.of_faces(mesh);
    auto values = property.of_faces(scale(mesh));
    const int power = property.kind == PropertyKind::length ? 1 : property.kind == PropertyKind::area ? 2 : 0;
    if (power > 0)
        for (double& x : values) x = unscaled(x, power * scale.powers[0]);
    return values;
}

namespace inspect_room {

namespace {

constexpr double degrees = 180 / pi;

double angle(const Vec3& at, const Vec3& b, const Vec3& c) { return angle_between(b - at, c - at) * degrees; }

double corner_angle(const Mesh& mesh, Index f, Index c) {
    return angle(mesh.point(c), mesh.point(previous_corner(mesh, f, c)), mesh.point(next_corner(mesh, f, c)));
}

double edge_length(const Mesh& mesh, Index f, Index c) {
    return length(mesh.point(next_corner(mesh, f, c)) - mesh.point(c));
}

/// The worst of the face's triangles.
double worst_aspect_ratio(const Mesh& mesh, Index f) {
    double worst = 0;
    const Index begin = mesh.face_begin(f);
    for (Index c = begin + 1; c + 1 < mesh.face_end(f); ++c)
        worst = std::max(worst, aspect_ratio(mesh.point(begin), mesh.point(c), mesh.point(c + 1)));
    return worst;
}

double nonplanarity(const Mesh& mesh, Index f) {
    if (mesh.face_size(f) == 3) return 0;
    const Vec3 normal = normalised(area_vector(mesh, f));
    const Vec3 middle = corner_mean(mesh, f);
    double farthest = 0;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
        farthest = std::max(farthest, std::abs(dot(mesh.point(c) - middle, normal)));
    return farthest;
}

/// [faces] value(face)
template <class Value>
std::vector<double> of_each_face(const Mesh& mesh, Value&& value) {
    std::vector<double> values(mesh.face_count());
    parallel_for(values.size(), [&](std::size_t f) { values[f] = value(static_cast<Index>(f)); });
    return values;
}

/// [faces] the least, or the most, of value(mesh, face, corner) over the corners of each.
template <class Value>
std::vector<double> least_of_corners(const Mesh& mesh, Value&& value) {
    return of_each_face(mesh, [&](Index f) {
        double least = HUGE_VAL;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            least = std::min(least, value(mesh, f, c));
        return least;
    });
}
template <class Value>
std::vector<double> max_of_corners(const Mesh& mesh, Value&& value) {
    return of_each_face(mesh, [&](Index f) {
        double most = 0;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            most = std::max(most, value(mesh, f, c));
        return most;
    });
}

} // namespace

std::vector<double> smallest_angles(const Mesh& mesh) { return least_of_corners(mesh, corner_angle); }
std::vector<double> largest_angles(const Mesh& mesh) { return max_of_corners(mesh, corner_angle); }
std::vector<double> shortest_edges(const Mesh& mesh) { return least_of_corners(mesh, edge_length); }
std::vector<double> longest_edges(const Mesh& mesh) { return max_of_corners(mesh, edge_length); }

std::vector<double> aspect_ratios(const Mesh& mesh) {
    return of_each_face(mesh, [&](Index f) { return worst_aspect_ratio(mesh, f); });
}

std::vector<double> nonplanarities(const Mesh& mesh) {
    return of_each_face(mesh, [&](Index f) { return nonplanarity(mesh, f); });
}

std::optional<double> value_of(const Property& property, const Measured& mesh) {
    if (property.measure) return property.measure(mesh);
    std::optional<double> best;
    for (const double x : face_values(mesh.world, property))
        if (!best || (property.join == Join::least ? x < *best : x > *best)) best = x;
    return best == HUGE_VAL && property.join == Join::least ? std::nullopt : best;
}

} // namespace inspect_room

} // namespace facetmill
