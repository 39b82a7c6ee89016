#include "continuity/join_operator.h"

#include "linear/conjugate_gradients.h"
#include "linear/gmres.h"

namespace fairing {

namespace {

// With 0.02 patches of 30k vertices need nine iterations instead of five, with a tenth of it none less.
constexpr double relative_tolerance = 0.004;

}  // namespace

JoinOperator::JoinOperator(const Patch& patch, const Points& fixed_points, const OutlineModes& modes, Points layout)
    : modes_(modes),
      laplace_(patch, std::move(layout)),
      coupling_(patch),
      outline_(patch, fixed_points),
      free_mass_(patch.free_count),
      fixed_mass_(fixed_points.cols()) {}

bool JoinOperator::update(const Stiffness& stiffness, const Progress& progress) {
    coupling_.update(stiffness);
    free_mass_ = 4.0 * stiffness.mass.head(free_mass_.size());
    fixed_mass_ = 4.0 * stiffness.mass.tail(fixed_mass_.size());
    if (!outline_.update(fixed_mass_) || !laplace_.update(stiffness, progress)) return false;
    beside_ = laplace_.factor().reach(coupling_.beside());
    return true;
}

VectorX JoinOperator::lifted(const VectorX& outline) const {
    return laplace_.factor().solve_vector(coupling_.spread(outline.transpose()), beside_);
}

VectorX JoinOperator::turned(const VectorX& field) const {
    const VectorX u = laplace_.factor().solve_vector(free_mass_.cwiseProduct(field), FrontReach(), beside_);
    return coupling_.gather(u).transpose();
}

VectorX JoinOperator::harmonic(const VectorX& coefficients) const { return -lifted(modes_.multipliers(coefficients)); }

// Rows: the change of H at the fixed vertices by the first equation, then its modes.
VectorX JoinOperator::applied(const VectorX& unknowns) const {
    const VectorX change = unknowns.head(fixed_mass_.size());
    const VectorX kappa = lifted(modes_.multipliers(unknowns.tail(modes_.count())));
    const VectorX source = coupling_.spread(change.transpose()) + 0.25 * free_mass_.cwiseProduct(kappa);
    const VectorX first = fixed_mass_.cwiseProduct(change) + turned(laplace_.factor().solve_vector(source));
    VectorX rows(unknowns.size());
    rows << outline_.approximate_inverse(first.transpose()).transpose(), modes_.projected(change);
    return rows;
}

// As if Ĝ were G and the multipliers of a mode changed that mode alone.
VectorX JoinOperator::preconditioned(const VectorX& rows) const {
    const VectorX first = rows.head(fixed_mass_.size());
    const VectorX coefficients = modes_.projected(first) - rows.tail(modes_.count());
    VectorX unknowns(rows.size());
    unknowns << first - modes_.combined(coefficients), coefficients;
    return unknowns;
}

JoinOperator::Step JoinOperator::solve(const VectorX& residual, const VectorX& missing) const {
    const SparseCholesky& factor = laplace_.factor();
    const VectorX inner = factor.solve_vector(residual);
    VectorX rhs(fixed_mass_.size() + modes_.count());
    rhs << -outline_.approximate_inverse(turned(inner).transpose()).transpose(), modes_.projected(missing);
    const VectorX unknowns =
        gmres([&](const VectorX& v) { return applied(v); }, [&](const VectorX& v) { return preconditioned(v); }, rhs,
              relative_tolerance, most_cycles);
    Step step{{}, unknowns.tail(modes_.count())};
    const VectorX change = unknowns.head(fixed_mass_.size());
    const VectorX source =
        coupling_.spread(change.transpose()) - 0.25 * free_mass_.cwiseProduct(harmonic(step.coefficients));
    step.heights = factor.solve_vector(free_mass_.cwiseProduct(inner + factor.solve_vector(source)));
    return step;
}

}  // namespace fairing
