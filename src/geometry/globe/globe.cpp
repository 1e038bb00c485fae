#include "geometry/globe/globe.hpp"

#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/text/spelling.hpp"

#include <array>
#include <cmath>
#include <string>

namespace facetmill {

namespace {

constexpr double radians_per_degree = pi / 180;

double hyperbolic_sine(double x) { return (exponential(x) - exponential(-x)) / 2; }
double hyperbolic_cosine(double x) { return (exponential(x) + exponential(-x)) / 2; }
double area_tangent(double x) { return logarithm((1 + x) / (1 - x)) / 2; }

/// The tangent of the latitude whose conformal latitude has this tangent, by Newton's method.
double tangent_of_latitude(double conformal, const Ellipsoid& ellipsoid) {
    const double f = ellipsoid.flattening, e2 = f * (2 - f), e = std::sqrt(e2);
    double t = conformal;
    for (int step = 0; step < 6; ++step) { // quadratic: four steps suffice for doubles
        const double root = std::sqrt(1 + t * t), s = hyperbolic_sine(e * area_tangent(e * t / root));
        const double now = t * std::sqrt(1 + s * s) - s * root;
        t += (conformal - now) / std::sqrt(1 + now * now) * (1 + (1 - e2) * t * t) / ((1 - e2) * root);
    }
    return t;
}

/// The inverse of the Gauss-Krueger projection with a scale of 1 and a sphere of radius 1: x and y are eta
/// and xi. The longitude is relative to the central meridian.
Geodetic inverse_transverse_mercator(double xi, double eta, const Ellipsoid& ellipsoid) {
    const double n = ellipsoid.flattening / (2 - ellipsoid.flattening);
    const double n2 = n * n, n3 = n2 * n, n4 = n2 * n2, n5 = n4 * n, n6 = n3 * n3;
    const std::array beta{n / 2 - 2 * n2 / 3 + 37 * n3 / 96 - n4 / 360 - 81 * n5 / 512 + 96199 * n6 / 604800,
                          n2 / 48 + n3 / 15 - 437 * n4 / 1440 + 46 * n5 / 105 - 1118711 * n6 / 3870720,
                          17 * n3 / 480 - 37 * n4 / 840 - 209 * n5 / 4480 + 5569 * n6 / 90720,
                          4397 * n4 / 161280 - 11 * n5 / 504 - 830251 * n6 / 7257600,
                          4583 * n5 / 161280 - 108847 * n6 / 3991680,
                          20648693 * n6 / 638668800};
    double x = xi, y = eta;
    for (std::size_t i = 0; i < beta.size(); ++i) {
        const double k = 2 * static_cast<double>(i + 1);
        x -= beta[i] * sine(k * xi) * hyperbolic_cosine(k * eta);
        y -= beta[i] * cosine(k * xi) * hyperbolic_sine(k * eta);
    }
    const double sinh_y = hyperbolic_sine(y), cos_x = cosine(x);
    const double t = tangent_of_latitude(sine(x) / std::sqrt(sinh_y * sinh_y + cos_x * cos_x), ellipsoid);
    return {arc_tangent(t, 1), arc_tangent(sinh_y, cos_x), 0};
}

/// The radius of a sphere whose meridian has the length of the ellipsoid's.
double rectifying_radius(const Ellipsoid& ellipsoid) {
    const double n = ellipsoid.flattening / (2 - ellipsoid.flattening), n2 = n * n;
    return ellipsoid.equator / (1 + n) * (1 + n2 / 4 + n2 * n2 / 64 + n2 * n2 * n2 / 256);
}

constexpr double utm_scale = 0.9996, utm_easting = 500000;

Transform frame_of_axes(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
    Transform t;
    for (std::size_t i = 0; i < 3; ++i) {
        t.m[i][0] = x[i];
        t.m[i][1] = y[i];
        t.m[i][2] = z[i];
        t.m[i][3] = origin[i];
    }
    return t;
}

Vec3 up_at(const Geodetic& place) {
    const double c = cosine(place.latitude);
    return {c * cosine(place.longitude), c * sine(place.longitude), sine(place.latitude)};
}

} // namespace

Vec3 geocentric(const Geodetic& place, const Ellipsoid& ellipsoid) {
    const double f = ellipsoid.flattening, e2 = f * (2 - f);
    const Vec3 up = up_at(place);
    const double radius = ellipsoid.equator / std::sqrt(1 - e2 * up.z * up.z);
    return {(radius + place.height) * up.x, (radius + place.height) * up.y,
            (radius * (1 - e2) + place.height) * up.z};
}

Transform local_frame(const Geodetic& place, double heading) {
    const Vec3 up = up_at(place), east{-sine(place.longitude), cosine(place.longitude), 0};
    const Vec3 north = cross(up, east);
    const double c = cosine(heading), s = sine(heading);
    return frame_of_axes(east * c - north * s, east * s + north * c, up, geocentric(place));
}

std::optional<ProjectedSystem> ProjectedSystem::named(std::string_view name) {
    constexpr std::string_view authority = "epsg:";
    const std::string lower = lower_case(std::string(name));
    if (!std::string_view(lower).starts_with(authority)) return {};
    const auto code = parse_integer(std::string_view(lower).substr(authority.size()));
    if (!code) return {};
    const auto utm = [](std::int64_t zone, const Ellipsoid& ellipsoid, double false_northing) {
        ProjectedSystem s;
        s.ellipsoid_ = ellipsoid;
        s.meridian_ = static_cast<double>(6 * zone - 183) * radians_per_degree;
        s.false_northing_ = false_northing;
        return s;
    };
    if (*code > 32600 && *code <= 32660) return utm(*code - 32600, {}, 0);
    if (*code > 32700 && *code <= 32760) return utm(*code - 32700, {}, 1e7);
    if (*code >= 25828 && *code <= 25838) return utm(*code - 25800, grs80, 0);
    if (*code != 3857) return {};
    ProjectedSystem mercator;
    mercator.kind_ = Kind::web_mercator;
    return mercator;
}

Geodetic ProjectedSystem::geodetic(const Vec3& p) const {
    if (kind_ == Kind::web_mercator)
        return {arc_tangent(hyperbolic_sine(p.y / ellipsoid_.equator), 1), p.x / ellipsoid_.equator, p.z};
    const double radius = rectifying_radius(ellipsoid_) * utm_scale;
    Geodetic g = inverse_transverse_mercator((p.y - false_northing_) / radius, (p.x - utm_easting) / radius,
                                             ellipsoid_);
    g.longitude += meridian_;
    g.height = p.z;
    return g;
}

Vec3 ProjectedSystem::geocentric(const Vec3& p) const { return facetmill::geocentric(geodetic(p)); }

Transform ProjectedSystem::frame_at(const Vec3& p) const {
    const Vec3 up = up_at(geodetic(p)), step{0, 1, 0};
    const Vec3 north = geocentric(p + step) - geocentric(p - step);
    const Vec3 east = normalised(cross(north, up));
    return frame_of_axes(east, cross(up, east), up, geocentric(p));
}

bool ProjectedSystem::may_hold(const Vec3& p) const {
    if (!is_finite(p)) return false;
    constexpr double half_equator = 20037509, farthest_from_meridian = 1e6, pole = 1.0001e7;
    if (kind_ == Kind::web_mercator) return std::fabs(p.x) <= half_equator && std::fabs(p.y) <= half_equator;
    const double north = p.y - false_northing_;
    return std::fabs(p.x - utm_easting) <= farthest_from_meridian && std::fabs(north) <= pole;
}

} // namespace facetmill
