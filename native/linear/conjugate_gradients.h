// Preconditioned conjugate gradients over the columns of a field: numbers (1 × n) or vectors (3 × n), in either
// precision.
#pragma once

#include "base/parallel.h"
#include "base/types.h"
#include "linear/limits.h"

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
        if (!(curvature > 0.0)) return {std::move(x), false};
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
    return {std::move(x)};
}

// Keeps conjugate directions p_i with A p_i. A solve begins with the projection of its solution on them and keeps its
// own directions conjugate to them, so that only the rest is left to find (Erhel & Guyomarc'h 2000, "An augmented
// conjugate gradient method for solving consecutive symmetric positive definite linear systems").
class KnownDirections {
public:
    using Row = Eigen::RowVectorXd;

    // Forgets the directions: another matrix follows.
    void forget() { pairs_.clear(); }

    // x with A x ≈ r to `accuracy`, or after `max_cycles`; `apply` and `precondition` as in
    // conjugate_gradients.
    template <typename Apply, typename Precondition>
    [[nodiscard]] Row solve(Row r, const Accuracy& accuracy, int max_cycles, const Apply& apply,
                            const Precondition& precondition) {
        Row z(r.size());
        const auto size = [&] {
            precondition(r, z);
            return std::sqrt(r.dot(z));
        };
        const double whole = size();
        const double most_left = accuracy.left_of(whole);
        Row x = known_part(r);
        const double left = pairs_.empty() ? whole : size();
        if (!(left > most_left)) return x;
        const std::size_t before = pairs_.size();
        const auto apply_and_keep = [&](const Row& p, Row& product) {
            apply(p, product);
            keep(p, product);
        };
        const auto precondition_beside = [&](const Row& residual, Row& result) {
            precondition(residual, result);
            for (std::size_t k = 0; k < before; ++k) result -= pairs_[k].product.dot(result) * pairs_[k].direction;
        };
        const auto rest =
            conjugate_gradients(std::move(r), most_left / left, max_cycles, apply_and_keep, precondition_beside);
        return x + rest.x;
    }

private:
    static constexpr std::size_t most = 40;  // directions kept; each takes two rows of the mesh's length

    struct Pair {  // pᵀ A p = 1
        Row direction;
        Row product;
    };

    void keep(const Row& p, const Row& product) {
        const double curvature = p.dot(product);
        if (pairs_.size() == most || !(curvature > 0.0)) return;
        const double scale = 1.0 / std::sqrt(curvature);
        pairs_.push_back({scale * p, scale * product});
    }

    // The part of the solution that lies in the directions; r becomes what is left.
    [[nodiscard]] Row known_part(Row& r) const {
        Row x = Row::Zero(r.size());
        for (const Pair& pair : pairs_) {
            const double share = pair.direction.dot(r);
            x += share * pair.direction;
            r -= share * pair.product;
        }
        return x;
    }

    std::vector<Pair> pairs_;
};

}  // namespace fairing
