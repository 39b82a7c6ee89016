// How much the curvature counts from place to place, where slopes are carried further in, or less far.
#pragma once

#include <optional>

#include "base/progress.h"
#include "operators/laplace_operator.h"

namespace fairing {

// What Δ_B H = 0 becomes for tensions t along the boundary of a surface: Δ_B (w (H − H₀)) = 0 with
//     w = exp(3 T (1 − ψ)),    Δ_B T = 0 with T = ln t on the boundary,
//     ψ = φ / (φ + ½ |∇φ|²),   Δ_B φ = −1 with φ = 0 there,
//     Δ_B H₀ = 0 with H₀ = ½ κ there, κ the normal curvature along the boundary.
// ψ is the depth, from 0 at the boundary to 1 midway between its sides: on a strip 4 s (1 − s). H₀ is that of a surface
// which goes straight on from its boundary, and H − H₀ half of the curvature across. A cubic blend whose end
// derivatives are t times as long runs t times as fast there: its energy ∫ |p''|² gives the squared curvature the
// weight t³.
class TensionWeight {
public:
    // `share` of the logarithms of the problem's tensions. `layout`: about where the free vertices are.
    TensionWeight(const Problem& problem, double share, Points layout);

    struct Values {        // at all vertices
        VectorX weight;    // w
        VectorX straight;  // H₀
    };
    // Those of a surface (3 × local vertices); none where it has degenerated.
    [[nodiscard]] std::optional<Values> on(const Points& points, const Stiffness& stiffness, const Progress& progress);

private:
    [[nodiscard]] VectorX depth(const Points& points, const VectorX& torsion) const;

    const Patch& patch_;
    Eigen::MatrixXd given_;  // ln t and H₀ at the fixed vertices
    LaplaceOperator laplace_;
};

}  // namespace fairing
