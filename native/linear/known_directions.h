// What earlier solves by conjugate gradients found out about a matrix, for the next right-hand side.
#pragma once

#include <vector>

#include "base/types.h"

namespace fairing {

// Conjugate directions p_i with A p_i, p_iᵀ A p_i = 1. A solve that begins with what they know and keeps its own
// directions conjugate to them has only the rest to find (Erhel & Guyomarc'h 2000, "An augmented conjugate gradient
// method for solving consecutive symmetric positive definite linear systems").
class KnownDirections {
public:
    using Row = Eigen::RowVectorXd;

    void forget() { pairs_.clear(); }

    // Keeps p, conjugate to those known, with A p.
    void remember(const Row& p, const Row& product) {
        const double curvature = p.dot(product);
        if (pairs_.size() == most || !(curvature > 0.0)) return;
        const double size = 1.0 / std::sqrt(curvature);
        pairs_.push_back({size * p, size * product});
    }

    // The part of the solution of A x = r that lies in them; r becomes what is left.
    [[nodiscard]] Row solve(Row& r) const {
        Row x = Row::Zero(r.size());
        for (const Pair& pair : pairs_) {
            const double share = pair.direction.dot(r);
            x += share * pair.direction;
            r -= share * pair.product;
        }
        return x;
    }

    // z ← z without what isn't conjugate to them.
    void make_conjugate(Row& z) const {
        for (const Pair& pair : pairs_) z -= pair.product.dot(z) * pair.direction;
    }

private:
    static constexpr std::size_t most = 40;

    struct Pair {
        Row direction;
        Row product;
    };
    std::vector<Pair> pairs_;
};

}  // namespace fairing
