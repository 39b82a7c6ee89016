#include "placement/relax.h"

#include <algorithm>

#include "base/limits.h"
#include "linear/anderson.h"
#include "linear/limits.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double done = 1e-7;  // units of D

class Relaxation {
public:
    Relaxation(const TangentialStep& tangential, const TargetSurface& target, Placement& placement)
        : tangential_(tangential),
          target_(target),
          placement_(placement),
          merit_(merit_of(placement)),
          anderson_(history_depth) {}

    void run() {
        for (int step = 0; step < most_iterations; ++step) {
            const Points d = tangential_.displacement(placement_.points, normals_at(placement_, target_));
            const double largest = largest_length(d);
            if (largest < done || !improve(d, largest)) break;
        }
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
        if (accepts(move * std::min(1.0, longest_step / largest_length(move)))) return true;
        double length = std::min(1.0, longest_step / largest);
        for (int halving = 0; halving < most_halvings; ++halving, length *= 0.5) {
            if (accepts(length * d)) return true;
        }
        return false;
    }

    bool accepts(const Points& move) {
        Placement trial = moved(placement_, target_, move);
        const double reached = merit_of(trial);
        if (!(reached < merit_)) return false;
        merit_ = reached;
        placement_ = std::move(trial);
        return true;
    }

    const TangentialStep& tangential_;
    const TargetSurface& target_;
    Placement& placement_;
    double merit_;
    Anderson anderson_;
};

}  // namespace

void relax(const TangentialStep& tangential, const TargetSurface& target, Placement& placement) {
    Relaxation(tangential, target, placement).run();
}

void settle(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target, Placement& placement,
            const Progress& progress) {
    if (const auto* rows = std::get_if<RowWeights>(&*problem.weights)) {
        const auto symmetric = make_tangential_step(problem.patch, symmetrised(*rows), problem.fixed_points, progress);
        relax(*symmetric, target, placement);
    }
    relax(tangential, target, placement);
}

}  // namespace fairing
