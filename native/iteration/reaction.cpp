#include "iteration/reaction.h"

#include <algorithm>

namespace fairing {

namespace {

constexpr int largest_solved = 1000;  // free vertices
// Beyond, surfaces are about to lose their hold: long pipes went on to bulbs.
constexpr double largest_share = 0.4;

// S (½ w (κ₁² + κ₂²) u) over the free vertices.
VectorX reaction(const Problem& problem, const SurfaceState& state, const VectorX& u) {
    const int count = problem.patch.free_count;
    const auto H = state.curvature.mean.head(count).array();
    const VectorX K = state.curvature.gaussian();
    Eigen::RowVectorXd field = Eigen::RowVectorXd::Zero(problem.patch.vertex_count());
    field.head(count) = (2.0 * H.square() - K.head(count).array()) * u.array();
    return state.stiffness.apply(problem.patch, field, count).transpose();
}

}  // namespace

void add_reaction(const Problem& problem, const SurfaceState& state, const NormalOperator& normal, double& share,
                  VectorX& u) {
    const Equation equation = problem.options.equation;
    if (equation != Equation::harmonic && equation != Equation::constant) return;
    if (problem.patch.free_count > largest_solved) {
        u /= 1.0 - share;
        return;
    }
    const VectorX lacking = normal.solve(reaction(problem, state, u));
    const double size = u.squaredNorm();
    const double found = size > 0.0 ? lacking.dot(u) / size : 0.0;
    share = found > 0.0 && found < largest_share ? found : 0.0;
    if (share > 0.0) u += lacking / (1.0 - share);
}

}  // namespace fairing
