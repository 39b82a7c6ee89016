#include "placement/relax.h"

#include <algorithm>

#include "linear/anderson.h"
#include "placement/folds.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr int most_steps = 60;
constexpr int most_held_steps = 15;   // what is held back comes no further
constexpr double largest_step = 0.1;  // units of D
constexpr double done = 1e-7;
constexpr int most_halvings = 8;
constexpr int most_held_halvings = 3;
constexpr int history_depth = 5;

class Relaxation {
public:
    Relaxation(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target, Folds folds,
               Placement& placement)
        : problem_(problem),
          tangential_(tangential),
          target_(target),
          folds_(folds),
          placement_(placement),
          merit_(merit_of(placement)),
          anderson_(history_depth) {
        if (folds_ == Folds::held_back) folded_ = folded_mask(problem_, target_, placement_);
    }

    double run() {
        const int most = folds_ == Folds::allowed ? most_steps : most_held_steps;
        for (int step = 0; step < most; ++step) {
            const Points d = tangential_.displacement(placement_.points, normals_at(placement_, target_));
            const double largest = largest_length(d);
            if (largest < done || !improve(d, largest)) break;
        }
        return merit_;
    }

private:
    [[nodiscard]] double merit_of(const Placement& placement) const {
        return tangential_.merit(placement.points, normals_at(placement, target_));
    }

    // Where the surface is curved, plain steps are too short by the same share each time: acceleration learns it.
    bool improve(const Points& d, double largest) {
        const auto as_vector = [](const auto& points) { return VectorX(points.reshaped()); };
        const VectorX far = anderson_.step(as_vector(placement_.points.leftCols(d.cols())), as_vector(d));
        Points move = Eigen::Map<const Points>(far.data(), 3, d.cols());
        if (accepts(move * std::min(1.0, largest_step / largest_length(move)))) return true;
        double length = std::min(1.0, largest_step / largest);
        const int most = folds_ == Folds::allowed ? most_halvings : most_held_halvings;
        for (int halving = 0; halving < most; ++halving, length *= 0.5) {
            if (accepts(length * d)) return true;
        }
        return false;
    }

    bool accepts(const Points& move) {
        Placement trial = moved(placement_, target_, move);
        if (folds_ == Folds::held_back && !hold_back(trial)) return false;
        const double reached = merit_of(trial);
        if (!(reached < merit_)) return false;
        merit_ = reached;
        placement_ = std::move(trial);
        if (folds_ == Folds::held_back) folded_ = folded_mask(problem_, target_, placement_);
        return true;
    }

    // Takes back the moves at newly folded triangles, which may fold others; false where that comes to no end.
    [[nodiscard]] bool hold_back(Placement& trial) const {
        constexpr int most_rounds = 5;
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<char> folded = folded_mask(problem_, target_, trial);
            bool held = false;
            for (int t = 0; t < problem_.patch.triangle_count(); ++t) {
                if (!folded[t] || folded_[t]) continue;
                held = true;
                hold(trial, t);
            }
            if (!held) return true;
        }
        return false;
    }

    void hold(Placement& trial, int t) const {
        for (const int v : problem_.patch.triangles.col(t)) {
            if (!problem_.patch.is_free(v)) continue;
            trial.where[v] = placement_.where[v];
            trial.points.col(v) = placement_.points.col(v);
        }
    }

    const Problem& problem_;
    const TangentialStep& tangential_;
    const TargetSurface& target_;
    const Folds folds_;
    Placement& placement_;
    double merit_;
    Anderson anderson_;
    std::vector<char> folded_;  // of `placement_`
};

}  // namespace

double relax(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
             Placement& placement, Folds folds) {
    return Relaxation(problem, tangential, target, folds, placement).run();
}

double settle(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
              Placement& placement, const Progress& progress) {
    if (const auto* rows = std::get_if<RowWeights>(&*problem.weights)) {
        const auto symmetric = make_tangential_step(problem.patch, symmetrised(*rows), problem.fixed_points, progress);
        relax(problem, *symmetric, target, placement);
    }
    return relax(problem, tangential, target, placement);
}

}  // namespace fairing
