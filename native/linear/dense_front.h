// Dense Cholesky elimination of the leading columns of a symmetric matrix.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace fairing {

template <typename Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using Front = Eigen::Map<Dense<Scalar>>;
// Operations of the dense kernels, roughly.
using WorkDone = std::function<void(double operations)>;

// `front`: rows × columns, the lower trapezoid of a symmetric matrix of order `rows` whose other columns stand in
// `update` (order rows − columns). Replaces the leading block by its factor L₁₁ and what is below it by L₂₁, and takes
// L₂₁ L₂₁ᵀ from the lower triangle of `update`. Only lower triangles are read. False where a pivot is not positive.
// `work_done` is called after each piece of work. In either precision.
template <typename Scalar>
bool eliminate_front(Front<Scalar> front, Dense<Scalar>& update, const WorkDone& work_done);

}  // namespace fairing
