#include "boundary/normal_filter.h"

#include <algorithm>
#include <cmath>

#include "base/direction.h"
#include "geometry/limits.h"
#include "linear/conjugate_gradients.h"

namespace fairing {

namespace {

constexpr double strength = 16.0;   // μ
constexpr double accuracy = 1e-12;  // of the linear solve

struct Pair {
    int i;
    int j;
    Vector3 disagreement;  // of the normals found at both ends with the predicted turn: n̂_i − n̂_j − g_ij
    double weight;         // times σ_i σ_j: μ where both fits predict the same turn
};

Pair make_pair(const SurroundingFit& fit, const VectorX& errors, int i, int j) {
    const SlopeFit& first = *fit.fits[i];
    const SlopeFit& second = *fit.fits[j];
    const Vector3 step = fit.centres.col(j) - fit.centres.col(i);
    const Vector3 turn_by_first = first.normal - first.normal_at(step);
    const Vector3 turn_by_second = second.normal_at(-step) - second.normal;
    const double variance = (turn_by_first - turn_by_second).squaredNorm();
    return {i, j, first.normal - second.normal - 0.5 * (turn_by_first + turn_by_second),
            strength / (1.0 + variance / (errors[i] * errors[j]))};
}

// The equations for m, n_i = n̂_i + σ_i m_i: a symmetric M-matrix of moderate size whatever the σ.
class FilterSystem {
public:
    explicit FilterSystem(const SurroundingFit& fit)
        : errors_(VectorX::Ones(static_cast<Eigen::Index>(fit.fits.size()))), diagonal_(VectorX::Ones(errors_.size())) {
        for (std::size_t k = 0; k < fit.fits.size(); ++k) {
            if (fit.fits[k]) errors_[static_cast<Eigen::Index>(k)] = std::max(fit.fits[k]->error, least_error);
        }
        for (const auto& [i, j] : fit.edges) {
            if (!fit.fits[i] || !fit.fits[j]) continue;
            const Pair pair = make_pair(fit, errors_, i, j);
            pairs_.push_back(pair);
            diagonal_[i] += pair.weight * errors_[i] / errors_[j];
            diagonal_[j] += pair.weight * errors_[j] / errors_[i];
        }
    }

    // σ m, 3 × k.
    [[nodiscard]] Points turns() const {
        const Points m = conjugate_gradients(
                             right_hand_side(), accuracy, most_cycles, [&](const Points& p, Points& q) { apply(p, q); },
                             [&](const Points& r, Points& z) { z = r * diagonal_.cwiseInverse().asDiagonal(); })
                             .x;
        return m * errors_.asDiagonal();
    }

private:
    [[nodiscard]] Points right_hand_side() const {
        Points result = Points::Zero(3, errors_.size());
        for (const Pair& pair : pairs_) {
            result.col(pair.i) -= pair.weight / errors_[pair.j] * pair.disagreement;
            result.col(pair.j) += pair.weight / errors_[pair.i] * pair.disagreement;
        }
        return result;
    }

    void apply(const Points& p, Points& q) const {
        q = p * diagonal_.asDiagonal();
        for (const Pair& pair : pairs_) {
            q.col(pair.i) -= pair.weight * p.col(pair.j);
            q.col(pair.j) -= pair.weight * p.col(pair.i);
        }
    }

    VectorX errors_;
    VectorX diagonal_;
    std::vector<Pair> pairs_;
};

}  // namespace

Points filtered_normals(const SurroundingFit& fit) {
    const Points turns = FilterSystem(fit).turns();
    Points normals = fit.averaged;
    for (Eigen::Index k = 0; k < normals.cols(); ++k) {
        const auto& here = fit.fits[static_cast<int>(k)];
        if (here) normals.col(k) = direction(here->normal + turns.col(fit.first[static_cast<int>(k)]));
    }
    return normals;
}

}  // namespace fairing
