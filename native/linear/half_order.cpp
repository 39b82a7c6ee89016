#include "linear/half_order.h"

#include <cmath>
#include <numbers>

namespace fairing {

namespace {

// The nodes in log s. What is left of the integral beyond them is below a twentieth of the whole.
constexpr double spacing = 2.0;
constexpr double largest = 6.0;
constexpr double below_least = 6.0;

}  // namespace

bool HalfOrder::update(const SparseMatrix& lower, double least) {
    SparseMatrix identity(lower.rows(), lower.cols());
    identity.setIdentity();
    const auto count = static_cast<int>(std::ceil((largest + below_least - std::log(least)) / spacing));
    terms_.clear();
    for (int k = 0; k < count; ++k) {
        Term& term = terms_.emplace_back();
        term.shift = std::exp(largest - k * spacing);
        term.weight = spacing / std::numbers::pi * std::sqrt(term.shift) / (1.0 + term.shift);
        if (!term.factor.factorise(lower + term.shift * identity, "the outline", Progress())) return false;
    }
    return true;
}

VectorX HalfOrder::apply(const VectorX& values) const {
    VectorX result = VectorX::Zero(values.size());
    for (const Term& term : terms_) result += term.weight * (values - term.shift * VectorX(term.factor.solve(values)));
    return result;
}

}  // namespace fairing
