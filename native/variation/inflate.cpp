#include "variation/inflate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/direction.h"
#include "base/limits.h"
#include "operators/laplace_operator.h"
#include "start/clamped_fill.h"

namespace fairing {

namespace {

constexpr double share = 0.8;     // of the outline's spacing
constexpr double settled = 1e-3;  // units of D

// Logarithms of the mean lengths of the two border edges at each fixed vertex, zero elsewhere.
VectorX outline_lengths(const Problem& problem) {
    const Patch& patch = problem.patch;
    VectorX logarithms = VectorX::Zero(patch.vertex_count());
    for (const Indices& loop : patch.loops()) {
        const auto size = loop.size();
        const auto place = [&](std::size_t k) { return problem.fixed_points.col(loop[k % size] - patch.free_count); };
        for (std::size_t k = 0; k < size; ++k) {
            const double sum = (place(k + 1) - place(k)).norm() + (place(k) - place(k + size - 1)).norm();
            logarithms[loop[k]] = std::log(std::max(0.5 * sum, std::numeric_limits<double>::min()));
        }
    }
    return logarithms;
}

class Inflation {
public:
    Inflation(const Problem& problem, const Progress& progress)
        : patch_(problem.patch), stiffness_(uniform_stiffness(problem.patch)), laplace_(problem.patch) {
        ready_ = laplace_.update(stiffness_, progress);
        if (!ready_) return;
        VectorX logarithms = outline_lengths(problem);
        const Eigen::RowVectorXd row = logarithms.transpose();
        logarithms.head(patch_.free_count) =
            -laplace_.solve(stiffness_.apply(patch_, row, patch_.free_count).transpose());
        spacing_ = logarithms.array().exp();
    }

    [[nodiscard]] bool ready() const { return ready_; }

    // Moves the free vertices; gives the largest coordinate of their displacements.
    double round(Points& points) const {
        Points pull = Points::Zero(3, patch_.free_count);
        for (int e = 0; e < patch_.edge_count(); ++e) {
            const auto [i, j] = patch_.edge_ends[e];
            const Vector3 edge = points.col(j) - points.col(i);
            const double wanted = share * std::sqrt(spacing_[i] * spacing_[j]);
            const Vector3 longer = std::max(0.0, wanted - edge.norm()) * direction(edge);
            if (patch_.is_free(i)) pull.col(i) -= stiffness_.weights[e] * longer;
            if (patch_.is_free(j)) pull.col(j) += stiffness_.weights[e] * longer;
        }
        const Points moves = laplace_.solve(pull.transpose()).transpose();
        points.leftCols(patch_.free_count) += moves;
        return moves.cwiseAbs().maxCoeff();
    }

private:
    const Patch& patch_;
    Stiffness stiffness_;
    LaplaceOperator laplace_;
    VectorX spacing_;
    bool ready_ = false;
};

}  // namespace

Points inflated(const Problem& problem, const Points& start, const Progress& progress) {
    const Inflation inflation(problem, progress);
    Points points = start;
    if (!inflation.ready()) return points;
    for (int k = 0; k < most_iterations; ++k) {
        progress.report(static_cast<double>(k) / most_iterations, "inflation");
        if (inflation.round(points) < settled) break;
    }
    return points.allFinite() ? points : start;
}

}  // namespace fairing
