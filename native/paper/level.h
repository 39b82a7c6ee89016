// One level of the hierarchy and everything that is measured on it.
#pragma once

#include "fairness/row_weights.h"
#include "paper/curvature_equation.h"
#include "paper/options.h"
#include "solver/problem.h"

namespace fairing {

// What stays the same while a level is faired. Fixed vertices are those of the whole patch, in the same order.
struct LevelProblem {
    const Patch& patch;
    const Points& fixed_normals;
    const SolverOptions& solver;
    const PaperOptions& paper;
    RowWeights weights;
    bool completed;  // virtual points at every vertex of this level

    // Whether the fit at a vertex gets virtual points: valence 3 and 4 (Lemma 1), fixed vertices (one-sided data,
    // §7.5).
    [[nodiscard]] bool completes(int vertex, std::size_t valence) const {
        return completed || valence < 5 || !patch.is_free(vertex);
    }
    // Whether the boundary data prescribe the normal.
    [[nodiscard]] bool prescribes_normal(int vertex) const {
        return solver.equation != Equation::minimal && !patch.is_free(vertex) &&
               !patch.pin[static_cast<std::size_t>(vertex)];
    }
};

// The right-hand side f of Δ_B H = f for a fitted second fundamental form (§7.5).
double outer_source(const SolverOptions& options, const CurvatureFit& fit);

struct LevelState {
    Points points;   // 3 × level vertices
    Points normals;  // prescribed or averaged (§6)
    VectorX H;
    VectorX source;  // f at the free vertices
    FaceGeometry faces;
    Stiffness stiffness;

    void measure(const LevelProblem& level, const DiskTable& disks);
    // 2 M f with the sign of S H: the right-hand side of step I.
    [[nodiscard]] VectorX right_hand_side(const LevelProblem& level) const;
    // max |P Δq|/ℓ² over the free vertices: how far inner fairness is off (§7.3), P the projection across the normal,
    // ℓ² the mean squared distance of the neighbours; in units of 1/D.
    [[nodiscard]] double unfairness(const LevelProblem& level, const DiskTable& disks) const;
    // max |Δ_B H − f| over the free vertices, |H| for minimal surfaces. Infinite where it is not a number.
    [[nodiscard]] double residual(const LevelProblem& level, const CurvatureEquation& equation) const;
};

}  // namespace fairing
