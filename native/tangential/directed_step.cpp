#include "tangential/directed_step.h"

#include "base/errors.h"
#include "linear/gmres.h"
#include "tangential/across.h"

namespace fairing {

DirectedStep::DirectedStep(const Patch& patch, const RowWeights& weights, const Points& fixed_points,
                           const Progress& progress)
    : free_count_(patch.free_count) {
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
    if (!factor_.factorise(laplacian_, "the inner-fairness weights", progress)) {
        throw SolverError("the inner-fairness weights give a singular matrix: some vertices hang on no fixed one");
    }
}

void DirectedStep::hold(const Points& fixed_points) { pull_ = (coupling_ * fixed_points.transpose()).transpose(); }

Points DirectedStep::solve(const Points& rhs) const {
    return factor_.solve(Eigen::MatrixXd(rhs.transpose())).transpose();
}

Points DirectedStep::harmonic_positions() const { return solve(pull_); }

Points DirectedStep::imbalances(const Points& points, const Points& normals) const {
    Points result = pull_ - (laplacian_ * points.leftCols(free_count_).transpose()).transpose();
    project_across(result, normals);
    return result;
}

double DirectedStep::merit(const Points& points, const Points& normals) const {
    return 0.5 * imbalances(points, normals).squaredNorm();
}

double DirectedStep::imbalance(const Points& points, const Points& normals) const {
    return imbalances(points, normals).norm();
}

Points DirectedStep::displacement(const Points& points, const TangentPlanes& planes, Effort effort) const {
    const Points& normals = planes.normals;
    const auto as_points = [](const VectorX& x) { return Points(Eigen::Map<const Points>(x.data(), 3, x.size() / 3)); };
    const auto as_vector = [](const Points& x) { return VectorX(Eigen::Map<const VectorX>(x.data(), x.size())); };
    const auto apply = [&](const VectorX& x) {
        Points product = (laplacian_ * as_points(x).transpose()).transpose();
        project_across(product, normals);
        return as_vector(product);
    };
    const auto precondition = [&](const VectorX& x) {
        Points product = solve(as_points(x));
        project_across(product, normals);
        return as_vector(product);
    };
    return as_points(
        gmres(apply, precondition, as_vector(imbalances(points, normals)), effort.tolerance, effort.max_cycles));
}

}  // namespace fairing
