#include "geometry/boolean/span_outline.hpp"

#include "base/math/predicates.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

namespace facetmill {

namespace {

constexpr std::size_t max_searched = 400; // about 10 million candidates

Vec3 twice_area(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); }

/// The bend between two faces: 0 if flat, 2 if folded onto each other; 0 next to a face without area.
double dihedral(const Vec3& a, const Vec3& b) {
    const double lengths = std::sqrt(dot(a, a) * dot(b, b));
    return lengths > 0 ? 1 - dot(a, b) / lengths : 0;
}

struct Cost {
    double dihedral = 0, area = 0;
    bool operator<(const Cost& b) const {
        return dihedral != b.dihedral ? dihedral < b.dihedral : area < b.area;
    }
};

/// The costs of the best triangles for the points i .. k, and the third corner of the triangle at the edge i,
/// k.
class Search {
  public:
    Search(const std::vector<Vec3>& points, const std::vector<Vec3>& across)
        : p_(points), across_(across), n_(points.size()), cost_(n_ * n_), apex_(n_ * n_, none) {}

    std::vector<std::array<Index, 3>> run() {
        for (std::size_t span = 2; span < n_; ++span)
            parallel_for(
                n_ - span, [&](std::size_t i) { choose(i, i + span); }, 16);
        std::vector<std::array<Index, 3>> triangles;
        std::vector<std::pair<Index, Index>> stack{{0, static_cast<Index>(n_ - 1)}};
        while (!stack.empty()) {
            const auto [i, k] = stack.back();
            stack.pop_back();
            if (k - i < 2) continue;
            const Index m = apex_[i * n_ + k];
            triangles.push_back({i, m, k});
            stack.emplace_back(m, k);
            stack.emplace_back(i, m);
        }
        return triangles;
    }

  private:
    void choose(std::size_t i, std::size_t k) {
        Cost best;
        Index at = none;
        for (std::size_t m = i + 1; m < k; ++m) {
            const Vec3 normal = twice_area(p_[i], p_[m], p_[k]);
            const Cost &left = cost_[i * n_ + m], &right = cost_[m * n_ + k];
            Cost cost{std::max({left.dihedral, right.dihedral, dihedral_over(i, m, normal),
                                dihedral_over(m, k, normal)}),
                      left.area + right.area + length(normal)};
            if (flat(i, m, k, normal)) cost.dihedral = 3; // used only as a last choice
            if (i == 0 && k + 1 == n_ && !across_.empty())
                cost.dihedral = std::max(cost.dihedral, dihedral(across_[k], normal));
            if (at == none || cost < best) {
                best = cost;
                at = static_cast<Index>(m);
            }
        }
        cost_[i * n_ + k] = best;
        apex_[i * n_ + k] = at;
    }
    /// True if the corner is exactly on the line of the other two. Uses exact arithmetic only where rounding
    /// makes it uncertain.
    bool flat(std::size_t i, std::size_t m, std::size_t k, const Vec3& normal) const {
        const Vec3 u = p_[m] - p_[i], v = p_[k] - p_[i];
        return !(dot(normal, normal) > 1e-20 * dot(u, u) * dot(v, v)) && collinear(p_[i], p_[m], p_[k]);
    }
    /// The bend between a triangle at the edge i, k with this normal and the chosen triangle across that
    /// edge.
    double dihedral_over(std::size_t i, std::size_t k, const Vec3& normal) const {
        if (k - i == 1) return across_.empty() ? 0 : dihedral(across_[i], normal);
        return dihedral(twice_area(p_[i], p_[apex_[i * n_ + k]], p_[k]), normal);
    }

    const std::vector<Vec3>& p_;
    const std::vector<Vec3>& across_;
    std::size_t n_;
    std::vector<Cost> cost_;
    std::vector<Index> apex_;
};

/// Cuts the smallest ears until max_searched corners are left. Returns the corners, and updates the normals
/// across their edges.
std::vector<Index> without_ears(const std::vector<Vec3>& p, std::vector<Vec3>& across,
                                std::vector<std::array<Index, 3>>& ears) {
    const auto n = static_cast<Index>(p.size());
    std::vector<Index> before(n), after(n), version(n, 0);
    for (Index i = 0; i < n; ++i) {
        before[i] = (i + n - 1) % n;
        after[i] = (i + 1) % n;
    }
    using Ear = std::tuple<double, Index, Index>; // size, corner, version
    std::priority_queue<Ear, std::vector<Ear>, std::greater<>> queue;
    const auto push = [&](Index i) {
        queue.emplace(length(twice_area(p[before[i]], p[i], p[after[i]])), i, ++version[i]);
    };
    for (Index i = 0; i < n; ++i) push(i);
    std::vector<std::uint8_t> cut(n, 0);
    for (Index left = n; left > max_searched;) {
        const auto [size, i, v] = queue.top();
        queue.pop();
        if (cut[i] || v != version[i]) continue;
        const Index a = before[i], b = after[i];
        ears.push_back({a, i, b});
        if (!across.empty()) across[a] = twice_area(p[a], p[i], p[b]);
        cut[i] = 1;
        after[a] = b;
        before[b] = a;
        --left;
        push(a);
        push(b);
    }
    std::vector<Index> rest;
    for (Index i = 0; i < n; ++i)
        if (!cut[i]) rest.push_back(i);
    return rest;
}

} // namespace

std::vector<std::array<Index, 3>> span_outline(const std::vector<Vec3>& outline,
                                               const std::vector<Vec3>& across) {
    if (outline.size() < 3) return {};
    if (outline.size() <= max_searched) return Search(outline, across).run();
    std::vector<std::array<Index, 3>> triangles;
    std::vector<Vec3> beyond = across, points, beyond_rest;
    const auto rest = without_ears(outline, beyond, triangles);
    for (const Index i : rest) {
        points.push_back(outline[i]);
        if (!beyond.empty()) beyond_rest.push_back(beyond[i]);
    }
    for (const auto& t : Search(points, beyond_rest).run())
        triangles.push_back({rest[t[0]], rest[t[1]], rest[t[2]]});
    return triangles;
}

} // namespace facetmill
