#include "stages/transform/options.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/globe/globe.hpp"
#include "geometry/inspect/inspect.hpp"
#include "options/mark_at.hpp"
#include "stage/options/convention.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::transform_stage {

namespace {

using Pivot = TransformOptions::Pivot;
using Purpose = TransformOptions::Purpose;

/// The same rotation as `rotated` of mesh/transform.hpp, as a matrix.
Transform rotation(const TransformRotation& r) {
    const Vec3 u = normalised(r.axis);
    const double c = cosine(r.angle.radians), s = sine(r.angle.radians);
    Transform t;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = (i == j ? c : 0) + (1 - c) * u[i] * u[j];
    t.m[0][1] -= s * u.z;
    t.m[1][0] += s * u.z;
    t.m[0][2] += s * u.y;
    t.m[2][0] -= s * u.y;
    t.m[1][2] -= s * u.x;
    t.m[2][1] += s * u.x;
    return t;
}

Transform scaling(const std::vector<double>& factors) {
    Transform t;
    for (std::size_t i = 0; i < 3; ++i) t.m[i][i] = factors[factors.size() == 1 ? 0 : i];
    return t;
}

Transform from_numbers(const std::vector<double>& m) {
    Transform t;
    for (std::size_t i = 0; i < 12; ++i) t.m[i / 4][i % 4] = m[i];
    return t;
}

void declare_place(Declare<GlobePlace>& d) {
    d.option("lat", &GlobePlace::lat, "The latitude, positive to the north.")
        .also_called("latitude")
        .between(-90, 90)
        .required();
    d.option("lon", &GlobePlace::lon, "The longitude, positive to the east.")
        .also_called("longitude lng long")
        .between(-360, 360)
        .required();
    d.option("height", &GlobePlace::height, "The height above the ellipsoid.")
        .also_called("altitude alt elevation");
    d.option("heading", &GlobePlace::heading, "The direction of the scene's y axis, clockwise from north.")
        .also_called("azimuth yaw bearing");
}

void declare_globe(Declare<TransformOptions>& d) {
    d.group("place", &TransformOptions::place,
            "Puts the origin of the scene at a place on the globe, with x to the east and y to the north.",
            declare_place)
        .also_called("georeference geolocation position_on_globe",
                     "place: {lat: 48.86, lon: 2.29, height: 80m}");
    d.option(
         "crs", &TransformOptions::crs,
         "The coordinate system of the scene, for example EPSG:25832. The coordinates become geocentric. You "
         "can give UTM (EPSG:32601 to 32660, 32701 to 32760, 25828 to 25838) or Web Mercator (EPSG:3857).")
        .also_called("epsg srs from_crs projection");
    d.choice<TransformOptions::Target>(
         "to", &TransformOptions::to,
         {{"ecef", TransformOptions::Target::ecef, "geocentric coordinates on WGS84 (EPSG:4978)"}},
         "The coordinate system of the result, for crs.")
        .also_called("to_crs target");
    d.option("geoid", &TransformOptions::geoid,
             "The height of the geoid above the ellipsoid. crs adds it to the heights of the scene.")
        .also_called("undulation");
}

} // namespace

void declare_transform(Declare<TransformOptions>& d) {
    d.choice<Unit>("unit", &TransformOptions::unit, unit_choices("unknown", "unchanged"),
                   "Converts the scene to this unit. Physical sizes stay the same.")
        .also_called(property_named("unit")->also_called);
    d.choice<UpAxis>(
         "up", &TransformOptions::up,
         {{"unknown", UpAxis::unknown, "unchanged"}, {"y", UpAxis::y, "+Y"}, {"z", UpAxis::z, "+Z"}},
         "Rotates the scene so that this axis points up. If the scene has no up axis, nothing is rotated "
         "(W-UP).")
        .also_called(property_named("up")->also_called);
    d.option("scale", &TransformOptions::scale,
             "One factor, or one factor per axis. Negative factors mirror.");
    d.group("rotate", &TransformOptions::rotate, "A rotation, anticlockwise when you look against the axis.",
            [](Declare<TransformRotation>& r) {
                r.option("angle", &TransformRotation::angle, "The angle of rotation.").primary();
                r.option("axis", &TransformRotation::axis, "The axis of rotation.");
            })
        .also_called("rotation rotate_x rotate_y rotate_z rx ry rz", "rotate: {angle: 90, axis: [0, 0, 1]}");
    d.choice<Pivot>("pivot", &TransformOptions::pivot,
                    {{"origin", Pivot::origin, "the world's origin"},
                     {"centre", Pivot::centre, "the centre of the parts' bounding box"}},
                    "The point that scale, rotate, orient_for and fit do not move.");
    d.option("matrix", &TransformOptions::matrix,
             "Twelve or sixteen numbers, row by row. The matrix multiplies column vectors (x, y, z, 1).");
    d.choice<Purpose>(
         "orient_for", &TransformOptions::orient_for,
         {{"none", Purpose::none, "unchanged"},
          {"printing", Purpose::printing,
           "turns the parts together for the least overhang, then the lowest height, and puts them on the "
           "ground"}},
         "Turns the parts for a purpose.")
        .also_called("auto_orient orientation lay_flat");
    d.option("overhang_angle", &TransformOptions::overhang_angle,
             "For orient_for: a face overhangs if it looks down and its slope against the ground is below "
             "this angle.")
        .between(0, 90);
    d.option("fit", &TransformOptions::fit,
             "Scales the parts uniformly until their bounding box fits into a cube with this side. For "
             "example, fit: 120mm makes the longest side 120 mm. Three lengths give a box instead of a cube. "
             "A percentage refers to the current side, so 50% halves the parts.")
        .also_called("size resize fit_to max_size longest normalize normalise height", "(fit: 120mm)");
    d.option("shrink_only", &TransformOptions::shrink_only,
             "Keeps the size of parts that already fit, so fit never enlarges parts.")
        .also_called("only_shrink max");
    d.option("translate", &TransformOptions::translate, "Three lengths.")
        .also_called("move offset translation position");
    d.option("centre", &TransformOptions::centre,
             "Moves the centre of the parts' bounding box to the origin.");
    d.option("ground", &TransformOptions::ground,
             "Moves the parts so that their lowest point along the up axis is at 0.");
    declare_globe(d);
    d.option("bake", &TransformOptions::bake,
             "Applies the transform to the vertices and removes it from the parts' nodes. Nodes "
             "with animations, instances, cameras or lights are moved instead.");
}

