// Splits long edges, and collapses short ones.
#include "geometry/remesh/passes.hpp"

#include "parallel/parallel.hpp"

#include <tuple>

namespace facetmill::remeshing {

namespace {

constexpr double longest_share = 4.0 / 3, shortest_share = 4.0 / 5;
/// A feature line may move by this share of the intended length.
constexpr double line_slack = 0.05;

/// An edge that a pass will visit. It is skipped if its ends changed in the meantime.
struct Candidate {
    double share; ///< its length divided by the intended length
    Index h, from, to;
    bool is_current(const WorkingMesh& m) const { return m.corners[h] == from && m.to(h) == to; }
};

/// The edges whose share of the intended length fits, in order. sign: 1 for ascending lengths.
template <class Fits>
std::vector<Candidate> candidates(const WorkingMesh& m, double sign, Fits&& fits) {
    std::vector<std::vector<Candidate>> chunks((m.corners.size() + default_chunk - 1) / default_chunk);
    parallel_chunks(m.corners.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Candidate>& mine = chunks[begin / default_chunk];
        for (auto h = static_cast<Index>(begin); h < end; ++h) {
            if (!m.stands(h) || (m.flags[h] & locked && !m.leads_ring(h))) continue;
            const double share = m.edge_length(h) / m.size_of(h);
            if (fits(share)) mine.push_back({share, h, m.from(h), m.to(h)});
        }
    });
    std::vector<Candidate> all;
    for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
    std::sort(all.begin(), all.end(), [&](const Candidate& a, const Candidate& b) {
        return a.share != b.share ? sign * a.share < sign * b.share : a.h < b.h;
    });
    return all;
}

/// Whether the faces of the edge keep their normals with the new vertex.
bool may_split(const WorkingMesh& m, Index h, const Vec3& point) {
    // Two faces with the same corners would get two edges between the same vertices.
    if (m.twins[h] != none && m.opposite(h) == m.opposite(m.twins[h])) return false;
    for (const Index side : {h, m.twins[h]}) {
        if (side == none) continue;
        const Vec3 &a = m.points[m.from(side)], &b = m.points[m.to(side)], &c = m.points[m.opposite(side)];
        const Vec3 before = cross(b - a, c - a);
        if (!may_turn(before, cross(point - a, c - a)) || !may_turn(before, cross(b - point, c - point)))
            return false;
    }
    return true;
}

/// The point of the input for the middle of an edge; none if it is far from the edge.
std::optional<Spot> middle_of(const WorkingMesh& m, const Anchor& anchor, Index h) {
    const Vec3 &a = m.points[m.from(h)], &b = m.points[m.to(h)], middle = (a + b) * 0.5;
    if (m.flags[h] & locked) return Spot{middle, m.size_of(h), m.hints[m.from(h)], {}}; // never moved
    const auto spot =
        m.flags[h] & feature ? anchor.on_lines(middle) : anchor.on_surface(middle, m.hints[m.from(h)]);
    if (!spot || !(length(spot->point - middle) < 0.3 * length(b - a))) return {};
    return spot;
}

/// Checks and performs collapses.
class Collapser {
  public:
    Collapser(WorkingMesh& mesh, const Anchor& anchor) : m_(mesh), anchor_(anchor) {
        marks_.resize(mesh.points.size());
    }

    /// Collapses h into its second vertex, if allowed.
    bool collapse(Index h) {
        if (!may_collapse(h)) return false;
        m_.collapse(h);
        return true;
    }

  private:
    bool may_collapse(Index h) {
        const Index a = m_.from(h), b = m_.to(h);
        if (m_.flags[h] & locked || m_.kinds[b] == VertexKind::many) return false;
        if (m_.kinds[a] == VertexKind::line) {
            if (!(m_.flags[h] & feature) || m_.kinds[b] == VertexKind::free || !keeps_line(h)) return false;
        } else if (m_.kinds[a] != VertexKind::free)
            return false;
        return keeps_shape(h) && keeps_topology(h); // the faster check comes first
    }

    /// The link condition, and no face left with two borders.
    bool keeps_topology(Index h) {
        const Index a = m_.from(h), b = m_.to(h), twin = m_.twins[h];
        for (const Index side : {h, twin}) {
            if (side == none) continue;
            const Index x = WorkingMesh::next(side), y = WorkingMesh::previous(side);
            if (m_.twins[x] == none && m_.twins[y] == none) return false;
            if ((m_.flags[x] | m_.flags[y]) & locked) return false;
            // Two edges fall together; at most one may be a feature, because the face between them is
            // removed.
            if (m_.flags[x] & feature && m_.flags[y] & feature) return false;
            if (m_.degrees[m_.opposite(side)] <= 3) return false;
        }
        ++mark_;
        m_.neighbours(a, [&](Index v) { marks_[v] = mark_; });
        Index common = 0;
        m_.neighbours(b, [&](Index v) { common += marks_[v] == mark_; });
        return common == (twin == none ? 1U : 2U);
    }

