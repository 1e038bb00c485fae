#include "geometry/bake/projection.hpp"

#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/rays_walk.hpp"
#include "geometry/transfer/transfer.hpp"

namespace facetmill::baking {

namespace {

SourcePlace place_of(const FaceTree& tree, Index triangle, const Vec3& point) {
    const auto weights = barycentric_weights(tree.triangle(triangle), point);
    return {tree.face(triangle), {weights[0], weights[1], weights[2]}};
}

/// The t of the point where the ray from + t direction meets the triangle; infinity if it misses. After T.
/// Moeller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997).
double meets(const FaceTree::Triangle& t, const Vec3& from, const Vec3& direction) {
    const Vec3 e1 = t.b - t.a, e2 = t.c - t.a, p = cross(direction, e2);
    const double det = dot(e1, p);
    if (det == 0) return HUGE_VAL;
    const Vec3 s = from - t.a;
    const double u = dot(s, p) / det;
    if (!(u >= 0 && u <= 1)) return HUGE_VAL;
    const Vec3 q = cross(s, e1);
    const double v = dot(direction, q) / det;
    if (!(v >= 0 && u + v <= 1)) return HUGE_VAL;
    return dot(e2, q) / det;
}

} // namespace

Projection Projector::operator()(const Vec3& p, const Vec3& direction, Index& hint) const {
    std::optional<Hit> best;
    double sign = 1;
    for (const int way : {1, -1}) {
        const Line line{p, p + direction * (way * distance_)};
        if (!rays::is_line(line)) break;
        const rays::LineTest test(line);
        rays::LineWalk walk(tree_, line, best ? best->t : 1.0);
        const auto found = [&](Index triangle) {
            const auto hit = test.hit(tree_, triangle);
            if (hit && (any_side_ || hit->way == way || reader_.is_double_sided(hit->face)) &&
                (!best || rays::before(*hit, *best))) {
                best = hit;
                sign = way;
            }
            return best ? best->t : 1.0;
        };
        while (walk.step(found)) {
        }
    }
    if (best) {
        hint = best->triangle;
        return {place_of(tree_, best->triangle, best->point), best->point, sign * best->t * distance_, false};
    }
    const Closest closest = closest_point(tree_, p, hint);
    if (closest.triangle == none) return {{}, p, 0, true};
    hint = closest.triangle;
    return {place_of(tree_, closest.triangle, closest.point), closest.point,
            dot(closest.point - p, direction), true};
}

bool is_blocked(const FaceTree& tree, const Vec3& from, const Vec3& direction, double near, double far) {
    rays::LineWalk walk(tree, {from, from + direction, true}, far);
    bool blocked = false;
    const auto found = [&](Index triangle) {
        const double t = meets(tree.triangle(triangle), from, direction);
        blocked = blocked || (t > near && t < far);
        return blocked ? -1.0 : far;
    };
    while (!blocked && walk.step(found)) {
    }
    return blocked;
}

double distance_to_surface(const FaceTree& tree, const Vec3& from, const Vec3& direction, double near) {
    rays::LineWalk walk(tree, {from, from + direction, true});
    double first = HUGE_VAL;
    const auto found = [&](Index triangle) {
        const double t = meets(tree.triangle(triangle), from, direction);
        if (t > near && t < first) first = t;
        return first;
    };
    while (walk.step(found)) {
    }
    return first;
}

} // namespace facetmill::baking
