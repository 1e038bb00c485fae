// From the working state back to a mesh, and from the log of collapses to the attributes.
//
// The attributes of a vertex that moved are those of the surface that came in at the nearest point of the
// faces around all the vertices that went into it; of a vertex on a feature line, at the nearest point of
// that line. So a texture cannot slide farther than the surface moves, both sides of a seam are taken at the
// same place, and nothing is blurred by mixing mixtures. (Mixing the two ends at every collapse drifted.)

#include "base/parallel.hpp"
#include "geometry/simplify/work.hpp"
#include "mesh/lineage.hpp"

namespace facetmill::simplification {

namespace {

/// A point as a mix of up to three elements; weight 0 for those not needed.
struct Mix {
    std::array<Index, 3> of{none, none, none};
    std::array<double, 3> weight{1, 0, 0};
    double distance = HUGE_VAL; ///< squared
};

/// Parameter of the point of a segment that is nearest to p, 0 at a.
double nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 edge = b - a;
    const double squared = dot(edge, edge);
    return squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
}

/// Weights of the corners at the point of a triangle that is nearest to p.
std::array<double, 3> nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& q) {
    const Vec3 u = q[1] - q[0], v = q[2] - q[0], d = p - q[0];
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), du = dot(d, u), dv = dot(d, v);
    const double det = uu * vv - uv * uv;
    if (det > 0) {
        const double s = (vv * du - uv * dv) / det, t = (uu * dv - uv * du) / det;
        if (s >= 0 && t >= 0 && s + t <= 1) return {1 - s - t, s, t};
    }
    std::array<double, 3> best{1, 0, 0};
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = (k + 1) % 3;
        const double t = nearest_on_segment(p, q[k], q[n]);
        const Vec3 off = mix(q[k], q[n], t) - p;
        if (!(dot(off, off) < least)) continue;
        least = dot(off, off);
        best = {0, 0, 0};
        best[k] = 1 - t, best[n] = t;
    }
    return best;
}

/// Follows the elements of one domain (vertices or wedges) from the mesh that came in to the one that goes
/// out.
class Followed {
  public:
    /// survivors: the old element of each new one; vertex_of: the new vertex of each; element: the old one at
    /// a corner.
    template <class Element>
    Followed(const Work& s, const Mesh& from, std::size_t old_count, const std::vector<Index>& survivors,
             const std::vector<Index>& vertex_of, const std::vector<Merge>& merges, Element&& element)
        : s_(s), from_(from), survivors_(survivors), vertex_of_(vertex_of) {
        find_owners(old_count, merges);
        corner_element_.resize(from.corner_count());
        parallel_for(corner_element_.size(),
                     [&](std::size_t c) { corner_element_[c] = element(static_cast<Index>(c)); });
        gather_faces();
    }

    Lineage lineage() const {
        std::vector<Mix> mixes(survivors_.size());
        parallel_for(
            mixes.size(), [&](std::size_t e) { mixes[e] = mix_of(static_cast<Index>(e)); }, 1024);
        Lineage lineage;
        lineage.mix_offsets.assign(1, 0);
        for (const Mix& m : mixes) {
            for (std::size_t k = 0; k < 3; ++k)
                if (m.weight[k] > 0)
                    lineage.mix_sources.push_back(m.of[k]), lineage.mix_weights.push_back(m.weight[k]);
            lineage.mix_offsets.push_back(static_cast<Index>(lineage.mix_sources.size()));
        }
        return lineage;
    }

  private:
    bool moved(Index e) const { return s_.moved[vertex_of_[e]] != 0; }

    /// The new element that each old one became part of, from the last merge to the first.
    void find_owners(std::size_t old_count, const std::vector<Merge>& merges) {
        owner_.assign(old_count, none);
        for (std::size_t e = 0; e < survivors_.size(); ++e) owner_[survivors_[e]] = static_cast<Index>(e);
        for (auto m = merges.rbegin(); m != merges.rend(); ++m) owner_[m->b] = owner_[m->a];
    }

    /// Calls body(new element) for each moved one that a face had part in, each once.
    template <class Body>
    void owners_of(Index f, Body&& body) const {
        const auto owner = [&](Index k) { return owner_[corner_element_[3 * f + k]]; };
        for (Index k = 0; k < 3; ++k) {
            const Index e = owner(k);
            if (e == none || !moved(e) || (k > 0 && e == owner(0)) || (k > 1 && e == owner(1))) continue;
            body(e);
        }
    }

    void gather_faces() {
        begin_.assign(survivors_.size() + 1, 0);
        const auto faces = static_cast<Index>(from_.face_count());
        for (Index f = 0; f < faces; ++f) owners_of(f, [&](Index e) { ++begin_[e]; });
        faces_.resize(exclusive_scan(begin_));
        std::vector<Index> at(begin_.begin(), begin_.end() - 1);
        for (Index f = 0; f < faces; ++f) owners_of(f, [&](Index e) { faces_[at[e]++] = f; });
    }

