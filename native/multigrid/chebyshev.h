// Polynomial smoothing for symmetric positive definite operators.
#pragma once

namespace fairing {

// `degree` steps of the Chebyshev iteration of the fourth kind (Lottes 2022), which needs no lower bound of the
// spectrum: x ← x + p(D⁻¹A) D⁻¹ r with r kept as the residual of x. `inverse_diagonal`: a row, 0 at fixed vertices;
// `largest`: an upper bound of the eigenvalues of D⁻¹A; `apply(z, y)`: y ← A z.
template <typename FieldType, typename Row, typename Apply>
void chebyshev(FieldType& x, FieldType& r, const Row& inverse_diagonal, double largest, int degree,
               const Apply& apply) {
    FieldType z = FieldType::Zero(x.rows(), x.cols());
    FieldType y(x.rows(), x.cols());
    for (int k = 1; k <= degree; ++k) {
        const double keep = (2.0 * k - 3.0) / (2.0 * k + 1.0);
        const double add = (8.0 * k - 4.0) / (2.0 * k + 1.0) / largest;
        z.array() = (k == 1 ? 0.0 : keep) * z.array() + add * (r.array().rowwise() * inverse_diagonal.array());
        x += z;
        apply(z, y);
        r -= y;
    }
}

}  // namespace fairing
