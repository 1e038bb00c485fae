#include "geometry/relax/steps.hpp"

#include "base/error.hpp"
#include "parallel/parallel.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <memory>

namespace facetmill {

namespace {

using Method = RelaxSettings::Method;

/// hc: partly reverses the laplacian step from q to p. The pull-back mixes the vertex's own difference from
/// its target position with the mean difference of its neighbours.
RelaxStep hc_step(const Neighbourhoods& near, const RelaxSettings& settings, const std::vector<Vec3>& start) {
    auto difference = std::make_shared<std::vector<Vec3>>(start.size());
    return [&, difference](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        umbrella_step(from, to, near.lists, relax_lambda(settings), settings.mask);
        auto& b = *difference;
        parallel_for(from.size(), [&](std::size_t v) {
            b[v] = to[v] - (start[v] * settings.alpha + from[v] * (1 - settings.alpha));
        });
        parallel_for(from.size(), [&](std::size_t v) {
            const auto others = near.lists.of(static_cast<Index>(v));
            if (others.empty()) return;
            Vec3 sum;
            for (const Index o : others) sum += b[o];
            to[v] -= b[v] * settings.beta + sum * ((1 - settings.beta) / static_cast<double>(others.size())) *
                                                (settings.mask.empty() ? 1 : settings.mask[v]);
        });
    };
}

RelaxStep taubin_step(const Neighbourhoods& near, const RelaxSettings& settings) {
    const double in = relax_lambda(settings), out = 1 / (settings.pass_band - 1 / in);
    auto middle = std::make_shared<std::vector<Vec3>>();
    return [&near, &settings, in, out, middle](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        middle->resize(from.size());
        umbrella_step(from, *middle, near.lists, in, settings.mask);
        umbrella_step(*middle, to, near.lists, out, settings.mask);
    };
}

} // namespace

double relax_lambda(const RelaxSettings& s) {
    return s.lambda.value_or(s.method == Method::taubin ? 0.5 : 1);
}

void umbrella_step(const std::vector<Vec3>& from, std::vector<Vec3>& to, const VertexLists& near,
                   double lambda, const std::vector<double>& mask) {
    const Vec3* const p = from.data();
    parallel_chunks(from.size(), [&](std::size_t begin, std::size_t end) {
        const Index* other = near.items.data() + near.offsets[begin];
        for (std::size_t v = begin; v < end; ++v) {
            const Index* const last = near.items.data() + near.offsets[v + 1];
            if (other == last) {
                to[v] = p[v];
                continue;
            }
            const auto n = static_cast<double>(last - other);
            Vec3 sum;
            for (; other != last; ++other) sum += p[*other];
            const Vec3 mean = sum / n;
            const double share = mask.empty() ? lambda : lambda * mask[v];
            to[v] = share == 1 ? mean : p[v] + (mean - p[v]) * share;
        }
    });
}

RelaxStep relax_step(const Mesh& mesh, const Neighbourhoods& near, const RelaxSettings& settings,
                     const std::vector<Vec3>& start) {
    switch (settings.method) {
    case Method::taubin:
        return taubin_step(near, settings);
    case Method::cotangent:
        return cotangent_step(mesh, near, settings);
    case Method::implicit:
        return implicit_step(near, settings);
    case Method::hc:
        return hc_step(near, settings, start);
    case Method::laplacian:
        break;
    }
    return [&near, &settings](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        umbrella_step(from, to, near.lists, relax_lambda(settings), settings.mask);
    };
}

namespace {

/// The triangles of the faces, the corners at each vertex, and a weight for each corner.
struct Cotangents {
    std::vector<Index> corners; ///< vertices, three per triangle
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

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The unknown vertices of a linear system; all others are known. Symmetric and positive definite: with n
/// neighbours, mask w and lambda f the row of vertex v is n / w (x - p) + f sum(x - xj) = 0.
class System {
  public:
    System(const VertexLists& near, std::vector<Index> unknown, double lambda,
           const std::vector<double>& mask)
        : near_(near), unknown_(std::move(unknown)), lambda_(lambda), mask_(mask) {
        rows_.assign(near.offsets.size() - 1, none);
        for (std::size_t i = 0; i < unknown_.size(); ++i) rows_[unknown_[i]] = static_cast<Index>(i);
        fill();
    }

    /// Solves for the unknown positions; `places` has the known positions. start: the positions before the
    /// step.
    void solve(const std::vector<Vec3>& start, std::vector<Vec3>& places) const {
        if (unknown_.empty()) return;
        Eigen::VectorXd solution[3];
        parallel_for(
            3, [&](std::size_t axis) { solution[axis] = solved(start, places, axis); }, 1);
        for (std::size_t i = 0; i < unknown_.size(); ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                places[unknown_[i]][axis] = solution[axis][static_cast<Eigen::Index>(i)];
    }

  private:
    double mass(Index v) const {
        return static_cast<double>(near_.of(v).size()) / (mask_.empty() ? 1 : mask_[v]);
    }

    void fill() {
        std::vector<Eigen::Triplet<double>> entries;
        for (std::size_t i = 0; i < unknown_.size(); ++i) {
            const auto row = static_cast<int>(i);
            const auto others = near_.of(unknown_[i]);
            entries.emplace_back(row, row, mass(unknown_[i]) + lambda_ * static_cast<double>(others.size()));
            for (const Index o : others)
                if (rows_[o] != none) entries.emplace_back(row, static_cast<int>(rows_[o]), -lambda_);
        }
        const auto n = static_cast<Eigen::Index>(unknown_.size());
        matrix_.resize(n, n);
        matrix_.setFromTriplets(entries.begin(), entries.end());
    }

    Eigen::VectorXd solved(const std::vector<Vec3>& start, const std::vector<Vec3>& places,
                           std::size_t axis) const {
        const auto n = static_cast<Eigen::Index>(unknown_.size());
        Eigen::VectorXd right(n), guess(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Index v = unknown_[static_cast<std::size_t>(i)];
            guess[i] = start[v][axis];
            right[i] = mass(v) * start[v][axis];
            for (const Index o : near_.of(v))
                if (rows_[o] == none) right[i] += lambda_ * places[o][axis];
        }
        Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
        solver.setTolerance(1e-10);
        solver.compute(matrix_);
        Eigen::VectorXd x = solver.solveWithGuess(right, guess);
        if (solver.info() != Eigen::Success || !x.allFinite())
            throw Error(ErrorKind::stage, "E-SOLVE",
                        "relax: the linear system of the implicit method did not converge",
                        "use a smaller lambda and more iterations");
        return x;
    }

    const VertexLists& near_;
    std::vector<Index> unknown_; ///< vertex of each row
    std::vector<Index> rows_;    ///< row of each vertex, or none
    double lambda_;
    const std::vector<double>& mask_;
    Matrix matrix_;
};

} // namespace

RelaxStep implicit_step(const Neighbourhoods& near, const RelaxSettings& settings) {
    std::vector<Index> curves, surface; // curves do not depend on the surface, so they are solved first
    for (Index v = 0; v + 1 < near.lists.offsets.size(); ++v) {
        if (near.lists.of(v).empty()) continue;
        (!near.along.empty() && near.along[v] ? curves : surface).push_back(v);
    }
    const double lambda = relax_lambda(settings);
    auto first = std::make_shared<System>(near.lists, std::move(curves), lambda, settings.mask);
    auto second = std::make_shared<System>(near.lists, std::move(surface), lambda, settings.mask);
    return [first, second](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        to = from;
        first->solve(from, to);
        second->solve(from, to);
    };
}

} // namespace facetmill
