// Everything that is measured on one level of the hierarchy.
#pragma once

#include "paper/curvature_equation.h"
#include "paper/disk_curvature.h"
#include "paper/level_problem.h"

namespace fairing {

// The right-hand side f of Δ_B H = f for a fitted second fundamental form (§7.5).
double outer_source(const SolverOptions& options, const CurvatureFit& fit);

struct LevelState {
    Points points;   // 3 × level vertices
    Points normals;  // prescribed or averaged (§6)
    Points arcs;     // of DiskField: 3 × edges, where a disk asks for them
    VectorX H;
    VectorX source;  // f at the free vertices
    Stiffness stiffness;
    std::vector<double> weights;  // of the curvature at the free vertices, see DiskFit
    std::vector<std::size_t> weights_begin;

    void measure(const LevelProblem& level);
    // The same within a cycle of updates: with the arcs of the last measurement.
    void measure_again(const LevelProblem& level);
    // 2 M f with the sign of S H: the right-hand side of step I.
    [[nodiscard]] VectorX right_hand_side(const LevelProblem& level) const;
    [[nodiscard]] std::span<double> weights_of(int free_vertex);
    // max |P Δq|/ℓ² over the free vertices: how far inner fairness is off (§7.3), P the projection across the normal,
    // ℓ² the mean squared distance of the neighbours; in units of 1/D.
    [[nodiscard]] double unfairness(const LevelProblem& level) const;
    // max |Δ_B H − f| over the free vertices, |H| for minimal surfaces. Infinite where it is not a number.
    [[nodiscard]] double residual(const LevelProblem& level, const CurvatureEquation& equation) const;

private:
    void measure_normals(const LevelProblem& level);
    void measure_arcs(const LevelProblem& level);
    void measure_curvature(const LevelProblem& level);

    void prepare(const LevelProblem& level);

    FaceGeometry faces_;
    DiskFit fit_;
    Indices arc_edges_;
};

}  // namespace fairing
