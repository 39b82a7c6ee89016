#include "tangential/row_step.h"

#include "linear/solve_by_steps.h"
#include "tangential/slide.h"

namespace fairing {

RowStep::RowStep(const Patch& patch, const RowWeights& weights, const Points& fixed_points, const Progress& progress)
    : free_count_(patch.free_count), near_(patch, symmetrised(weights), fixed_points, progress) {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Eigen::Triplet<double>> couplings;
    for (int i = 0; i < free_count_; ++i) {
        entries.emplace_back(i, i, 1.0);
        const auto columns = weights.columns_of(i);
        const auto values = weights.values_of(i);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (patch.is_free(columns[k])) {
                entries.emplace_back(i, columns[k], -values[k]);
            } else {
                couplings.emplace_back(i, columns[k] - free_count_, values[k]);
            }
        }
    }
    laplacian_.resize(free_count_, free_count_);
    laplacian_.setFromTriplets(entries.begin(), entries.end());
    coupling_.resize(free_count_, fixed_points.cols());
    coupling_.setFromTriplets(couplings.begin(), couplings.end());
    hold(fixed_points);
}

void RowStep::hold(const Points& fixed_points) { pull_ = (coupling_ * fixed_points.transpose()).transpose(); }

Points RowStep::harmonic_positions() const {
    constexpr double exact = 1e-10;  // of the pull
    return solve(pull_, [](Points&) {}, exact, most_cycles);
}

template <typename Project>
Points RowStep::solve(const Points& rhs, const Project& project, double tolerance, int most_steps) const {
    const auto as_points = [](const VectorX& x) { return Points(Eigen::Map<const Points>(x.data(), 3, x.size() / 3)); };
    const auto projected = [&](Points field) {
        project(field);
        return VectorX(Eigen::Map<const VectorX>(field.data(), field.size()));
    };
    const auto apply = [&](const VectorX& x) { return projected((laplacian_ * as_points(x).transpose()).transpose()); };
    const auto precondition = [&](const VectorX& x) { return projected(near_.inverse(as_points(x))); };
    return as_points(solve_by_steps(apply, precondition, projected(rhs), tolerance, most_steps));
}

Points RowStep::imbalances(const Points& points, const Points& normals) const {
    Points result = pull_ - (laplacian_ * points.leftCols(free_count_).transpose()).transpose();
    project_across(result, normals);
    return result;
}

double RowStep::merit(const Points& points, const Points& normals) const {
    return 0.5 * imbalances(points, normals).squaredNorm();
}

double RowStep::imbalance(const Points& points, const Points& normals) const {
    return imbalances(points, normals).norm();
}

Points RowStep::displacement(const Points& points, const TangentPlanes& planes, Effort effort) const {
    const Points& normals = planes.normals;
    const auto across = [&](Points& field) { project_across(field, normals); };
    return solve(imbalances(points, normals), across, effort.tolerance, most_cycles);
}

}  // namespace fairing
