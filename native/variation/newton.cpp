#include "variation/newton.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <Eigen/Geometry>

#include "geometry/vertex_normal.h"
#include "linear/sparse_cholesky.h"

namespace fairing {

namespace {

constexpr double first_damping = 1e-3;
constexpr double least_damping = 1e-7;
constexpr double largest_damping = 1e4;
constexpr double largest_turn = 0.7;    // tangent of the angle of a normal in one step
constexpr double largest_rise = 0.15;  // units of D
constexpr double folded = 0.1;         // cosine between a triangle and its vertices' normals

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

double lean(const Sheet& sheet, const Triangles& triangles, int t) {
    const auto corner = triangles.col(t);
    const Vector3 cross = (sheet.points.col(corner[1]) - sheet.points.col(corner[0]))
                              .cross(sheet.points.col(corner[2]) - sheet.points.col(corner[0]));
    const Vector3 sum = sheet.normals.col(corner[0]) + sheet.normals.col(corner[1]) + sheet.normals.col(corner[2]);
    return cross.dot(sum) / (cross.norm() * sum.norm() + 1e-300);
}

// Whether a triangle that agreed with its normals no longer does.
bool folds(const Patch& patch, const Sheet& before, const Sheet& after) {
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (lean(after, patch.triangles, t) < folded && lean(before, patch.triangles, t) >= folded) return true;
    }
    return false;
}

class Newton {
public:
    Newton(const VariationEnergy& energy, Sheet& sheet, const Progress& progress)
        : energy_(energy), sheet_(sheet), progress_(progress), factor_(layout_of(energy, sheet)) {}

    NewtonResult run(const NewtonLimits& limits) {
        NewtonResult result;
        for (; result.steps < limits.most_steps && !result.converged; ++result.steps) {
            progress_.report(static_cast<double>(result.steps) / limits.most_steps, "least variation");
            energy_.update(sheet_, model_);
            if (!step()) break;
            static const bool debug = std::getenv("VARIATION_DEBUG") != nullptr;
            if (debug) std::fprintf(stderr, "  step %d E %.9g rise %.3g share %.3g damping %.2g\n", result.steps, model_.energy, largest_height_, share_, damping_);
            result.converged = share_ == 1.0 && largest_height_ < limits.tolerance;
        }
        energy_.update(sheet_, model_);
        result.energy = model_.energy;
        result.gradient = largest_height_gradient();
        return result;
    }

private:
    // One step of less energy; false where none is found.
    bool step() {
        while (damping_ <= largest_damping) {
            const auto motions = damped_motions();
            if (motions && search(*motions)) {
                if (share_ == 1.0) damping_ = std::max(least_damping, 0.1 * damping_);
                return true;
            }
            damping_ = std::max(10.0 * damping_, first_damping);
        }
        return false;
    }

    std::optional<VectorX> damped_motions() {
        SparseMatrix matrix = model_.hessian;
        for (int k = 0; k < matrix.cols(); ++k) {
            double& diagonal = matrix.valuePtr()[matrix.outerIndexPtr()[k]];
            diagonal += damping_ * std::max(std::abs(diagonal), 1e-12);
        }
        if (!factor_.factorise(matrix, "least variation", progress_.here())) return std::nullopt;
        VectorX motions = -factor_.solve_vector(model_.gradient);
        if (!motions.allFinite()) return std::nullopt;
        return motions;
    }

    // The longest share of the step that lowers the energy and folds nothing.
    bool search(const VectorX& motions) {
        constexpr int most_halvings = 6;
        constexpr double roundoff = 1e-13;
        measure(motions);
        const double slope = model_.gradient.dot(motions);
        if (!(slope <= 0.0)) return false;
        share_ = std::min({1.0, largest_turn / largest_turn_, largest_rise / largest_height_});
        for (int k = 0; k <= most_halvings; ++k, share_ *= 0.5) {
            Sheet tried = energy_.moved(sheet_, motions, share_);
            if (!(energy_.value(tried) <= model_.energy + 1e-4 * share_ * slope + roundoff * model_.energy)) continue;
            if (folds(energy_.patch(), sheet_, tried)) continue;
            sheet_ = std::move(tried);
            return true;
        }
        return false;
    }

    void measure(const VectorX& motions) {
        largest_height_ = largest_turn_ = 1e-300;
        for (int v = 0; v < energy_.patch().vertex_count(); ++v) {
            for (int k = 0; k < 3; ++k) {
                const int unknown = energy_.unknowns().of(v, k);
                if (unknown == none) continue;
                double& largest = k == 0 ? largest_height_ : largest_turn_;
                largest = std::max(largest, std::abs(motions[unknown]));
            }
        }
    }

    [[nodiscard]] double largest_height_gradient() const {
        double largest = 0.0;
        for (int v = 0; v < energy_.patch().free_count; ++v) {
            if (const int unknown = energy_.unknowns().of(v, 0); unknown != none)
                largest = std::max(largest, std::abs(model_.gradient[unknown]));
        }
        return largest;
    }

    const VariationEnergy& energy_;
    Sheet& sheet_;
    const Progress& progress_;
    SparseCholesky factor_;
    QuadraticModel model_;
    double damping_ = first_damping;
    double share_ = 0.0;
    double largest_height_ = 0.0;
    double largest_turn_ = 0.0;
};

}  // namespace

NewtonResult minimise(const VariationEnergy& energy, Sheet& sheet, const NewtonLimits& limits,
                      const Progress& progress) {
    return Newton(energy, sheet, progress).run(limits);
}

Points fitted_normals(const Problem& problem, const Points& points, const Progress& progress) {
    constexpr int most_steps = 3;
    Sheet sheet{points, max_normals(problem.patch, points, problem.fixed_normals)};
    const VariationEnergy energy(problem, Moving::normals);
    if (energy.unknowns().count() > 0) minimise(energy, sheet, {0.0, most_steps}, progress);
    return sheet.normals;
}

}  // namespace fairing
