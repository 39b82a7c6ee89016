#include "variation/newton.h"

#include <Eigen/Geometry>

#include "base/limits.h"
#include "geometry/neighbourhood.h"
#include "geometry/triangle.h"
#include "geometry/vertex_normal.h"
#include "linear/limits.h"
#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

constexpr double least_damping = 1e-9;   // below, none
constexpr double largest_damping = 1e3;  // beyond, no step is found
constexpr double largest_turn = 0.7;     // tangent of the angle of a normal in one step
constexpr double largest_rise = 0.5;     // of the mean edge at a vertex
constexpr double folded = 0.1;           // cosine between a triangle and its vertices' normals
constexpr int steps_until_more = 4;      // each factorisation in vain costs as much as one that is used

// The place of each unknown, for the order of elimination.
Points layout_of(const VariationEnergy& energy, const Sheet& sheet) {
    Points layout(3, energy.unknowns().count());
    for (int v = 0; v < energy.patch().vertex_count(); ++v) {
        for (int k = 0; k < 3; ++k) {
            if (const int unknown = energy.unknowns().of(v, k); unknown != none)
                layout.col(unknown) = sheet.points.col(v);
        }
    }
    return layout;
}

VectorX mean_edges(const Patch& patch, const Points& points) {
    VectorX result(patch.vertex_count());
    for (int v = 0; v < patch.vertex_count(); ++v) {
        result[v] = mean_spoke(patch, points, v);
    }
    return result;
}

double lean(const Sheet& sheet, const Triangles& triangles, int t) {
    const auto corner = triangles.col(t);
    const Vector3 cross = area_vector(sheet.points, corner);
    const Vector3 sum = sheet.normals.col(corner[0]) + sheet.normals.col(corner[1]) + sheet.normals.col(corner[2]);
    return cross.dot(sum) / (cross.norm() * sum.norm() + 1e-300);
}

// Whether a triangle that agreed with its normals no longer does. Healthy triangles feel nothing of it.
bool folds(const Patch& patch, const Sheet& before, const Sheet& after) {
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (lean(after, patch.triangles, t) < folded && lean(before, patch.triangles, t) >= folded) return true;
    }
    return false;
}

class Newton {
public:
    Newton(const VariationEnergy& energy, Sheet& sheet, const NewtonLimits& limits, const Progress& progress)
        : energy_(energy),
          sheet_(sheet),
          limits_(limits),
          progress_(progress),
          factor_(layout_of(energy, sheet)),
          spacing_(mean_edges(energy.patch(), sheet.points)),
          present_(energy.measured(sheet)),
          damping_(limits.damping) {}

    NewtonResult run() {
        NewtonResult result;
        while (result.steps < limits_.most_steps && !result.converged) {
            progress_.report(static_cast<double>(result.steps) / limits_.most_steps, "least variation");
            energy_.update(sheet_, present_, model_);
            if (!step()) break;
            ++result.steps;
            result.converged = has_converged(result.steps);
            if (share_ < limits_.shortest_share || is_hopeless(result.steps)) break;
        }
        result.merit = present_.merit;
        result.gradient = largest_gradient();
        return result;
    }

private:
    // The first step, from another mesh's surface, may leave more than it takes away.
    [[nodiscard]] bool has_converged(int steps) const {
        const double share = steps > 1 ? 1.0 : 0.01;
        if (steps > 1 && share_ == 1.0 && fall_ < limits_.least_fall * (merit_unit + present_.merit)) return true;
        return share_ == 1.0 && used_damping_ <= least_damping && largest_height_ < share * limits_.tolerance &&
               largest_turn_ < limits_.turns;
    }

    [[nodiscard]] bool is_hopeless(int steps) const {
        constexpr int patience = 10;  // steps, before a merit that stays too large is given up
        return steps >= patience && model_.merit > limits_.most_merit;
    }

    // One step of less merit; false where none is found. Where the second derivatives are not positive definite, less
    // of their indefinite part is taken before damping is: damping slows what is smooth most.
    bool step() {
        if (--rest_ <= 0) bending_ = std::min(1.0, 2.0 * std::max(bending_, 0.125));
        while (damping_ <= largest_damping) {
            const auto motions = solved();
            if (!motions && bending_ > 0.0) {
                bending_ = bending_ > 0.2 ? 0.5 * bending_ : 0.0;
                rest_ = steps_until_more;
                continue;
            }
            if (motions && search(*motions)) {
                adapt_damping();
                return true;
            }
            damping_ = std::max(10.0 * damping_, raised_damping);
        }
        return false;
    }

    void adapt_damping() {
        used_damping_ = damping_;
        constexpr double expected = 0.4;  // of the slope: an undamped step falls by half of it, a damped one by more
        const double kept = fall_ > -expected * slope_ ? 0.02 : 0.15;
        if (share_ == 1.0) damping_ = damping_ > least_damping ? kept * damping_ : 0.0;
        if (share_ < 0.5) damping_ = std::max(5.0 * damping_, least_damping);
    }

    std::optional<VectorX> solved() {
        SparseMatrix matrix = model_.bending;
        Eigen::Map<VectorX> values(matrix.valuePtr(), matrix.nonZeros());
        values = bending_ * values + model_.stretching;
        damp(matrix);
        if (!factor_.factorise(matrix, "least variation", progress_.here())) return std::nullopt;
        VectorX motions = -factor_.solve_vector(model_.gradient);
        if (bending_ == 1.0 && model_.area_factor > 0.0) motions += area_correction(motions);
        if (!motions.allFinite()) return std::nullopt;
        return motions;
    }

