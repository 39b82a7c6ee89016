// From a coarse level to the next finer one, vertex by vertex (paper §7.4).
#pragma once

#include "base/progress.h"
#include "paper/hierarchy.h"
#include "paper/level_update.h"

namespace fairing {

// The input of the insertion of vertices. References must outlive the Prolongation.
struct ProlongationSetting {
    const Patch& patch;
    const Points& fixed_normals;
    const Points& reference;  // M0: λ belongs to the connectivity of the moment (conformal λ: M0 rebuilt alongside)
    InnerFairness inner_fairness;
    const SolverOptions& solver;
    const PaperOptions& paper;
};

// The mesh between the levels. Starts at the coarsest one.
class Prolongation {
public:
    Prolongation(const Hierarchy& hierarchy, const ProlongationSetting& setting);
    ~Prolongation();
    Prolongation(const Prolongation&) = delete;
    Prolongation& operator=(const Prolongation&) = delete;

    // Splits vertices up to the given level. Each new one is put (1) at its inner-fairness position; then its 1-disk is
    // relaxed to (2) Δq = 0 and (3) Δ_B H = f, by the construction itself. `points`: 3 × vertices of the patch; those
    // of the present level count and may move.
    void refine(int level, Points& points, const Progress& progress);

private:
    class Neighbourhood;
    const Hierarchy& hierarchy_;
    std::unique_ptr<Neighbourhood> neighbourhood_;
    std::size_t collapsed_;
    const PaperOptions& paper_;
};

}  // namespace fairing
