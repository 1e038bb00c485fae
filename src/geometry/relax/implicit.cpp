#include "base/error.hpp"
#include "base/parallel.hpp"
#include "geometry/relax/steps.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <memory>

namespace facetmill {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The vertices that one linear system is about; all others count as known. Symmetric and positive definite:
/// with n neighbours, mask w and lambda f the row of vertex v is n / w (x - p) + f sum(x - xj) = 0.
class System {
  public:
    System(const VertexLists& near, std::vector<Index> unknown, double lambda,
           const std::vector<double>& mask)
        : near_(near), unknown_(std::move(unknown)), lambda_(lambda), mask_(mask) {
        rows_.assign(near.offsets.size() - 1, none);
        for (std::size_t i = 0; i < unknown_.size(); ++i) rows_[unknown_[i]] = static_cast<Index>(i);
        fill();
    }

    /// Solves for the unknown, all else as it is in `places`; start is where they are before.
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
    std::vector<Index> curves, surface; // curves do not depend on the surface: they are solved first
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
