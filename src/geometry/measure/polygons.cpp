// Implements the measures of single polygons in geometry/measure/measure.hpp.
#include "geometry/measure/measure.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "mesh/power_scale.hpp"

#include <cmath>

namespace facetmill {

namespace {

/// Sums the signed triangles of the fan from the first corner, which is correct for concave polygons too.
Vec3 centroid_of(std::span<const Vec3> p, const Vec3& normal, double area) {
    Vec3 moment;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        const Vec3 a = p[i] - p[0], b = p[i + 1] - p[0];
        moment += (a + b) * (dot(cross(a, b), normal) / 6);
    }
    return p[0] + (area > 0 ? moment / area : Vec3{});
}

std::size_t longest_component(const Vec3& v) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(v[i]) > std::abs(v[longest])) longest = i;
    return longest;
}

/// The moments in the frame. The sums are relative to the first corner, so that polygons far from the origin
/// keep their precision.
std::optional<polygon::Moments> moments_in(const SectionFrame& frame, std::span<const Vec3> p,
                                           bool by_winding) {
    std::vector<Vec2> flat;
    flat.reserve(p.size());
    for (const Vec3& q : p) flat.push_back({dot(q - p[0], frame.u), dot(q - p[0], frame.v)});
    auto m = by_winding ? polygon::moments_by_winding(flat) : polygon::moments(polygon::Ring(flat));
    if (!m) return {};
    m->centroid = m->centroid + frame.flat(p[0]);
    const Vec2& c = m->centroid;
    m->about_origin = {m->about_centroid.x + m->area * c.y * c.y, m->about_centroid.y + m->area * c.x * c.x,
                       m->about_centroid.xy + m->area * c.x * c.y};
    return m;
}

/// Takes the area and the centroid of a polygon that crosses itself from its moments.
void take_covered(PolygonResult& r) {
    if (r.area <= 1e-12 * r.moments->area) r.normal = r.frame.normal; // smaller areas result from rounding
    r.area = r.moments->area;
    r.centroid = r.frame.point(r.moments->centroid);
}

/// Requires a polygon whose box has a size near 1.
PolygonResult polygon_of(std::span<const Vec3> p) {
    PolygonResult r;
    r.kind = face_kind(p);
    r.off_plane = polygon::plane_deviation(p);
    r.planar = is_planar(p, r.off_plane);
    const Vec3 area = polygon::area_vector(p);
    r.area = length(area);
    const bool crosses = r.kind == polygon::Kind::self_intersecting;
    r.normal = crosses && r.planar ? polygon::plane_normal(p) : normalised(area);
    r.centroid = centroid_of(p, r.normal, r.area);
    if (!(length(r.normal) > 0)) return r;
    const bool upward = r.normal[longest_component(r.normal)] > 0;
    r.frame = frame_of({upward ? r.normal : -r.normal, p[0], 0});
    if (r.kind != polygon::Kind::degenerate && (!crosses || r.planar))
        r.moments = moments_in(r.frame, p, crosses);
    if (crosses && r.moments) take_covered(r);
    r.signed_area = dot(r.normal, r.frame.normal) > 0 ? r.area : -r.area;
    return r;
}

void unscale(polygon::Moments& m, int power) {
    m.area = unscaled(m.area, 2 * power);
    m.centroid = {unscaled(m.centroid.x, power), unscaled(m.centroid.y, power)};
    for (polygon::SecondMoments* s : {&m.about_origin, &m.about_centroid})
        for (double* x : {&s->x, &s->y, &s->xy}) *x = unscaled(*x, 4 * power);
    m.axes.largest = unscaled(m.axes.largest, 4 * power);
    m.axes.smallest = unscaled(m.axes.smallest, 4 * power);
}

} // namespace

PolygonResult measure_polygon(std::span<const Vec3> corners) {
    const PowerScale scale = even_scale(box_of(corners));
    if (scale.none()) return polygon_of(corners);
    std::vector<Vec3> scaled;
    scaled.reserve(corners.size());
    for (const Vec3& p : corners) scaled.push_back(scale(p));
    PolygonResult r = polygon_of(scaled);
    const int power = scale.powers[0];
    r.off_plane = unscaled(r.off_plane, power);
    r.area = unscaled(r.area, 2 * power);
    r.signed_area = unscaled(r.signed_area, 2 * power);
    r.centroid = scale.inverse()(r.centroid);
    r.frame.origin = scale.inverse()(r.frame.origin);
    if (r.moments) unscale(*r.moments, power);
    return r;
}

} // namespace facetmill
