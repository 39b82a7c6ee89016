// Triangular solves of one right-hand side with a front's panel of a Cholesky factor.
#pragma once

#include <Eigen/Core>

namespace fairing {

// Rows × columns, the front's own rows on top: [L₁₁; L₂₁], column-major.
using ConstPanel = Eigen::Map<const Eigen::MatrixXd>;

// b = (b₁, b₂) ← (L₁₁⁻¹ b₁, b₂ − L₂₁ L₁₁⁻¹ b₁).
void eliminate_vector(const ConstPanel& panel, double* b);

// b₁ ← L₁₁⁻ᵀ (b₁ − L₂₁ᵀ b₂).
void substitute_vector(const ConstPanel& panel, double* b);

}  // namespace fairing