    /// The new edges are not too long, and the faces keep their normals and do not become slivers.
    bool keeps_shape(Index h) const {
        const Index a = m_.from(h), b = m_.to(h);
        const Vec3 &old = m_.points[a], &place = m_.points[b];
        double worst_before = 1, worst_after = 1;
        const auto is_too_long = [&](Index p) {
            const double most = longest_share * std::min(m_.sizes[p], m_.sizes[b]);
            const Vec3 edge = m_.points[p] - place;
            return dot(edge, edge) > most * most;
        };
        Vec3 mean; // the normal of all faces together
        m_.around(a, [&](Index leaving) {
            mean += m_.face_normal(leaving / 3);
            return true;
        });
        const bool kept = m_.around(a, [&](Index leaving) {
            const Index p = m_.to(leaving), q = m_.opposite(leaving);
            const Vec3 &v = m_.points[p], &w = m_.points[q];
            const double shape = shape_of(old, v, w);
            worst_before = std::min(worst_before, shape);
            if (p == b || q == b) return true;
            if (is_too_long(p) || is_too_long(q)) return false;
            if (!may_turn(shape < sliver ? mean : cross(v - old, w - old), cross(v - place, w - place)))
                return false;
            worst_after = std::min(worst_after, shape_of(place, v, w));
            return true;
        });
        return kept && worst_after > 0 && (worst_after > 0.2 || worst_after >= worst_before);
    }

    /// The line without the first vertex of h is near the line of the input.
    bool keeps_line(Index h) const {
        const Index a = m_.from(h), b = m_.to(h);
        Index before = none;
        m_.around(a, [&](Index leaving) {
            if (m_.flags[leaving] & feature && m_.to(leaving) != b) before = m_.to(leaving);
            const Index entering = WorkingMesh::previous(leaving);
            if (m_.flags[entering] & feature && m_.from(entering) != b) before = m_.from(entering);
            return true;
        });
        if (before == none) return false;
        const Vec3 &p = m_.points[before], &q = m_.points[b];
        const double slack = line_slack * std::min({m_.sizes[a], m_.sizes[b], m_.sizes[before]});
        if (length(q - p) > longest_share * std::min(m_.sizes[before], m_.sizes[b])) return false;
        if (!(length(m_.points[a] - closest_on_triangle(m_.points[a], p, q, q)) <= slack)) return false;
        for (const double t : {0.25, 0.5, 0.75}) {
            const Vec3 at = mix(p, q, t);
            const auto spot = anchor_.on_lines(at);
            if (!spot || !(length(spot->point - at) <= slack)) return false;
        }
        return true;
    }

    WorkingMesh& m_;
    const Anchor& anchor_;
    std::vector<Index> marks_; ///< [vertices] number of the last collapse that visited it
    Index mark_ = 0;
};

} // namespace

void split_long_edges(WorkingMesh& m, const Anchor& anchor) {
    constexpr int most_passes = 64; // each halves the longest edges
    for (int pass = 0; pass < most_passes; ++pass) {
        const auto all = candidates(m, -1, [](double share) { return share > longest_share; });
        std::vector<std::optional<Spot>> spots(all.size());
        parallel_for(
            all.size(), [&](std::size_t i) { spots[i] = middle_of(m, anchor, all[i].h); }, 256);
        std::size_t done = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!spots[i] || !all[i].is_current(m) || !may_split(m, all[i].h, spots[i]->point)) continue;
            const Index hint = spots[i]->hint != none ? spots[i]->hint : m.hints[all[i].from];
            if (m.flags[all[i].h] & locked)
                m.split_locked(all[i].h, spots[i]->point, spots[i]->size, hint);
            else
                m.split(all[i].h, spots[i]->point, spots[i]->size, hint);
            ++done;
        }
        if (done == 0) return;
    }
}

void collapse_short_edges(WorkingMesh& m, const Anchor& anchor) {
    constexpr int most_passes = 32;
    Collapser collapser(m, anchor);
    for (int pass = 0; pass < most_passes; ++pass) {
        const auto all = candidates(m, 1, [](double share) { return share < shortest_share; });
        std::size_t done = 0;
        for (const Candidate& c : all) {
            if (!c.is_current(m)) continue;
            if (collapser.collapse(c.h))
                ++done;
            else if (m.twins[c.h] != none)
                done += collapser.collapse(m.twins[c.h]);
        }
        if (100 * done <= all.size()) return;
    }
}

} // namespace facetmill::remeshing
