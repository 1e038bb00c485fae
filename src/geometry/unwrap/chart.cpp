#include "geometry/unwrap/chart.hpp"

#include "geometry/unwrap/untangle.hpp"

#include <Eigen/SparseCholesky>
#include <numeric>

namespace facetmill::unwrap_room {

namespace {

/// Relaxation ends when the mean move is below this share of the mean edge.
constexpr double settled = 2e-3;

using Matrix = Eigen::SparseMatrix<double>;

/// Two vectors that make a right-handed frame with the normal.
std::array<Vec3, 2> frame_around(const Vec3& normal) {
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(normal[i]) < std::abs(normal[least])) least = i;
    Vec3 axis;
    axis[least] = 1;
    const Vec3 u = normalised(cross(axis, normal));
    return {u, cross(normal, u)};
}

/// Lowest members of sets of few items.
class SmallSets {
  public:
    explicit SmallSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
    Index find(Index i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(Index a, Index b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<Index> parent_;
};

} // namespace

FlatChart::FlatChart(const UnwrapSurface& surface, Gluing& gluing, std::span<const Index> faces)
    : surface_(surface), faces_(faces), corners_(3 * faces.size()) {
    for (std::size_t i = 0; i < faces.size(); ++i) gluing.place_of_face[faces[i]] = static_cast<Index>(i);
    SmallSets sets(corners_.size());
    const auto local = [&](Index corner) { return 3 * gluing.place_of_face[corner / 3] + corner % 3; };
    for (const Index f : faces)
        for (Index c = 3 * f; c < 3 * f + 3; ++c) {
            const Index t = surface.twin[c];
            if (t == none || t < c || !gluing.glued[c]) continue;
            sets.join(local(c), local(next_of(t)));
            sets.join(local(next_of(c)), local(t));
        }
    Index points = 0;
    for (Index c = 0; c < corners_.size(); ++c) {
        const Index root = sets.find(c);
        corners_[c] = root == c ? points++ : corners_[root];
    }
    points_.resize(points);
    find_border(gluing);
}

void FlatChart::find_border(const Gluing& gluing) {
    for (std::size_t i = 0; i < faces_.size(); ++i)
        for (Index k = 0; k < 3; ++k) {
            const auto c = static_cast<Index>(3 * i + k);
            if (!gluing.glued[3 * faces_[i] + k]) border_.push_back({corners_[c], corners_[next_of(c)], c});
        }
}

void FlatChart::project() {
    if (faces_.size() == 1) {
        for (std::size_t i = 0; i < 3; ++i) points_[i] = shape(0).corner(i);
        return;
    }
    Vec3 normal;
    for (const Index f : faces_) normal += surface_.area_vectors[f];
    normal = normalised(normal);
    if (!(dot(normal, normal) > 0)) normal = {0, 0, 1};
    const auto [u, v] = frame_around(normal);
    for (std::size_t c = 0; c < corners_.size(); ++c) {
        const Vec3& p = surface_.point(3 * faces_[c / 3] + static_cast<Index>(c % 3));
        points_[corners_[c]] = {dot(u, p), dot(v, p)};
    }
}

void FlatChart::start_from(const Gluing& gluing) {
    std::vector<double> count(points_.size());
    std::fill(points_.begin(), points_.end(), Vec2{});
    for (std::size_t c = 0; c < corners_.size(); ++c) {
        const Vec2& at = gluing.at[3 * faces_[c / 3] + c % 3];
        points_[corners_[c]] = points_[corners_[c]] + at;
        ++count[corners_[c]];
    }
    for (std::size_t p = 0; p < points_.size(); ++p) points_[p] = points_[p] * (1 / count[p]);
}

void FlatChart::pull_rigidly(const std::vector<double>& weights, Eigen::MatrixX2d& right) const {
    right.setZero();
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        // The rotation that is nearest to the map of the triangle.
        double c = 0, s = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 from = shape(i).edge(k), to = corner(i, (k + 1) % 3) - corner(i, k);
            c += weights[3 * i + k] * dot(from, to);
            s += weights[3 * i + k] * cross(from, to);
        }
        const double r = std::sqrt(c * c + s * s);
        c = r > 0 ? c / r : 1;
        s = r > 0 ? s / r : 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 e = shape(i).edge(k) * weights[3 * i + k];
            const Vec2 turned{c * e.x - s * e.y, s * e.x + c * e.y};
            const auto a = static_cast<Eigen::Index>(corners_[3 * i + k]),
                       b = static_cast<Eigen::Index>(corners_[3 * i + (k + 1) % 3]);
            right(a, 0) -= turned.x;
            right(a, 1) -= turned.y;
            right(b, 0) += turned.x;
            right(b, 1) += turned.y;
        }
    }
}

