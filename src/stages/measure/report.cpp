#include "stages/measure/report.hpp"

#include "base/portable_math.hpp"
#include "base/point_json.hpp"

namespace facetmill::report {

namespace {

constexpr double degrees = 180 / pi;

/// Null unless all of it is known.
Json known_point(bool known, const Vec3& p) { return known && is_finite(p) ? point_json(p) : Json(nullptr); }

Json principal_json(const SolidMass& solid, double density) {
    const Symmetric i = solid.inertia();
    if (!is_finite({i.xx, i.yy, i.zz}) || !is_finite({i.xy, i.xz, i.yz})) return nullptr;
    const Eigen3 e = eigen(i);
    Json moments = Json::array(), axes = Json::array(), radii = Json::array();
    for (std::size_t k = 0; k < 3; ++k) {
        moments.push_back(e.values[k] * density);
        axes.push_back(point_json(e.vectors[k]));
        const double square = solid.volume != 0 ? e.values[k] / solid.volume : 0;
        // A solid with a volume has moments: they vanish only below the range of numbers.
        radii.push_back(square > 0 ? Json(std::sqrt(square)) : solid.volume != 0 ? Json(nullptr) : Json(0));
    }
    return {{"moments", moments}, {"axes", axes}, {"radii_of_gyration", radii}};
}

} // namespace

Json statistics_json(const Statistics& s, double factor) {
    if (s.count == 0) return {{"count", 0}};
    return {{"count", s.count},        {"minimum", s.minimum * factor}, {"maximum", s.maximum * factor},
            {"mean", s.mean * factor}, {"median", s.median * factor},   {"deviation", s.deviation * factor}};
}

Json shell_json(const ShellMass& shell) {
    return {{"area", shell.area}, {"centroid", known_point(shell.area > 0, shell.centroid)}};
}

Json solid_json(const std::optional<SolidMass>& solid, double density) {
    if (!solid) return nullptr;
    const double mass = solid->volume * density;
    const Symmetric i = solid->inertia();
    const Json inertia = Json::array({point_json(Vec3{i.xx, i.xy, i.xz} * density),
                                      point_json(Vec3{i.xy, i.yy, i.yz} * density),
                                      point_json(Vec3{i.xz, i.yz, i.zz} * density)});
    return {{"volume", solid->volume},
            {"mass", mass},
            {"centroid", known_point(solid->volume != 0, solid->centroid)},
            {"inertia", inertia},
            {"principal", principal_json(*solid, density)}};
}

Json faces_json(const FaceResult& faces) {
    Json kinds = Json::object();
    for (int k = 0; k < polygon::kinds; ++k) {
        const auto kind = static_cast<polygon::Kind>(k);
        if (faces.kinds.count(kind) > 0) kinds[polygon::to_string(kind)] = faces.kinds.count(kind);
    }
    return {{"area", statistics_json(faces.area)},     {"angle", statistics_json(faces.angle, degrees)},
            {"aspect", statistics_json(faces.aspect)}, {"kinds", std::move(kinds)},
            {"non_planar", faces.kinds.non_planar},    {"farthest_from_plane", faces.kinds.deviation}};
}

Json edges_json(const EdgeResult& edges) {
    return {{"length", statistics_json(edges.length)},
            {"turn", statistics_json(edges.turn, degrees)},
            {"convex", edges.convex},
            {"concave", edges.concave},
            {"flat", edges.flat},
            {"feature", edges.feature},
            {"boundary", edges.boundary},
            {"non_manifold", edges.non_manifold}};
}

Json curvature_json(const CurvatureResult& curvature) {
    return {{"gaussian", statistics_json(curvature.of_gaussian)},
            {"mean", statistics_json(curvature.of_mean)},
            {"total_in_turns", curvature.total / (2 * pi)}};
}

} // namespace facetmill::report