    Mix mix_of(Index e) const {
        Mix best;
        best.of[0] = survivors_[e];
        if (!moved(e)) return best;
        const Index v = vertex_of_[e];
        const Vec3 p = s_.at[v] / s_.scale + s_.centre;
        if (!s_.features_given.empty())
            for (Index i = begin_[e]; i < begin_[e + 1]; ++i) try_lines(e, faces_[i], p, best);
        if (best.distance == HUGE_VAL)
            for (Index i = begin_[e]; i < begin_[e + 1]; ++i) try_face(faces_[i], p, best);
        order(best);
        return best;
    }

    void try_face(Index f, const Vec3& p, Mix& best) const {
        const std::array<Vec3, 3> q{from_.point(3 * f), from_.point(3 * f + 1), from_.point(3 * f + 2)};
        const auto w = nearest_on_triangle(p, q);
        const Vec3 off = q[0] * w[0] + q[1] * w[1] + q[2] * w[2] - p;
        if (!(dot(off, off) < best.distance)) return;
        best.distance = dot(off, off);
        for (std::size_t k = 0; k < 3; ++k) best.of[k] = corner_element_[3 * f + k], best.weight[k] = w[k];
    }

    /// The feature edges of a face that lead from an element of e; from the lower vertex, so that both sides
    /// of a seam get the same numbers.
    void try_lines(Index e, Index f, const Vec3& p, Mix& best) const {
        for (Index k = 0; k < 3; ++k) {
            Index a = 3 * f + k, b = 3 * f + (k + 1) % 3;
            if (!s_.features_given[a]) continue;
            if (owner_[corner_element_[a]] != e && owner_[corner_element_[b]] != e) continue;
            if (from_.vertex(a) > from_.vertex(b)) std::swap(a, b);
            const double t = nearest_on_segment(p, from_.point(a), from_.point(b));
            const Vec3 off = mix(from_.point(a), from_.point(b), t) - p;
            if (!(dot(off, off) < best.distance)) continue;
            best = {{corner_element_[a], corner_element_[b], none}, {1 - t, t, 0}, dot(off, off)};
        }
    }

    /// The heaviest first: what cannot be mixed comes from it.
    static void order(Mix& m) {
        for (const std::size_t k : {1u, 2u})
            if (m.weight[k] > m.weight[0]) std::swap(m.weight[k], m.weight[0]), std::swap(m.of[k], m.of[0]);
    }

    const Work& s_;
    const Mesh& from_;
    const std::vector<Index>&survivors_, &vertex_of_;
    std::vector<Index> owner_, corner_element_; ///< old elements -> new ones; corners -> old elements
    std::vector<Index> begin_, faces_;          ///< of each new element: faces that had part in it
};

/// Fills corners and wedge_vertex; returns the wedges of the input that survive, in the order of the new
/// ones.
std::vector<Index> number_wedges(Mesh& to, const Work& s, std::size_t old_wedges) {
    if (s.wedge.empty()) {
        to.corners = s.tri;
        return {};
    }
    std::vector<Index> number(old_wedges, none), survivors;
    to.corners.resize(s.wedge.size());
    for (std::size_t c = 0; c < s.wedge.size(); ++c) {
        Index& n = number[s.wedge[c]];
        if (n == none) {
            n = static_cast<Index>(survivors.size());
            survivors.push_back(s.wedge[c]);
            to.wedge_vertex.push_back(s.tri[c]);
        }
        to.corners[c] = n;
    }
    return survivors;
}

Lineage copies(std::vector<Index> old) {
    Lineage lineage;
    lineage.copies = std::move(old);
    return lineage;
}

/// The same number for each: vertex v is vertex v.
std::vector<Index> identity(std::size_t n) {
    std::vector<Index> list(n);
    parallel_for(n, [&](std::size_t i) { list[i] = static_cast<Index>(i); });
    return list;
}

} // namespace

Mesh finished(Work& s, const Mesh& from, Fates& fates, std::vector<Index>& wedges) {
    compact(s);
    Mesh to;
    to.positions.resize(s.vertex_slots());
    parallel_for(to.positions.size(), [&](std::size_t v) {
        to.positions[v] = s.moved[v] ? s.at[v] / s.scale + s.centre : from.positions[s.source[v]];
    });
    wedges = number_wedges(to, s, from.wedge_count());
    Descent descent;
    descent.faces = s.face_source;
    const bool seams = !s.wedge.empty(), any_moved = !s.log.steps.empty();
    const bool follow_vertices = any_moved && (has_attributes(from, Domain::vertex) ||
                                               (!seams && has_attributes(from, Domain::wedge)));
    if (follow_vertices) {
        std::vector<Merge> merges;
        merges.reserve(s.log.steps.size());
        for (const Step& step : s.log.steps) merges.push_back({step.a, step.b});
        descent.vertices = Followed(s, from, from.vertex_count(), s.source, identity(s.vertex_slots()),
                                    merges, [&](Index c) { return from.vertex(c); })
                               .lineage();
    } else {
        descent.vertices = copies(s.source);
    }
    if (!seams)
        descent.wedges = descent.vertices;
    else if (any_moved && has_attributes(from, Domain::wedge))
        descent.wedges =
            Followed(s, from, from.wedge_count(), wedges, to.wedge_vertex, s.log.wedges, [&](Index c) {
                return from.corners[c];
            }).lineage();
    else
        descent.wedges = copies(wedges);
    fates = inherit_attributes(to, from, descent);
    return to;
}

} // namespace facetmill::simplification
