#include "geometry/wrap/nearest_attributes.hpp"

#include "geometry/spatial/closest_point.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/provenance.hpp"
#include "parallel/parallel.hpp"

#include <array>

namespace facetmill {

namespace {

/// The source as triangles of wedges; points are triangles of a single wedge.
Mesh source_triangles(const Mesh& source) {
    Mesh out = triangulated(source);
    out.lines.clear();
    out.line_primitive.clear();
    if (!out.corners.empty()) return out;
    std::erase_if(out.attributes, [](const Attribute& a) { return a.domain == Domain::face; });
    out.primitives.clear();
    for (Index w = 0; w < out.wedge_count(); ++w) out.corners.insert(out.corners.end(), {w, w, w});
    return out;
}

/// The reason why a nearest value would be wrong; null for an attribute that can be taken.
const char* reason_to_drop(const Attribute& a) {
    switch (a.role) {
    case Role::uv:
        return "the wrap has no seams of a texture";
    case Role::normal:
    case Role::tangent:
        return "the wrap has its own directions";
    case Role::morph_vector:
        return "the wrap has its own shape";
    default:
        return nullptr;
    }
}

/// The weights of the corners for a point of a triangle.
std::array<double, 3> weights_at(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = cross(b - a, c - a);
    const double nn = dot(n, n);
    if (!(nn > 0)) {
        const double pa = length(p - a), pb = length(p - b), pc = length(p - c);
        if (pa <= pb && pa <= pc) return {1, 0, 0};
        return pb <= pc ? std::array<double, 3>{0, 1, 0} : std::array<double, 3>{0, 0, 1};
    }
    std::array<double, 3> w{dot(n, cross(c - b, p - b)), dot(n, cross(a - c, p - c)),
                            dot(n, cross(b - a, p - a))};
    double sum = 0;
    for (double& x : w) {
        x = std::max(x, 0.0);
        sum += x;
    }
    for (double& x : w) x /= sum;
    return w;
}

Surface surface_of_triangles(const Mesh& mesh, const PowerScale& scale) {
    Surface surface;
    surface.positions = scale(mesh.positions);
    surface.corners.reserve(mesh.corners.size());
    for (Index c = 0; c < mesh.corner_count(); ++c) surface.corners.push_back(mesh.vertex(c));
    return surface;
}

} // namespace

AttributeChanges take_nearest_attributes(Mesh& mesh, const Mesh& source) {
    AttributeChanges changes;
    Mesh from = source_triangles(source);
    const PowerScale scale = even_scale(from.bounds());
    for (const auto& a : source.attributes)
        if (const char* why = reason_to_drop(a))
            changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, why});
    std::erase_if(from.attributes, [](const Attribute& a) { return reason_to_drop(a) != nullptr; });
    const Surface surface = surface_of_triangles(from, scale);
    const FaceTree tree(surface, FaceTree::Use::near);
    const std::vector<Vec3> points = scale(mesh.positions);

    MeshProvenance provenance;
    const auto near = closest_points(tree, points);
    for (std::size_t v = 0; v < points.size(); ++v) {
        const Index t = near[v].face;
        const auto w =
            weights_at(near[v].point, surface.point(t, 0), surface.point(t, 1), surface.point(t, 2));
        for (std::size_t k = 0; k < 3; ++k) {
            const Index wedge = from.corners[3 * t + k];
            provenance.wedges.mix_sources.push_back(wedge);
            provenance.vertices.mix_sources.push_back(from.vertex_of_wedge(wedge));
            provenance.wedges.mix_weights.push_back(w[k]);
        }
        provenance.wedges.mix_offsets.push_back(static_cast<Index>(3 * v + 3));
    }
    provenance.vertices.mix_weights = provenance.wedges.mix_weights;
    provenance.vertices.mix_offsets = provenance.wedges.mix_offsets;
    std::vector<Vec3> middles(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f)
        middles[f] =
            (points[mesh.vertex(3 * f)] + points[mesh.vertex(3 * f + 1)] + points[mesh.vertex(3 * f + 2)]) /
            3;
    if (!source.corners.empty())
        for (const Closest& c : closest_points(tree, middles)) provenance.faces.push_back(c.face);
    merge_changes(changes, inherit_attributes(mesh, from, provenance));
    return changes;
}

} // namespace facetmill
