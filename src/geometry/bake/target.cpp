#include "geometry/bake/target.hpp"

namespace facetmill::baking {

TargetReader::TargetReader(const Mesh& mesh)
    : mesh_(mesh), normals_(mesh.find("NORMAL", Domain::wedge)),
      tangents_(mesh.find("TANGENT", Domain::wedge)), directions_(mesh.vertex_count()) {
    for (Index c = 0; c + 2 < mesh.corner_count(); c += 3) {
        const Vec3 n = cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c));
        for (Index k = 0; k < 3; ++k) directions_[mesh.vertex(c + k)] += n;
    }
}

TargetPoint TargetReader::at(Index triangle, const Vec3& weights) const {
    TargetPoint out;
    std::array<Vec3, 3> corners;
    double sign = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Index wedge = mesh_.corners[3 * std::size_t{triangle} + k],
                    vertex = mesh_.vertex_of_wedge(wedge);
        corners[k] = mesh_.positions[vertex];
        out.position += weights[k] * corners[k];
        out.direction += weights[k] * normalised(directions_[vertex]);
        const float* n = &normals_.numbers[std::size_t{wedge} * normals_.components];
        const float* t = &tangents_.numbers[std::size_t{wedge} * tangents_.components];
        out.normal += weights[k] * Vec3{n[0], n[1], n[2]};
        out.tangent += weights[k] * Vec3{t[0], t[1], t[2]};
        if (k == 0) sign = t[3] < 0 ? -1 : 1;
    }
    const Vec3 facet = normalised(cross(corners[1] - corners[0], corners[2] - corners[0]));
    out.direction = normalised(out.direction);
    if (!(dot(out.direction, facet) > 0)) out.direction = facet;
    out.normal = normalised(out.normal);
    out.tangent = normalised(out.tangent);
    out.bitangent = normalised(cross(out.normal, out.tangent)) * sign;
    return out;
}

TexelSteps TargetReader::steps(Index triangle, const std::array<double, 6>& c) const {
    const Index first = 3 * triangle;
    const Vec3 e1 = mesh_.point(first + 1) - mesh_.point(first),
               e2 = mesh_.point(first + 2) - mesh_.point(first);
    const double x1 = c[2] - c[0], y1 = c[3] - c[1], x2 = c[4] - c[0], y2 = c[5] - c[1];
    const double det = x1 * y2 - x2 * y1;
    if (det == 0) return {};
    return {(e1 * y2 - e2 * y1) / det, (e2 * x1 - e1 * x2) / det};
}

Vec3 in_tangent_space(const TargetPoint& p, const Vec3& v) {
    const Vec3 bn = cross(p.bitangent, p.normal), nt = cross(p.normal, p.tangent),
               tb = cross(p.tangent, p.bitangent);
    const double volume = dot(p.tangent, bn);
    const Vec3 out = normalised(Vec3{dot(v, bn), dot(v, nt), dot(v, tb)} * (volume < 0 ? -1.0 : 1.0));
    return volume == 0 || dot(out, out) == 0 ? Vec3{0, 0, 1} : out;
}

} // namespace facetmill::baking
