#include "paper/level.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fairing {

double outer_source(const SolverOptions& options, const CurvatureFit& fit) {
    switch (options.equation) {
        case Equation::constant: return options.load;
        case Equation::minimal_energy: {
            const double H = fit.mean();
            return -2.0 * H * (H * H - fit.gaussian());
        }
        case Equation::harmonic:
        case Equation::minimal: return 0.0;
    }
    return 0.0;
}

void LevelState::measure(const LevelProblem& level, const DiskTable& disks) {
    const Patch& patch = level.patch;
    faces.update(points, patch.triangles);
    stiffness.update(faces, patch);
    normals.resize(3, patch.vertex_count());
    for (int i = 0; i < patch.vertex_count(); ++i) {
        normals.col(i) = level.prescribes_normal(i) ? Vector3(level.fixed_normals.col(i - patch.free_count))
                                                    : disk_normal(disks[i], points);
    }
    H.resize(patch.vertex_count());
    source.resize(patch.free_count);
    DiskCurvature curvature(points, normals);
    for (int i = 0; i < patch.vertex_count(); ++i) {
        const Disk disk = disks[i];
        const CurvatureFit fit = curvature(disk, level.completes(i, disk.valence())).at;
        H[i] = fit.mean();
        if (patch.is_free(i)) source[i] = outer_source(level.solver, fit);
    }
}

VectorX LevelState::right_hand_side(const LevelProblem& level) const {
    // Δ_B H = −(S H)/(2 M) (eq. 5).
    return -2.0 * stiffness.mass.head(level.patch.free_count).cwiseProduct(source);
}

double LevelState::unfairness(const LevelProblem& level, const DiskTable& disks) const {
    double largest = 0.0;
    for (int i = 0; i < level.patch.free_count; ++i) {
        const Vector3 delta = level.weights.mean(i, points) - points.col(i);
        const Vector3 across = delta - normals.col(i).dot(delta) * normals.col(i);
        const Disk disk = disks[i];
        double squared = 0.0;
        for (int v : disk.neighbours) squared += (points.col(v) - points.col(i)).squaredNorm();
        largest = std::max(largest, across.norm() * static_cast<double>(disk.valence()) / std::max(squared, 1e-300));
    }
    return largest;
}

double LevelState::residual(const LevelProblem& level, const CurvatureEquation& equation) const {
    const int n = level.patch.free_count;
    const double largest = level.solver.equation == Equation::minimal
                               ? H.head(n).cwiseAbs().maxCoeff<Eigen::PropagateNaN>()
                               : equation.defect(right_hand_side(level), H)
                                     .cwiseAbs()
                                     .cwiseQuotient(2.0 * stiffness.mass.head(n))
                                     .maxCoeff<Eigen::PropagateNaN>();
    return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace fairing
