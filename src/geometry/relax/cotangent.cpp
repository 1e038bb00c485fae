#include "base/parallel.hpp"
#include "geometry/relax/steps.hpp"

#include <algorithm>
#include <memory>

namespace facetmill {

namespace {

/// Triangles that stand for the faces, the corners at each vertex, and a weight for each corner.
struct Cotangents {
    std::vector<Index> corners; ///< vertices, three to a triangle
    VertexLists at;             ///< corners at each vertex
    std::vector<double> weights;

    explicit Cotangents(const Mesh& mesh) {
        Mesh plain;
        plain.positions = mesh.positions;
        plain.corners.resize(mesh.corner_count());
        plain.face_offsets = mesh.face_offsets;
        parallel_for(mesh.corner_count(),
                     [&](std::size_t c) { plain.corners[c] = mesh.vertex(static_cast<Index>(c)); });
        if (!plain.all_triangles()) plain = triangulated(plain);
        at = corners_at_vertices(plain);
        corners = std::move(plain.corners);
        weights.resize(corners.size());
    }

    /// The cotangent of the angle at each corner, from 0 (right and obtuse) to 10^6 (a millionth of a
    /// radian).
    void weigh(const std::vector<Vec3>& p) {
        parallel_for(corners.size() / 3, [&](std::size_t t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& here = p[corners[3 * t + k]];
                const Vec3 a = p[corners[3 * t + (k + 1) % 3]] - here,
                           b = p[corners[3 * t + (k + 2) % 3]] - here;
                const double twice_area = length(cross(a, b));
                weights[3 * t + k] = twice_area > 0 ? std::clamp(dot(a, b) / twice_area, 0.0, 1e6) : 0;
            }
        });
    }

    Vec3 moved(const std::vector<Vec3>& p, Index v, double share) const {
        Vec3 sum;
        double total = 0;
        for (const Index c : at.of(v)) {
            const Index first = c - c % 3, next = first + (c + 1) % 3, previous = first + (c + 2) % 3;
            // Each edge is opposite to the third corner of its triangle.
            sum +=
                (p[corners[next]] - p[v]) * weights[previous] + (p[corners[previous]] - p[v]) * weights[next];
            total += weights[next] + weights[previous];
        }
        return total > 0 ? p[v] + sum * (share / total) : p[v];
    }
};

} // namespace

RelaxStep cotangent_step(const Mesh& mesh, const Neighbourhoods& near, const RelaxSettings& settings) {
    auto cotangents = std::make_shared<Cotangents>(mesh);
    return [&near, &settings, cotangents](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        cotangents->weigh(from);
        const double lambda = relax_lambda(settings);
        parallel_for(from.size(), [&](std::size_t i) {
            const auto v = static_cast<Index>(i);
            const auto others = near.lists.of(v);
            const double share = settings.mask.empty() ? lambda : lambda * settings.mask[v];
            if (others.empty()) {
                to[v] = from[v];
            } else if (!near.along.empty() && near.along[v]) {
                Vec3 sum;
                for (const Index o : others) sum += from[o];
                to[v] = from[v] + (sum / static_cast<double>(others.size()) - from[v]) * share;
            } else {
                to[v] = cotangents->moved(from, v, share);
            }
        });
    };
}

} // namespace facetmill
