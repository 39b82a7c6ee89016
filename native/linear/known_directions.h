// Conjugate gradients for a sequence of right-hand sides: each solve reuses the directions of those before (deflation).
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "linear/accuracy.h"
#include "linear/conjugate_gradients.h"

namespace fairing {

// Keeps conjugate directions p_i with A p_i. A solve begins with the projection of its solution on them and keeps its
// own directions conjugate to them, so that only the rest is left to find (Erhel & Guyomarc'h 2000, "An augmented
// conjugate gradient method for solving consecutive symmetric positive definite linear systems").
class KnownDirections {
public:
    using Row = Eigen::RowVectorXd;

    // Forgets the directions: another matrix follows.
    void forget() { pairs_.clear(); }

    // x with A x ≈ r to `accuracy`, or after `max_cycles`, which `unfinished` counts; `apply` and `precondition` as in
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
        auto rest =
            conjugate_gradients(std::move(r), most_left / left, max_cycles, apply_and_keep, precondition_beside);
        r = std::move(rest.left);
        if (!rest.positive || (rest.cycles == max_cycles && !(size() <= most_left))) ++unfinished_;
        return x + rest.x;
    }

    // Solves so far that missed their accuracy.
    [[nodiscard]] int unfinished() const { return unfinished_; }

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
    int unfinished_ = 0;
};

}  // namespace fairing
