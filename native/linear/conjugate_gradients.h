// Preconditioned conjugate gradients over the columns of a field: numbers (1 × n) or vectors (3 × n), in either
// precision.
#pragma once

#include "base/parallel.h"
#include "base/types.h"

namespace fairing {

// Where a caller knows no smaller number: it has never been reached.
inline constexpr int most_cycles = 500;

template <typename Field>
double inner_product(const Field& a, const Field& b) {
    return sum_over_ranges(static_cast<int>(a.cols()), coarse_grain, [&](int begin, int end) {
        return a.middleCols(begin, end - begin).cwiseProduct(b.middleCols(begin, end - begin)).sum();
    });
}

template <typename Field>
struct GradientSolution {
    Field x;
    bool positive = true;  // A was positive definite in all directions tried
    Field left = {};       // r − A x
    int cycles = 0;
};

// x with A x ≈ r from x = 0, until the residual in the preconditioner's norm has fallen to `relative_tolerance` or
// after `max_cycles`; earlier where A turns out not to be positive definite. `apply(p, q)`: q ← A p; `precondition(r,
// z)`: z ← about A⁻¹ r. q and z have the right size.
template <typename Field, typename Apply, typename Precondition>
GradientSolution<Field> conjugate_gradients(Field r, double relative_tolerance, int max_cycles, const Apply& apply,
                                            const Precondition& precondition) {
    const int count = static_cast<int>(r.cols());
    Field x = Field::Zero(r.rows(), count);
    Field z(r.rows(), count);
    Field& product = z;  // shared: one is consumed before the other is made
    precondition(r, z);
    Field p = z;
    double rz = inner_product(r, z);
    const double target = relative_tolerance * relative_tolerance * rz;
    int cycle = 0;
    while (cycle < max_cycles && rz > target) {
        apply(p, product);
        const double curvature = inner_product(p, product);
        if (!(curvature > 0.0)) return {std::move(x), false, std::move(r), cycle};
        const auto alpha = static_cast<typename Field::Scalar>(rz / curvature);
        for_ranges(count, coarse_grain, [&](int begin, int end) {
            const int size = end - begin;
            x.middleCols(begin, size) += alpha * p.middleCols(begin, size);
            r.middleCols(begin, size) -= alpha * product.middleCols(begin, size);
        });
        if (++cycle == max_cycles) break;
        precondition(r, z);
        const double next = inner_product(r, z);
        const auto beta = static_cast<typename Field::Scalar>(next / rz);
        for_ranges(count, coarse_grain, [&](int begin, int end) {
            const int size = end - begin;
            p.middleCols(begin, size) = z.middleCols(begin, size) + beta * p.middleCols(begin, size);
        });
        rz = next;
    }
    return {std::move(x), true, std::move(r), cycle};
}

}  // namespace fairing