    // By shares of the diagonal; of its mean where a normal turns, which no choice of axes changes.
    void damp(SparseMatrix& matrix) const {
        const Unknowns& unknowns = energy_.unknowns();
        const auto diagonal = [&](int unknown) -> double& {
            return matrix.valuePtr()[matrix.outerIndexPtr()[unknown]];
        };
        const double share = damping_ + roundoff;
        for (int v = 0; v < energy_.patch().vertex_count(); ++v) {
            if (const int h = unknowns.of(v, 0); h != none) diagonal(h) += share * std::abs(diagonal(h));
            if (unknowns.of(v, 1) == none) continue;
            double& first = diagonal(unknowns.of(v, 1));
            double& second = diagonal(unknowns.of(v, 2));
            const double added = 0.5 * share * (std::abs(first) + std::abs(second));
            first += added;
            second += added;
        }
    }

    // For the rank-one part of the second derivatives, by Sherman and Morrison.
    [[nodiscard]] VectorX area_correction(const VectorX& motions) const {
        constexpr double least_pivot = 0.2;  // of Sherman and Morrison's divisor: a smaller one blows the step up
        const VectorX response = factor_.solve_vector(model_.area);
        const double pivot = 1.0 - model_.area_factor * model_.area.dot(response);
        const double factor = model_.area_factor / std::max(pivot, least_pivot);
        return factor * model_.area.dot(motions) * response;
    }

    // Where the merit has a curved valley, as where an elbow moves sideways, a straight step leaves it at once. The
    // step becomes a parabola by the residuals' own second derivatives: geodesic acceleration (Transtrum, Sethna 2012).
    [[nodiscard]] VectorX acceleration(const VectorX& motions) const {
        constexpr double probe = 0.1;        // of the step
        constexpr double most = 0.75;        // of the step's length
        constexpr double least_rise = 1e-3;  // below, steps are straight enough
        if (largest_rise_ < least_rise) return VectorX::Zero(motions.size());
        VectorX bent = -factor_.solve_vector(energy_.acceleration_load(sheet_, present_, motions, probe * share_));
        const double length = share_ * bent.norm();
        if (!std::isfinite(length)) return VectorX::Zero(motions.size());
        return std::min(1.0, most * motions.norm() / (length + roundoff)) * bent;
    }

    // The longest share of the step that lowers the merit and folds nothing.
    bool search(const VectorX& motions) {
        constexpr double noise = 1e-13;    // of the merit, and where that is zero
        constexpr double nothing = 1e-20;  // units of the merit
        measure(motions);
        const double slope = model_.gradient.dot(motions);
        if (!(slope <= 0.0)) return false;
        slope_ = slope;
        share_ = std::min({1.0, largest_turn / largest_turn_, largest_rise / largest_rise_});
        const VectorX bent = acceleration(motions);
        for (int k = 0; k <= most_halvings; ++k, share_ *= 0.5) {
            Sheet tried = energy_.moved(sheet_, motions + 0.5 * share_ * bent, share_);
            const SheetMerit there = energy_.measured(tried);
            if (!(there.merit <= model_.merit + armijo * share_ * slope + noise * model_.merit + nothing)) continue;
            if (folds(energy_.patch(), sheet_, tried)) continue;
            sheet_ = std::move(tried);
            present_ = there;
            fall_ = model_.merit - there.merit;
            return true;
        }
        return false;
    }

    void measure(const VectorX& motions) {
        largest_height_ = largest_turn_ = largest_rise_ = 1e-300;
        for (int v = 0; v < energy_.patch().vertex_count(); ++v) {
            const auto size = [&](int k) {
                const int unknown = energy_.unknowns().of(v, k);
                return unknown == none ? 0.0 : std::abs(motions[unknown]);
            };
            largest_height_ = std::max(largest_height_, size(0));
            largest_rise_ = std::max(largest_rise_, size(0) / spacing_[v]);
            largest_turn_ = std::max({largest_turn_, size(1), size(2)});
        }
    }

    [[nodiscard]] double largest_gradient() const {
        const VectorX gradient = energy_.gradient(sheet_, present_);
        double largest = 0.0;
        for (int v = 0; v < energy_.patch().free_count; ++v) {
            if (const int unknown = energy_.unknowns().of(v, 0); unknown != none)
                largest = std::max(largest, std::abs(gradient[unknown]));
        }
        return largest;
    }

    const VariationEnergy& energy_;
    Sheet& sheet_;
    const NewtonLimits& limits_;
    const Progress& progress_;
    SparseCholesky factor_;
    VectorX spacing_;
    SheetMerit present_;  // of the sheet
    QuadraticModel model_;
    double damping_;
    double used_damping_ = 0.0;
    double bending_ = 1.0;  // share of the indefinite part
    int rest_ = 0;          // steps before more of it is tried
    double share_ = 0.0;
    double fall_ = 0.0;   // of the merit
    double slope_ = 0.0;  // of the merit along the step
    double largest_height_ = 0.0;
    double largest_rise_ = 0.0;  // in edges
    double largest_turn_ = 0.0;
};

}  // namespace

NewtonResult minimise(const VariationEnergy& energy, Sheet& sheet, const NewtonLimits& limits,
                      const Progress& progress) {
    return Newton(energy, sheet, limits, progress).run();
}

Points fitted_normals(const Problem& problem, const Points& points, Measure measure, const Progress& progress) {
    constexpr double converged = 1e-5;                          // radians; the next step is of its square
    const int most_steps = measure == Measure::plain ? 3 : 20;  // a start needs no more
    Sheet sheet{points, max_normals(problem.patch, points, problem.fixed_normals)};
    const VariationEnergy energy(problem, Moving::normals, measure);
    if (energy.unknowns().count() > 0)
        minimise(energy, sheet, {converged, most_steps, 0.0, 0.0, HUGE_VAL, converged}, progress);
    return sheet.normals;
}

}  // namespace fairing