void FlatChart::relax(int rounds) {
    if (faces_.size() == 1) return;
    const auto n = static_cast<Eigen::Index>(points_.size());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * faces_.size() + 1);
    std::vector<double> weights(corners_.size());
    double edges = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const double w = weights[3 * i + k] = shape(i).cotangent(k);
            edges += length(shape(i).edge(k));
            const auto a = static_cast<int>(corners_[3 * i + k]),
                       b = static_cast<int>(corners_[3 * i + (k + 1) % 3]);
            entries.emplace_back(a, a, w);
            entries.emplace_back(b, b, w);
            entries.emplace_back(std::max(a, b), std::min(a, b), -w);
        }
    entries.emplace_back(0, 0, 1.0); // holds the first point, since the energy is free under translation
    const Vec2 held = points_[0];
    Matrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver(matrix);
    if (solver.info() != Eigen::Success) return;
    const double still = settled * edges / static_cast<double>(corners_.size());
    Eigen::MatrixX2d right(n, 2), solved;
    for (int round = 0; round < rounds; ++round) {
        pull_rigidly(weights, right);
        right(0, 0) += held.x;
        right(0, 1) += held.y;
        solved = solver.solve(right);
        double moved = 0;
        for (Eigen::Index p = 0; p < n; ++p) {
            const Vec2 to{solved(p, 0), solved(p, 1)};
            if (!std::isfinite(to.x) || !std::isfinite(to.y)) return;
            moved += length(to - points_[static_cast<std::size_t>(p)]);
            points_[static_cast<std::size_t>(p)] = to;
        }
        if (moved < still * static_cast<double>(n)) return;
    }
}

void FlatChart::untangle() {
    std::vector<FlatShape> shapes(faces_.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) shapes[i] = shape(i);
    untangle_triangles(corners_, shapes, points_);
}

ChartMeasure FlatChart::measure() {
    ChartMeasure m;
    double flat = 0, thin = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        m.area += shape(i).area();
        flat += doubled_area(i) / 2;
    }
    if (!(flat > 0)) return m;
    const double scale = std::sqrt(m.area / flat);
    for (Vec2& p : points_) p = p * scale;
    if (!all_turn_left(corners_, points_) || !is_simple_border(border_, points_)) return m;
    m.valid = true;
    double squares = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const double area = shape(i).area();
        if (surface_.is_thin[faces_[i]]) {
            thin += area;
            continue;
        }
        // The map from the texture to the plane of the triangle, J: J a = e0, J b = e1.
        const Vec2 a = corner(i, 1) - corner(i, 0), b = corner(i, 2) - corner(i, 0);
        const Vec2 e0 = shape(i).corner(1), e1 = shape(i).corner(2);
        const double det = cross(a, b);
        const Vec2 ju = (e0 * b.y - e1 * a.y) * (1 / det), jv = (e1 * a.x - e0 * b.x) * (1 / det);
        const double uu = dot(ju, ju), vv = dot(jv, jv), uv = dot(ju, jv);
        const double root = std::sqrt((uu - vv) * (uu - vv) + 4 * uv * uv);
        const double most = std::sqrt((uu + vv + root) / 2), both = std::abs(cross(ju, jv));
        squares += area * (uu + vv) / 2;
        m.stretch.largest = std::max(m.stretch.largest, most);
        m.stretch.ratio = std::max(m.stretch.ratio, most * most / both);
    }
    m.stretch.l2 = m.area > thin ? std::sqrt(squares / (m.area - thin)) : 1;
    return m;
}

void FlatChart::store(Gluing& gluing) const {
    for (std::size_t c = 0; c < corners_.size(); ++c)
        gluing.at[3 * faces_[c / 3] + c % 3] = points_[corners_[c]];
}

} // namespace facetmill::unwrap_room
