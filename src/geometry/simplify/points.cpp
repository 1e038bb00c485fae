// max_error while collapsing: points of the surface that came in are followed from face to face.

#include "geometry/spatial/closest_point.hpp"
#include "geometry/simplify/around.hpp"

#include <utility>

namespace facetmill::simplification {

namespace {

// A face as near to a point as this share of the bound (squared) is not compared with others.
constexpr double near_enough = 0.01;
// Where on a face that stays, by the weights of its other two vertices, it is asked how far the surface is.
constexpr std::pair<double, double> places_on_face[]{
    {1.0 / 3, 1.0 / 3}, {0.5, 0}, {0.5, 0.5}, {1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};

/// Calls body(spoke) for the faces around the edge.
template <class Body>
void for_faces(const Around& r, Body&& body) {
    for (const Spoke& k : r.at_a) body(k);
    for (const Spoke& k : r.at_b)
        if (!k.has(r.a)) body(k);
}

bool keeps_points(const Work& s, Around& r, const Vec3& to, double most) {
    r.points.clear(), r.taken_by.clear(), r.staying.clear();
    for_faces(r, [&](const Spoke& k) {
        if (!k.has(r.a) && !k.has(r.b)) r.staying.push_back(k);
        const Index f = k.corner / 3;
        for (Index p = s.first_point[f]; p != none; p = s.next_point[p]) r.points.push_back(p);
    });
    for (const Index p : r.points) {
        double least = HUGE_VAL;
        Index taker = none;
        for (Index i = 0; i < r.staying.size() && least > near_enough * most; ++i) {
            const Vec3 &x = s.at[r.staying[i].next], &y = s.at[r.staying[i].before];
            const Vec3 off = s.points[p] - closest_on_triangle(s.points[p], to, x, y);
            if (dot(off, off) < least) least = dot(off, off), taker = i;
        }
        if (!(least <= most)) return false;
        r.taken_by.push_back(taker);
    }
    return true;
}

/// Whether the new vertex and places on the faces at it are near the surface that came in: near a point of it
/// that the face took, or else near any place.
bool is_near(const Work& s, Around& r, const Vec3& to, double most) {
    r.places.assign(1, to);
    for (const Spoke& k : r.staying) {
        const Vec3 &x = s.at[k.next], &y = s.at[k.before];
        for (const auto& [a, b] : places_on_face) r.places.push_back(to * (1 - a - b) + x * a + y * b);
    }
    r.near.assign(r.places.size(), 0);
    const auto look = [&](std::size_t place, const Vec3& p) {
        const Vec3 off = r.places[place] - p;
        if (dot(off, off) <= most) r.near[place] = 1;
    };
    for (std::size_t i = 0; i < r.points.size(); ++i) {
        const Vec3& p = s.points[r.points[i]];
        look(0, p);
        for (std::size_t k = 0; k < std::size(places_on_face); ++k)
            look(1 + std::size(places_on_face) * r.taken_by[i] + k, p);
    }
    const double bound = std::sqrt(most) / s.scale;
    Index hint = none;
    for (std::size_t i = 0; i < r.places.size(); ++i) {
        if (r.near[i]) continue;
        const Closest found = closest_point(*s.given, r.places[i] / s.scale + s.centre, hint, bound);
        if (!(found.distance <= bound)) return false;
        hint = found.triangle;
    }
    return true;
}

} // namespace

bool points_stay_near(const Work& s, Around& around, const Vec3& to, double most) {
    return keeps_points(s, around, to, most) && is_near(s, around, to, most);
}

void hand_over_points(Work& s, const Around& around) {
    for_faces(around, [&](const Spoke& k) { s.first_point[k.corner / 3] = none; });
    for (std::size_t i = 0; i < around.points.size(); ++i) {
        const Index face = around.staying[around.taken_by[i]].corner / 3;
        s.next_point[around.points[i]] = std::exchange(s.first_point[face], around.points[i]);
    }
}

} // namespace facetmill::simplification
