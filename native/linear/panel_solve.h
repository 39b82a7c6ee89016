// Triangular solves of one right-hand side, or of four side by side, with a front's panel of a Cholesky factor.
#pragma once

#include <Eigen/Core>

namespace fairing {

// Rows × columns, the front's own rows on top: [L₁₁; L₂₁], column-major. `Stored`: double, or float for an approximate
// factor: all is in single precision then.
template <typename Stored>
using PanelOf = Eigen::Map<const Eigen::Matrix<Stored, Eigen::Dynamic, Eigen::Dynamic>>;
using ConstPanel = PanelOf<double>;

// b = (b₁, b₂) ← (L₁₁⁻¹ b₁, b₂ − L₂₁ L₁₁⁻¹ b₁).
template <typename Stored>
void eliminate_vector(const PanelOf<Stored>& panel, Stored* b);

// b₁ ← L₁₁⁻ᵀ (b₁ − L₂₁ᵀ b₂).
template <typename Stored>
void substitute_vector(const PanelOf<Stored>& panel, Stored* b);

// The same for four: b has four numbers in each row, one after the other.
inline constexpr int lanes = 4;
template <typename Stored>
void eliminate_lanes(const PanelOf<Stored>& panel, Stored* b);
template <typename Stored>
void substitute_lanes(const PanelOf<Stored>& panel, Stored* b);

extern template void eliminate_vector<double>(const PanelOf<double>&, double*);
extern template void eliminate_vector<float>(const PanelOf<float>&, float*);
extern template void substitute_vector<double>(const PanelOf<double>&, double*);
extern template void substitute_vector<float>(const PanelOf<float>&, float*);
extern template void eliminate_lanes<double>(const PanelOf<double>&, double*);
extern template void eliminate_lanes<float>(const PanelOf<float>&, float*);
extern template void substitute_lanes<double>(const PanelOf<double>&, double*);
extern template void substitute_lanes<float>(const PanelOf<float>&, float*);

}  // namespace fairing
