#include "linear/half_order.h"

#include <cmath>
#include <numbers>

namespace fairing {

namespace {

// The nodes in log s: the sum is within 2.3 % for eigenvalues from the least one to 4, which is about an outline's
// largest. Beyond `largest` a hundredth of the integral is left out; the last node lies half a cell below the least
// one.
constexpr double spacing = 3.0;
constexpr double largest = 2.0;

}  // namespace

bool HalfOrder::update(const SparseMatrix& lower, double least) {
    Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), order_);
    order_ = order_.inverse().eval();
    SparseMatrix ordered(lower.rows(), lower.cols());
    ordered.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(order_);
    const auto count = std::max(1, static_cast<int>(std::ceil((largest - std::log(least)) / spacing + 0.5)));
    terms_.clear();
    for (int k = 0; k < count; ++k) {
        Term& term = terms_.emplace_back();
        term.shift = std::exp(largest - k * spacing);
        term.weight = spacing / std::numbers::pi * std::sqrt(term.shift) / (1.0 + term.shift);
        term.factor.setShift(term.shift);
        term.factor.compute(ordered);
        if (term.factor.info() != Eigen::Success || !(term.factor.vectorD().minCoeff() > 0.0)) return false;
    }
    // Below the last node's cell λ / (λ + s) is 1, but for the least eigenvalues.
    const double end = terms_.back().shift * std::exp(-0.5 * spacing);
    constant_ = 2.0 / std::numbers::pi * std::sqrt(least) * std::atan(std::sqrt(end / least));
    return true;
}

VectorX HalfOrder::apply(const VectorX& values) const {
    const VectorX ordered = order_ * values;
    VectorX result = constant_ * ordered;
    for (const Term& term : terms_) {
        const VectorX solved = term.factor.solve(ordered);
        result += term.weight * (ordered - term.shift * solved);
    }
    return order_.inverse() * result;
}

}  // namespace fairing
