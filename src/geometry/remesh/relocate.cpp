// Moves vertices along the surface.
#include "geometry/remesh/passes.hpp"

#include "parallel/parallel.hpp"

namespace facetmill::remeshing {

namespace {

/// Moves a free vertex along its tangent plane to the mean of the centres of its faces, weighted by their
/// share of the intended areas, and then onto the surface.
std::optional<Spot> freely_moved(const WorkingMesh& m, const Anchor& anchor, Index v) {
    const Vec3& p = m.points[v];
    Vec3 normal, sum;
    double weights = 0;
    m.around(v, [&](Index h) {
        const Index q = m.to(h), r = m.opposite(h);
        const Vec3 n = cross(m.points[q] - p, m.points[r] - p);
        const double size = m.sizes[v] + m.sizes[q] + m.sizes[r], weight = length(n) / (size * size);
        normal += n;
        sum += (m.points[q] + m.points[r] - p * 2) * (weight / 3);
        weights += weight;
        return true;
    });
    normal = normalised(normal);
    if (!(weights > 0)) return {};
    const Vec3 move = sum / weights;
    const auto spot = anchor.on_surface(p + move - normal * dot(normal, move), m.hints[v]);
    if (!spot || !(dot(spot->normal, normal) > 0)) return {};
    return spot;
}

/// Moves a vertex of a line halfway to the middle of its neighbours, unless the line turns at the vertex.
std::optional<Spot> moved_along(const WorkingMesh& m, const Anchor& anchor, Index v) {
    constexpr double straight = 0.94; // cosine of 20 degrees
    const auto ends = m.line_ends(v);
    if (!ends) return {};
    const Vec3 &p = m.points[v], &q = m.points[(*ends)[0]], &r = m.points[(*ends)[1]];
    if (!(dot(normalised(p - q), normalised(r - p)) > straight)) return {};
    const Vec3 along = normalised(r - q), move = along * (dot(along, (q + r) * 0.5 - p) * 0.5);
    auto spot = anchor.on_lines(p + move);
    if (!spot || length(spot->point - p - move) > 0.5 * length(move)) return {};
    spot->hint = m.hints[v];
    return spot;
}

/// Keeps the vertices of faces that would turn at their old positions, until no face turns.
void hold_turning_faces(const WorkingMesh& m, std::vector<Spot>& spots) {
    std::vector<std::uint8_t> turns(m.face_slots());
    for (std::size_t held = 1; held > 0;) {
        parallel_for(turns.size(), [&](std::size_t i) {
            const auto f = static_cast<Index>(i);
            turns[i] = 0;
            if (!m.is_face(f)) return;
            const Vec3 &a = spots[m.corners[3 * f]].point, &b = spots[m.corners[3 * f + 1]].point,
                       &c = spots[m.corners[3 * f + 2]].point;
            turns[i] = !may_turn(m.face_normal(f), cross(b - a, c - a));
        });
        held = 0;
        for (Index f = 0; f < turns.size(); ++f) {
            if (!turns[f]) continue;
            for (Index k = 0; k < 3; ++k) {
                const Index v = m.corners[3 * f + k];
                held += !(spots[v].point == m.points[v]);
                spots[v] = {m.points[v], m.sizes[v], m.hints[v], {}};
            }
        }
    }
}

} // namespace

void relocate(WorkingMesh& m, const Anchor& anchor) {
    std::vector<Spot> spots(m.points.size());
    parallel_for(
        spots.size(),
        [&](std::size_t i) {
            const auto v = static_cast<Index>(i);
            spots[i] = {m.points[i], m.sizes[i], m.hints[i], {}};
            if (m.out[i] == none) return;
            std::optional<Spot> moved;
            if (m.kinds[i] == VertexKind::free) moved = freely_moved(m, anchor, v);
            if (m.kinds[i] == VertexKind::line) moved = moved_along(m, anchor, v);
            if (moved) spots[i] = *moved;
        },
        1024);
    hold_turning_faces(m, spots);
    parallel_for(spots.size(), [&](std::size_t i) {
        m.points[i] = spots[i].point;
        m.sizes[i] = spots[i].size;
        m.hints[i] = spots[i].hint;
    });
}

} // namespace facetmill::remeshing
