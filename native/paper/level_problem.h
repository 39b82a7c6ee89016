// One level of the hierarchy: what is to be solved on it.
#pragma once

#include "fairness/row_weights.h"
#include "paper/options.h"
#include "problem/problem.h"

namespace fairing {

// What stays the same while a level is faired. Fixed vertices are those of the whole patch, in the same order.
struct LevelProblem {
    const Patch& patch;
    const Points& fixed_normals;
    const SolverOptions& solver;
    const PaperOptions& paper;
    RowWeights weights;
    bool completed;  // virtual points at every vertex of this level

    // Virtual points join the fit at valence 3 and 4 (Lemma 1) and at fixed vertices (one-sided data, §7.5) anyway.
    [[nodiscard]] Disk disk(int vertex) const {
        const RingView ring = patch.ring(vertex);
        return {vertex, ring, completed || ring.valence() < 5 || !patch.is_free(vertex)};
    }
    // Whether the boundary data prescribe the normal.
    [[nodiscard]] bool prescribes_normal(int vertex) const {
        return solver.equation != Equation::soap_film && !patch.is_free(vertex) &&
               !patch.pin[static_cast<std::size_t>(vertex)];
    }
};

}  // namespace fairing
