#include "start/globalisation.h"

#include "linear/limits.h"
#include "problem/solution.h"
#include "problem/surface_state.h"
#include "tangential/slide.h"

namespace fairing {

namespace {

constexpr double largest_step = 0.25;       // units of D
constexpr int most_fixed_point_steps = 12;  // then it is a descent's turn
// A fixed-point step may raise the energy for a while: tangential moves leave the surface to second order. Without a
// bound an irregular cap of 300 vertices goes on to a mesh of the engine's own.
constexpr double tolerated_factor = 2.0;
constexpr double tolerated_rise = 2.0;  // a hemisphere has 8 π
// Beyond `coarsest_size` free vertices a descent ends that gains less than this share of the energy in so many steps:
// over boundaries of noisy scans it went on to the last step for the last hundredth.
constexpr double least_gain = 5e-3;
constexpr std::size_t gain_window = 5;

Points along_normals(const Points& normals, const VectorX& lengths) {
    return normals.leftCols(lengths.size()).array().rowwise() * lengths.transpose().array();
}

class Globalisation {
public:
    Globalisation(const Problem& problem, Workspace& work, const Points& start, const Progress& progress)
        : problem_(problem),
          patch_(problem.patch),
          work_(work),
          progress_(progress),
          conormals_(conormals(problem.patch, problem.fixed_points, problem.fixed_normals)) {
        state_.points = start;
        measure();
        keep();
    }

    Points run() {
        descend();
        if (!fixed_point_steps()) restore();
        return state_.points;
    }

    DescentStep descent_step() {
        const double length = descend_once();
        return {state_.points, length, energy_};
    }

private:
    void measure() {
        state_.measure_faces(patch_);
        state_.normals = max_normals(patch_, state_.points, problem_.fixed_normals);
        curvature_vectors_ = mixed_curvature_vectors(patch_, state_.stiffness, state_.points, conormals_);
        energy_ = willmore_energy(curvature_vectors_, state_.stiffness);
    }

    void keep() {
        best_energy_ = energy_;
        best_points_ = state_.points;
    }

    void restore() {
        state_.points = best_points_;
        measure();
    }

    void report(int step, int most) const { progress_.report(static_cast<double>(step) / most, "globalisation"); }

    // False where the energy rises or is no longer finite.
    bool fixed_point_steps() {
        for (int k = 0; k < most_fixed_point_steps; ++k) {
            report(k, most_fixed_point_steps);
            state_.curvature.mean = mixed_mean_curvature(curvature_vectors_, state_.stiffness, state_.normals);
            if (!work_.normal->update(state_.stiffness, progress_.here())) return false;
            Points d = along_normals(state_.normals, work_.normal->solve(harmonic_residual(problem_, state_)));
            d += work_.tangential->displacement(state_.points, state_.normals);
            const double largest = largest_length(d);
            state_.points.leftCols(patch_.free_count) += std::min(1.0, largest_step / largest) * d;
            measure();
            if (!(energy_ < tolerated_factor * best_energy_ + tolerated_rise)) return false;
            if (energy_ < best_energy_) keep();
            if (largest < near_step) return true;
        }
        return false;
    }

    // Willmore descent with the vertices kept even in between.
    void descend() {
        std::vector<double> energies;
        for (int k = 0; k < most_descent_steps && !creeps(energies); ++k) {
            report(k, most_descent_steps);
            energies.push_back(energy_);
            if (descend_once() < descended) return;
            even_out(energies.back());
        }
    }

    // `energies`: before each of the steps taken.
    [[nodiscard]] bool creeps(const std::vector<double>& energies) const {
        if (patch_.free_count <= coarsest_size || energies.size() < gain_window) return false;
        return energy_ > (1.0 - least_gain) * energies[energies.size() - gain_window];
    }

    // Largest displacement before the line search; 0 when no step lowers the energy.
    double descend_once() {
        const Points gradient = willmore_gradient(patch_, state_.stiffness, state_.points, curvature_vectors_);
        const VectorX slope =
            gradient.cwiseProduct(state_.normals.leftCols(patch_.free_count)).colwise().sum().transpose();
        if (!work_.normal->update(state_.stiffness, progress_.here())) return 0.0;
        const VectorX u = -0.5 * work_.normal->solve(slope);
        const double largest = u.cwiseAbs().maxCoeff();
        const double first = std::min(1.0, largest_step / largest);
        return line_search(along_normals(state_.normals, u), slope.dot(u), first) ? largest : 0.0;
    }

    bool line_search(const Points& direction, double slope, double step) {
        const Points origin = state_.points;
        const double start = energy_;
        for (int halving = 0; halving < most_halvings; ++halving, step *= 0.5) {
            state_.points = origin;
            state_.points.leftCols(patch_.free_count) += step * direction;
            measure();
            if (energy_ <= start + armijo * step * slope) {
                keep();
                return true;
            }
        }
        restore();
        return false;
    }

    // Within the surface, unless that costs more than the last descent step has gained: they would take turns for ever.
    void even_out(double most_energy) {
        slide(problem_, *work_.tangential, state_.normals, {}, 1, state_.points);
        measure();
        energy_ <= most_energy ? keep() : restore();
    }

    const Problem& problem_;
    const Patch& patch_;
    Workspace& work_;
    const Progress& progress_;
    Points conormals_;
    SurfaceState state_;
    Points curvature_vectors_;
    double energy_ = 0.0;
    double best_energy_ = 0.0;
    Points best_points_;
};

}  // namespace

Points globalise(const Problem& problem, Workspace& work, const Points& start, const Progress& progress) {
    return Globalisation(problem, work, start, progress).run();
}

DescentStep descent_step(const Problem& problem, Workspace& work, const Points& start, const Progress& progress) {
    return Globalisation(problem, work, start, progress).descent_step();
}

}  // namespace fairing
