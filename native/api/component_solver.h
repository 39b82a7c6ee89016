// The solve of one component, in units of D, and what the next solve of the same component can use of it.
#pragma once

#include "api/component.h"
#include "base/progress.h"
#include "method/warm_start.h"
#include "problem/solution.h"

namespace fairing {

// The caller's options, and the same with uniform inner fairness. `repeated`: answers and factorisations are kept for
// later solves.
struct CallOptions {
    CallOptions(FairOptions options, bool keeps);

    FairOptions asked;
    FairOptions uniform;
    bool repeated;
};

// Columns belong to the input's vertices.
struct ComponentData {
    const Points& vertices;
    const Points& normals;      // prescribed ones at fixed vertices
    const VectorX& curvatures;  // likewise; empty: none
    const Points& reference;    // M0
};

struct ComponentAnswer {
    Normalisation unit;
    Problem problem;
    Solution solution;
    Diagnostics warnings;
};

// Refers to patch and options.
class ComponentSolver {
public:
    ComponentSolver(const Patch& patch, const CallOptions& options);

    // Throws NO_BOUNDARY where the fixed vertices lie in one point, SolverError, Cancelled; what was kept stays usable.
    [[nodiscard]] ComponentAnswer solve(const ComponentData& data, const Progress& progress);

    // λ is read off the reference again.
    void options_changed() { given_reference_.resize(3, 0); }

private:
    // Whether a solve starts from its last answer.
    [[nodiscard]] bool keeps() const;
    void read_reference(const Points& reference, const Normalisation& unit);
    [[nodiscard]] const FairOptions& options() const { return usable_ ? options_.asked : options_.uniform; }
    [[nodiscard]] Solution solve_by_paper(const Problem& problem, const Progress& progress) const;
    [[nodiscard]] Solution solve_globally(ComponentAnswer& answer, const Progress& progress);
    // From the last answer where there is one.
    [[nodiscard]] Solution solve_tangent(const Problem& problem, const Progress& progress);
    [[nodiscard]] std::size_t tolerated_folds() const;

    const Patch& patch_;
    const CallOptions& options_;
    Points given_reference_;  // 3 × local vertices, as the caller gave it
    Points reference_;        // in units of D
    bool usable_ = true;
    Diagnostics reference_warnings_;
    Lambda lambda_;
    WarmStart warm_;
};

}  // namespace fairing
