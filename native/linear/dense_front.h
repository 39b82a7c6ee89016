// Dense Cholesky elimination of the leading columns of a symmetric matrix.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace fairing {

using Front = Eigen::Map<Eigen::MatrixXd>;
// Operations of the dense kernels, roughly.
using WorkDone = std::function<void(double operations)>;

// `front`: rows × columns, the lower trapezoid of a symmetric matrix of order `rows` whose other columns stand in
// `update` (order rows − columns). Replaces the leading block by its factor L₁₁ and what is below it by L₂₁, and takes
// L₂₁ L₂₁ᵀ from the lower triangle of `update`. Only lower triangles are read. False where a pivot is not positive.
// `work_done` hears of each piece of work.
bool eliminate_front(Front front, Eigen::MatrixXd& update, const WorkDone& work_done);

}  // namespace fairing
