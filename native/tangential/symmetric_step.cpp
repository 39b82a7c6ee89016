#include "tangential/symmetric_step.h"

#include "base/errors.h"
#include "tangential/slide.h"

namespace fairing {

SymmetricStep::SymmetricStep(const Patch& patch, const InnerWeights& weights, const Points& fixed_points,
                             const Progress& progress)
    : free_count_(patch.free_count) {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Eigen::Triplet<double>> couplings;
    entries.reserve(4 * weights.size());
    const auto add_row = [&](int i, int j, double weight) {
        if (!patch.is_free(i)) return;
        entries.emplace_back(i, i, weight);
        if (patch.is_free(j)) {
            entries.emplace_back(i, j, -weight);
        } else {
            couplings.emplace_back(i, j - free_count_, weight);
        }
    };
    for (const WeightedEdge& edge : weights) {
        add_row(edge.i, edge.j, edge.weight);
        add_row(edge.j, edge.i, edge.weight);
    }
    coupling_.resize(free_count_, fixed_points.cols());
    coupling_.setFromTriplets(couplings.begin(), couplings.end());
    hold(fixed_points);
    laplacian_.resize(free_count_, free_count_);
    laplacian_.setFromTriplets(entries.begin(), entries.end());
    if (!factor_.factorise(laplacian_.triangularView<Eigen::Lower>(), "the inner-fairness weights", progress)) {
        throw SolverError("the inner-fairness weights give no positive definite matrix");
    }
}

void SymmetricStep::hold(const Points& fixed_points) { pull_ = (coupling_ * fixed_points.transpose()).transpose(); }

Points SymmetricStep::harmonic_positions() const { return factor_.solve_points(pull_); }

double SymmetricStep::merit(const Points& points) const {
    const auto free = points.leftCols(free_count_);
    return 0.5 * inner_product<Points>(free, gradient(points) - pull_);
}

double SymmetricStep::imbalance(const Points& points, const Points& normals) const {
    Points r = gradient(points);
    project_across(r, normals);
    return r.norm();
}

Points SymmetricStep::gradient(const Points& points) const { return applied(points) - pull_; }

// Row i of the symmetric matrix is its column i.
Points SymmetricStep::applied(const Points& points) const {
    Points product(3, free_count_);
    for_ranges(free_count_, coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            Vector3 sum = Vector3::Zero();
            for (SparseMatrix::InnerIterator entry(laplacian_, i); entry; ++entry)
                sum += entry.value() * points.col(entry.row());
            product.col(i) = sum;
        }
    });
    return product;
}

Points SymmetricStep::inverse(const Points& field) const { return factor_.solve_points(field); }

Points SymmetricStep::precondition(const Points& field, const Points& normals) const {
    Points result = inverse(field);
    project_across(result, normals);
    return result;
}

Points SymmetricStep::displacement(const Points& points, const TangentPlanes& planes, Effort effort) const {
    Points r = -gradient(points);
    const ShapeOperators turns = turning(planes, r);
    project_across(r, planes.normals);
    auto solution = solve_across(r, planes.normals, turns, effort);
    if (solution.positive || turns.cols() == 0) return std::move(solution.x);
    return solve_across(r, planes.normals, {}, effort).x;
}

GradientSolution<Points> SymmetricStep::solve_across(const Points& r, const Points& normals,
                                                     const ShapeOperators& turns, const Effort& effort) const {
    const auto apply = [&](const Points& p, Points& product) {
        product = applied(p);
        add_turning(turns, p, product);
        project_across(product, normals);
    };
    const auto approximate_inverse = [&](const Points& field, Points& z) { z = precondition(field, normals); };
    return conjugate_gradients(r, effort.tolerance, effort.max_cycles, apply, approximate_inverse);
}

std::unique_ptr<TangentialStep> make_tangential_step(const Patch& patch, const Lambda& weights,
                                                     const Points& fixed_points, const Progress& progress) {
    return with_edges(patch, weights, [&](const InnerWeights& edges) {
        return std::make_unique<SymmetricStep>(patch, edges, fixed_points, progress);
    });
}

}  // namespace fairing