namespace {

Refusal excludes(const std::string& option, const std::string& other) {
    return {option, fmt::format("'{}' cannot be combined with '{}'", option, other), "remove one of them"};
}

void verify_globe(const TransformOptions& o, const Value& given, Problems& problems) {
    if (!o.crs.empty() && o.place) add_refusal(excludes("place", "crs"), "transform", given, problems);
    if (o.crs.empty())
        for (const char* name : {"to", "geoid"})
            if (given.find(name)) add_refusal(needs(name, "crs"), "transform", given, problems);
    const Value* crs = given.find("crs");
    if (crs && !crs->deferred && !ProjectedSystem::named(o.crs))
        problems.add(crs->mark, "E-CRS",
                     fmt::format("transform: '{}' is not a known coordinate system", o.crs),
                     "give UTM or Web Mercator, such as EPSG:25832, EPSG:32633 or EPSG:3857; convert other "
                     "coordinates with gdaltransform or PDAL first");
    for (const char* name : {"unit", "up"})
        if (given.find(name) && (o.place || !o.crs.empty()))
            add_refusal(excludes(name, o.place ? "place" : "crs"), "transform", given, problems);
}

} // namespace

void verify_transform(const TransformOptions& o, const Value& given, Problems& problems) {
    verify_globe(o, given, problems);
    const auto refuse = [&](const char* name, std::string message, std::string hint = {}) {
        problems.add(mark_at(given, name), "E-TRANSFORM", "transform: " + std::move(message),
                     std::move(hint));
    };
    if (!o.translate.empty() && o.translate.size() != 3)
        refuse("translate", fmt::format("translate needs three lengths, found {}", o.translate.size()));
    if (!o.scale.empty() && o.scale.size() != 1 && o.scale.size() != 3)
        refuse("scale", fmt::format("scale needs one factor or three, found {}", o.scale.size()));
    for (const double factor : o.scale)
        if (!(std::abs(factor) > 0) || !std::isfinite(factor))
            refuse("scale", "a factor of 0 would flatten the parts");
    if (!o.matrix.empty() && o.matrix.size() != 12 && o.matrix.size() != 16)
        refuse("matrix", fmt::format("matrix needs 12 or 16 numbers, found {}", o.matrix.size()));
    else if (!o.matrix.empty() && !(std::abs(from_numbers(o.matrix).determinant()) > 0))
        refuse("matrix", "the matrix would flatten the parts");
    if (o.matrix.size() == 16 &&
        (o.matrix[12] != 0 || o.matrix[13] != 0 || o.matrix[14] != 0 || o.matrix[15] != 1))
        refuse("matrix", "the last row of the matrix must be 0, 0, 0, 1");
    if (!o.fit.empty() && o.fit.size() != 1 && o.fit.size() != 3)
        refuse("fit", fmt::format("fit needs one length or three, found {}", o.fit.size()));
    const Value* fit = given.find("fit");
    for (const Length& side : o.fit)
        if (!(side.amount > 0) && !(fit && fit->deferred))
            refuse("fit", fmt::format("the lengths of fit must be above 0, found {}", side.text),
                   "write, for example, fit: 200mm");
    if (given.find("pivot") && o.scale.empty() && !o.rotate && o.fit.empty() && o.orient_for == Purpose::none)
        add_refusal(needs("pivot", "scale, rotate, orient_for or fit"), "transform", given, problems);
    if (o.shrink_only && o.fit.empty())
        add_refusal(needs("shrink_only", "fit"), "transform", given, problems);
    if (given.find("overhang_angle") && o.orient_for == Purpose::none)
        add_refusal(needs("overhang_angle", "orient_for: printing"), "transform", given, problems);
    if (o.rotate && !(length(o.rotate->axis) > 0))
        refuse("rotate", "the axis of the rotation has zero length");
}

Transform spin_of(const TransformOptions& o) {
    Transform spin;
    if (!o.scale.empty()) spin = scaling(o.scale);
    if (o.rotate) spin = rotation(*o.rotate) * spin;
    return spin;
}

Transform matrix_of(const TransformOptions& o) {
    return o.matrix.empty() ? Transform{} : from_numbers(o.matrix);
}

} // namespace facetmill::transform_stage
