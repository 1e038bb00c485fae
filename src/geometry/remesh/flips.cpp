// Flips edges.
#include "geometry/remesh/passes.hpp"

namespace facetmill::remeshing {

double shape_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, bc = c - b;
    const double squares = dot(ab, ab) + dot(ac, ac) + dot(bc, bc);
    return squares > 0 ? 3.4641016151377544 * length(cross(ab, ac)) / squares : 0; // 2 sqrt(3)
}

namespace {

/// The four vertices of two triangles, and the triangles after a flip.
class Diagonals {
  public:
    Diagonals(const WorkingMesh& m, Index h)
        : m_(m), h_(h), a_(m.from(h)), b_(m.to(h)), c_(m.opposite(h)), d_(m.opposite(m.twins[h])) {}

    [[nodiscard]] double shape_before() const { return std::min(shape(a_, b_, c_), shape(b_, a_, d_)); }
    [[nodiscard]] double shape_after() const { return std::min(shape(a_, d_, c_), shape(b_, c_, d_)); }

    /// Whether the flip keeps the topology, and both new faces look like both old ones.
    [[nodiscard]] bool is_allowed() const {
        if (c_ == d_ || m_.degrees[a_] <= 3 || m_.degrees[b_] <= 3) return false;
        for (const Index side : {h_, m_.twins[h_]}) // locked edges keep their half edges
            if ((m_.flags[WorkingMesh::next(side)] | m_.flags[WorkingMesh::previous(side)]) & locked)
                return false;
        const auto many = [&](Index v) { return m_.kinds[v] == VertexKind::many; };
        if (many(c_) && many(d_)) return false;
        Vec3 first = m_.normal(a_, b_, c_), second = m_.normal(b_, a_, d_);
        if (shape(a_, b_, c_) < sliver) first = second;
        if (shape(b_, a_, d_) < sliver) second = first;
        for (const Vec3& before : {first, second})
            for (const Vec3& after : {m_.normal(a_, d_, c_), m_.normal(b_, c_, d_)})
                if (!may_turn(before, after) || !(dot(after, after) > 0)) return false;
        return !m_.are_joined(c_, d_);
    }

    /// How far the numbers of edges at the vertices are from the best, as the sum of squares. edges: the
    /// number to add to the edges of c and d, and to subtract from the edges of a and b.
    [[nodiscard]] int excess(int edges) const {
        return square(a_, -edges) + square(b_, -edges) + square(c_, edges) + square(d_, edges);
    }

  private:
    double shape(Index u, Index v, Index w) const {
        return shape_of(m_.points[u], m_.points[v], m_.points[w]);
    }
    int square(Index v, int more) const {
        if (m_.kinds[v] == VertexKind::many || m_.kinds[v] == VertexKind::fixed) return 0;
        const int best = m_.kinds[v] == VertexKind::line && m_.is_border(v) ? 4 : 6;
        const int off = static_cast<int>(m_.degrees[v]) + more - best;
        return off * off;
    }

    const WorkingMesh& m_;
    Index h_, a_, b_, c_, d_;
};

template <class Better>
std::size_t flip_where(WorkingMesh& m, Better&& better) {
    std::size_t flips = 0;
    for (Index h = 0; h < m.corners.size(); ++h) {
        if (!m.stands(h) || m.flags[h] & feature) continue;
        const Diagonals edge(m, h);
        if (!better(edge) || !edge.is_allowed()) continue;
        m.flip(h);
        ++flips;
    }
    return flips;
}

} // namespace

void flip_towards_six(WorkingMesh& m) {
    flip_where(m, [](const Diagonals& edge) {
        if (edge.excess(1) >= edge.excess(0)) return false;
        const double after = edge.shape_after();
        return after > 0.3 || after > edge.shape_before();
    });
}

std::size_t flip_for_shape(WorkingMesh& m) {
    // A hundredth: so that rounding never flips an edge back and forth.
    return flip_where(m,
                      [](const Diagonals& edge) { return edge.shape_after() > 1.01 * edge.shape_before(); });
}

} // namespace facetmill::remeshing
