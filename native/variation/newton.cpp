#include "variation/newton.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <Eigen/Geometry>

#include "geometry/vertex_normal.h"
#include "linear/sparse_cholesky.h"

namespace fairing {
extern double experimental_mu;
double experimental_area(const Sheet& sheet, const Stencil& stencil);
double experimental_env(const char* n, double d);

namespace {

constexpr double first_damping = 1e-3;
constexpr double least_damping = 1e-9;
constexpr double largest_damping = 1e3;
constexpr double largest_turn = 0.7;    // tangent of the angle of a normal in one step
constexpr double largest_rise = 0.5;  // of the mean edge at a vertex
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
        : energy_(energy), sheet_(sheet), progress_(progress), factor_(layout_of(energy, sheet)) {
        for (int v = 0; v < energy.patch().vertex_count(); ++v) {
            double sum = 0.0;
            for (int u : energy.patch().ring(v).vertices) sum += (sheet.points.col(u) - sheet.points.col(v)).norm();
            spacing_.push_back(sum / static_cast<double>(energy.patch().ring(v).valence()));
        }
    }

    NewtonResult run(const NewtonLimits& limits) {
        NewtonResult result;
        damping_ = limits.damping;
        for (; result.steps < limits.most_steps && !result.converged; ++result.steps) {
            progress_.report(static_cast<double>(result.steps) / limits.most_steps, "least variation");
            {
                experimental_mu = 0.0;
                const double e = energy_.value(sheet_);
                double area = 0.0;
                for (const Stencil& st : stencils(energy_.patch())) area += experimental_area(sheet_, st);
                const double c = limits.scale;
                experimental_mu = c * e / area;
            }
            energy_.update(sheet_, model_);
            if (!step()) break;
            if (limits.leave_when_stuck && share_ < 0.05) break;
            static const bool debug = std::getenv("VARIATION_DEBUG") != nullptr;
            if (debug) std::fprintf(stderr, "  step %d E %.9g rise %.3g share %.3g damping %.2g bending %g\n", result.steps, model_.energy, largest_height_, share_, damping_, bending_);
            result.converged = share_ == 1.0 && damping_ <= 1e-8 && largest_height_ < limits.tolerance;
        }
        energy_.update(sheet_, model_);
        result.energy = model_.energy;
        result.damping = damping_;
        result.rise = largest_rise_;
        result.share = share_;
        result.gradient = largest_height_gradient();
        return result;
    }

private:
    // One step of less energy; false where none is found.
    bool step() {
        bending_ = std::min(1.0, 2.0 * std::max(bending_, 0.125));
        while (damping_ <= largest_damping) {
            const auto motions = damped_motions();
            if (!motions && bending_ > 0.0) {
                bending_ = bending_ > 0.2 ? 0.5 * bending_ : 0.0;
                continue;
            }
            if (motions && search(*motions)) {
                if (share_ == 1.0) damping_ = damping_ > least_damping ? 0.15 * damping_ : 0.0;
                if (share_ < 0.5) damping_ = std::max(5.0 * damping_, least_damping);
                return true;
            }
            damping_ = std::max(10.0 * damping_, first_damping);
        }
        return false;
    }

    std::optional<VectorX> damped_motions() {
        SparseMatrix matrix = model_.hessian;
        Eigen::Map<VectorX> values(matrix.valuePtr(), matrix.nonZeros());
        values = bending_ * values + model_.stretching;
        for (int k = 0; k < matrix.cols(); ++k) {
            double& diagonal = matrix.valuePtr()[matrix.outerIndexPtr()[k]];
            diagonal += (damping_ + 1e-14) * std::abs(diagonal);
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
        share_ = std::min({1.0, largest_turn / largest_turn_, largest_rise / largest_rise_});
        for (int k = 0; k <= most_halvings; ++k, share_ *= 0.5) {
            Sheet tried = energy_.moved(sheet_, motions, share_);
            if (!(energy_.value(tried) <= model_.energy + 1e-4 * share_ * slope + roundoff * model_.energy)) continue;
            static const bool guard = !std::getenv("V_NOGUARD");
            if (guard && folds(energy_.patch(), sheet_, tried)) continue;
            sheet_ = std::move(tried);
            return true;
        }
        return false;
    }

    void measure(const VectorX& motions) {
        largest_height_ = largest_turn_ = largest_rise_ = 1e-300;
        for (int v = 0; v < energy_.patch().vertex_count(); ++v) {
            for (int k = 0; k < 3; ++k) {
                const int unknown = energy_.unknowns().of(v, k);
                if (unknown == none) continue;
                double& largest = k == 0 ? largest_height_ : largest_turn_;
                largest = std::max(largest, std::abs(motions[unknown]));
                if (k == 0) largest_rise_ = std::max(largest_rise_, std::abs(motions[unknown]) / spacing_[at(v)]);
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
    double bending_ = 1.0;
    double damping_ = 1e-6;
    double share_ = 0.0;
    double largest_height_ = 0.0;
    double largest_turn_ = 0.0;
    double largest_rise_ = 0.0;
    std::vector<double> spacing_;
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
